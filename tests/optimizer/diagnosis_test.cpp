// Outcomes say why: which constraints contradict one another, which repeat others, which expression is no number.
#include <gtest/gtest.h>

#include <string>

#include "optimizer/session.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string ball = "time [0, 1]\ntrajectory bspline spans 16\ndof x = 3\ndof y\n";  // lines 1 to 4

void expect_said(const Motion& motion, Status status, std::initializer_list<const char*> parts) {
  EXPECT_EQ(motion.status, status) << motion.message;
  for (const char* part : parts)
    EXPECT_NE(motion.message.find(part), std::string::npos) << part << "\n" << motion.message;
}
void expect_silent(const Motion& motion, std::initializer_list<const char*> parts) {
  for (const char* part : parts)
    EXPECT_EQ(motion.message.find(part), std::string::npos) << part << "\n" << motion.message;
}

TEST(Conflict, BallInTwoPlacesAtOnce) {
  const Motion motion = run_scene(ball + R"(constrain start: (x, y) = 0 at 0
constrain left:  x = 0 at 0.5
constrain slow:  x' <= 20 over [0, 1]
constrain right: x = 1 at 0.5
constrain high:  y = 2 at 0.5
minimize integral(x''^2 + y''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'left' (line 6, at 0.5 s) and 'right' (line 8, at 0.5 s) cannot hold together.",
               "relax 'left' by 1 or 'right' by 1."});
  expect_silent(motion, {"'start'", "'slow'", "'high'"});
}

TEST(Conflict, ThreeOfWhichAnyTwoAreCompatible) {
  const Motion motion = run_scene(ball + R"(constrain a: x = 0 at 0.5
constrain b: y = 0 at 0.5
constrain calm: y = 0 at 0
constrain c: 10*x + 10*y >= 10 at 0.5
minimize integral(x''^2 + y''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'a' (line 5, at 0.5 s), 'b' (line 6, at 0.5 s) and 'c' (line 8, at 0.5 s) cannot hold together.",
               "relax 'c' by 10, 'a' by 1 or 'b' by 1."});
  expect_silent(motion, {"'calm'"});
}

// Both inequalities are violated where the least-squares point lies, but they go together.
TEST(Conflict, InequalitiesAgainstAnEquation) {
  const Motion motion = run_scene(ball + R"(constrain low: x <= 0 over [0.2, 0.8] every 0.1
constrain lower: x <= -1 at 0.5
constrain hit: x = 2 at 0.5
constrain fine: x = 3 at 0
minimize integral(x''^2 + y''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'lower' (line 6, at 0.5 s) and 'hit' (line 7, at 0.5 s) cannot hold together. To reconcile them relax "
               "'lower' by 3 or 'hit' by 3.",
               "'low' (line 5, at 0.5 s) and 'hit' (line 7, at 0.5 s) cannot hold together. To reconcile them relax "
               "'low' by 2 or 'hit' by 2."});
  expect_silent(motion, {"'fine'", "'low' (line 5, at 0.5 s) and 'lower'"});
}

TEST(Conflict, TwoAtOnceOfDifferentSize) {
  const Motion motion = run_scene(ball + R"(constrain a: x = 0 at 0.5
constrain b: x = 1 at 0.5
constrain c: y' = 2 at 0.25
constrain d: y' = 2.001 at 0.25
constrain f: y = 0 at 0.5
minimize integral(x''^2 + y''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'a' (line 5, at 0.5 s) and 'b' (line 6, at 0.5 s) cannot hold together",
               "'c' (line 7, at 0.25 s) and 'd' (line 8, at 0.25 s) cannot hold together. To reconcile them relax 'c' "
               "by 0.001 or 'd' by 0.001."});
  expect_silent(motion, {"'f'"});
}

// More violated rows than are looked at: 1,502.
TEST(Conflict, EverywhereAtOnce) {
  const Motion motion = run_scene(R"(time [0, 100]
trajectory bspline spans 400
dof x = 3
constrain left:  x = 0 over [0, 100] every 0.1
constrain right: x = 1 over [30, 80] every 0.1
minimize integral(x''^2)
)");
  expect_said(motion, Status::infeasible, {"'left' (line 4, at", "and 'right' (line 5, at", "cannot hold together"});
  expect_silent(motion, {"by itself"});
}

TEST(Conflict, ManyInstancesTogether) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 16
dof x
constrain from: x = 0 at 0
constrain to: x = 3 at 1
constrain slow: x' <= 2 over [0, 1]
minimize integral(x''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'from' (line 4, at 0 s), 'to' (line 5, at 1 s) and 'slow' (line 6, at 0, 0.0625, ..., 1 s (17 times)) "
               "cannot hold together.",
               "relax 'slow' by 1.", "'from' by 1 or 'to' by 1."});
}

const std::string arm = R"(time [0, 1]
trajectory bspline spans 16
creature arm {
  link upper { revolute shoulder; offset -pi/2; a 0.5; mass 2.0; rod }
  link fore  { revolute elbow;    a 0.4; mass 1.5; rod }
  link palm  { revolute wrist;    a 0.2; mass 0.5; rod }
  point hand on palm (0, 0, 0)
}
constrain rest: (arm.q, arm.q') = 0 at 0
)";

TEST(Conflict, OutOfReach) {
  const Motion motion = run_scene(
      arm + "constrain goal: (arm.hand.x, arm.hand.y) = (5, 0) at 1\nminimize integral(dot(arm.q'', arm.q''))\n");
  expect_said(motion, Status::infeasible,
              {"'goal' (line 10, at 1 s) cannot hold by itself: no small change brings it nearer than 3.9."});
  expect_silent(motion, {"'rest'"});
}

// A hand that should be where no arm reaches, in a throw that could do all else: told soon.
TEST(Conflict, IsFoundSoon) {
  std::string scene = file_text("examples/throw.scene");
  scene.insert(scene.find("constrain held"), "constrain far: (arm.hand.x, arm.hand.y) = (2, 0.3)  at 0.5\n");
  const Motion motion = run_scene(scene);
  expect_said(motion, Status::infeasible, {"'far'"});
  EXPECT_LE(motion.iterations, 150);
}

TEST(Conflict, OutOfReachBothWays) {
  const Motion motion = run_scene(
      arm + "constrain goal: (arm.hand.x, arm.hand.y) = (3, 4) at 1\nminimize integral(dot(arm.q'', arm.q''))\n");
  expect_said(motion, Status::infeasible, {"'goal' (line 10, at 1 s) cannot hold by itself"});
  expect_silent(motion, {"'rest'"});
}

TEST(Conflict, BoundsAreInTheWay) {
  const Motion motion = run_scene(
      "time [0, 1]\ntrajectory bspline spans 16\ndof x in [-1, 1]\ndof y in [-1, 1]\nconstrain hit: x + y = 3 at 0.5\n"
      "minimize integral(x''^2 + y''^2)\n");
  expect_said(motion, Status::infeasible,
              {"'hit' (line 5, at 0.5 s) cannot hold within the bounds of 'x' (line 3) and 'y' (line 4): no small "
               "change brings it nearer than 1."});
}

TEST(Conflict, OfAnIntegral) {
  const Motion motion = run_scene(ball + R"(constrain area: integral(x) = 2
constrain under: x <= 1 over [0, 1] every 0.02
constrain other: y = 1 at 0
minimize integral(x''^2 + y''^2)
)");
  expect_said(motion, Status::infeasible,
              {"'area' (line 5) and 'under' (line 6, at", "relax 'under' by 1.", " or 'area' by 1."});
  expect_silent(motion, {"'other'"});
}

TEST(Dependence, TheSameConstraintTwice) {
  const Motion motion = run_scene(ball + R"(constrain start: (x, x', y) = 0 at 0
constrain held: x = t over [0.3, 0.6] every 0.1
constrain again: 2*x = 2*t over [0.3, 0.6] every 0.1
minimize integral(x''^2 + y''^2)
)");
  expect_said(
      motion, Status::converged,
      {"4 of 11 equations depend on others: 'again' (line 7) repeats 'held' (line 6) at 0.3, 0.4, 0.5 and 0.6 s."});
}

TEST(Dependence, OfSeveral) {
  const Motion motion = run_scene(ball + R"(constrain a: x = 1 at 0.5
constrain b: y = 2 at 0.5
constrain sum: x + y = 3 at 0.5
minimize integral(x''^2 + y''^2)
)");
  expect_said(
      motion, Status::converged,
      {"1 of 3 equations depends on others: 'sum' (line 7) follows from 'a' (line 5) and 'b' (line 6) at 0.5 s."});
}

// More instances in a knot span than a cubic has coefficients; close ones are not yet dependent ones.
TEST(Dependence, OnOtherInstances) {
  const Motion many =
      run_scene(ball + "constrain line: x = t over [0, 0.0625] count 6\nminimize integral(x''^2 + y''^2)\n");
  expect_said(many, Status::converged,
              {"2 of 6 equations depend on others: 'line' (line 5) follows from its other instances at"});
  const Motion close = run_scene(ball + "constrain near: x = 1 at 0.5, 0.501\nminimize integral(x''^2 + y''^2)\n");
  expect_said(close, Status::converged, {});
  expect_silent(close, {"depend"});
}

// The double integrator: effort 12 d^2 for a distance d, 12 d^2 + ... by calculus of variations; raising the goal by
// one unit adds 24, raising the limit on x by one takes off the limit's multiplier.
TEST(Multipliers, ArePricesOfOneUnit) {
  const auto solved = [](double goal, double limit) {
    return run_scene(
        "time [0, 1]\ntrajectory bspline spans 32\ndof x\nconstrain start: (x, x') = 0 at 0\n"
        "constrain goal: x = " +
        std::to_string(goal) +
        " at 1\nconstrain still: x' = 0 at 1\n"
        "constrain limit: x' <= " +
        std::to_string(limit) + " at 0.5\nminimize integral(x''^2)\n");
  };
  constexpr double small = 1e-4;
  const Motion motion = solved(1, 1.4);
  ASSERT_EQ(motion.violations.size(), 4U);
  const Violation &goal = motion.violations[1], &limit = motion.violations[3];
  ASSERT_TRUE(goal.multiplier && limit.multiplier);
  EXPECT_NEAR(goal.multiplier->value, -(solved(1 + small, 1.4).objective - motion.objective) / small, 1e-2);
  EXPECT_NEAR(limit.multiplier->value, -(solved(1, 1.4 + small).objective - motion.objective) / small, 1e-2);
  EXPECT_GT(limit.multiplier->value, 1);
  EXPECT_EQ(limit.multiplier->time, 0.5);
}

// Each instance has its own, component by component; the largest of them is the one that the violations tell.
TEST(Multipliers, OfEveryInstanceAndComponent) {
  Session session(
      problem_of("time [0, 1]\ntrajectory bspline spans 16\ndof x\ndof y in [-3, 3]\n"
                 "constrain ends: (x, y) = (t, 2*t) at 0, 1\nconstrain lot: integral(x) = 0.6\n"
                 "minimize integral(x''^2 + y''^2)\n"));
  session.perform(Solve{});
  const Motion motion = session.motion();
  ASSERT_EQ(motion.status, Status::converged) << motion.message;
  const auto all = session.multipliers();
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].name, "ends");
  EXPECT_EQ(all[0].times, (std::vector<double>{0, 1}));
  ASSERT_EQ(all[0].values.size(), 2U);
  ASSERT_EQ(all[0].values[0].size(), 2U);
  EXPECT_GT(std::abs(all[0].values[0][0]), 1e-3);  // x is bent to have its integral
  EXPECT_NEAR(all[0].values[0][1], 0, 1e-6);       // y goes straight
  EXPECT_EQ(all[1].name, "lot");
  EXPECT_TRUE(all[1].times.empty());
  ASSERT_EQ(all[1].values.size(), 1U);
  EXPECT_EQ(all[2].name, "y");
  EXPECT_EQ(all[2].times.size(), 19U);
  EXPECT_EQ(motion.violations[1].multiplier->value, all[1].values[0][0]);
  EXPECT_EQ(std::abs(motion.violations[0].multiplier->value),
            std::max(std::abs(all[0].values[0][0]), std::abs(all[0].values[1][0])));
}

TEST(Multipliers, OfBoundsAndNoneWhereNothingCanHold) {
  const Motion bounded = run_scene(
      "time [0, 1]\ntrajectory bspline spans 16\ndof x in [-1, 0.5]\nconstrain ends: (x, x') = (0, 4) at 0\n"
      "constrain back: x = 0 at 1\nminimize integral(x''^2)\n");
  ASSERT_EQ(bounded.violations.size(), 3U);
  ASSERT_TRUE(bounded.violations[2].multiplier) << bounded.message;
  EXPECT_GT(bounded.violations[2].multiplier->value, 0.1);
  const Motion never = run_scene(ball + "constrain a: x = 1 at 0\nconstrain b: x = 2 at 0\n");
  for (const Violation& violation : never.violations) EXPECT_FALSE(violation.multiplier);
}

TEST(NotFinite, NamesExpressionStatementAndTime) {
  const std::string head = "time [0, 1]\ntrajectory bspline spans 8\ndof x = -0.3\nconstant k = 2\n";
  const auto failed = [&](const std::string& text) { return run_scene(head + text); };
  expect_said(failed("constrain c: sqrt(x) = 1 at 0.25\n"), Status::failed,
              {"sqrt(x) is not a number at 0.25 s, in 'c' (line 5): x is -0.3 there."});
  expect_said(failed("constrain c: k*log(x + 0.3) = 1 at 0.25\n"), Status::failed,
              {"log(x + 0.3) is beyond every number at 0.25 s, in 'c' (line 5): x + 0.3 is 0 there."});
  expect_said(failed("minimize o: integral(acos(1.5 + x'))\n"), Status::failed,
              {"acos(x' + 1.5) is not a number at ", "in 'o' (line 5): x' + 1.5 is 1.5 there."});
  expect_said(failed("minimize o: at(1/x', 0.5)\n"), Status::failed,
              {"1/x' is beyond every number at 0.5 s, in 'o' (line 5): x' is 0 there."});
  expect_said(failed("constrain c: integral(sqrt(x))^2 = 1\n"), Status::failed,
              {"sqrt(x) is not a number at ", "in an integral of 'c' (line 5): x is -0.3 there."});
  expect_said(failed("constrain c: exp(1e4*k + x) = 1 over [0, 1] every 0.5 weight 2\n"), Status::failed,
              {"exp(", "is beyond every number at 0 s, in 'c' (line 5)"});
  expect_said(failed("minimize o: integral(log(x))\niterate 0\n"), Status::failed,
              {"log(x) is not a number at ", "in 'o' (line 5): x is -0.3 there."});
  expect_said(failed("constrain c: x = sqrt(x) at 0 when t > 0.5\nminimize integral(x''^2)\n"), Status::converged, {});
}

TEST(NotFinite, InADerivativeOnly) {
  const Motion motion = run_scene("time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain c: sqrt(x) = 0 at 0.5\n");
  expect_said(motion, Status::failed,
              {"beyond every number at 0.5 s, in the derivative of 'c' (line 4): sqrt(x) is 0 there."});
}

TEST(NotFinite, WhatIfDoesNotChooseIsNotBlamed) {
  const Motion motion = run_scene(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x = -1\n"
      "constrain c: if(x > 0, sqrt(x), 0) + log(x) = 1 at 0.5\n");
  expect_said(motion, Status::failed, {"log(x) is not a number at 0.5 s, in 'c' (line 4): x is -1 there."});
}

TEST(NotFinite, AConditionThatCannotBeDecided) {
  const Motion motion = run_scene(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x = -1\nconstrain c: x = 1 at 0.5 when sqrt(x) < 2\n"
      "minimize integral(x''^2)\n");
  expect_said(motion, Status::converged,
              {"sqrt(x) is not a number at 0.5 s, in the condition of 'c' (line 4): x is -1 there. So the condition "
               "counts as not holding."});
}

}  // namespace
}  // namespace spacetime::optimizer
