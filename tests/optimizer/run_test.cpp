// Whole runs on small scenes: what is reached, and what is said where nothing can be.
#include "optimizer/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/bspline.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string double_integrator = R"(time [0, 1]
trajectory bspline spans 64
dof x
constrain start: (x, x') = 0      at 0
constrain goal:  (x, x') = (1, 0) at 1
minimize effort: integral(x''^2)
)";

// A problem that takes a few iterations: a pendulum swings up.
const std::string pendulum = R"(time [0, 2]
trajectory bspline spans 16
creature arm {
  gravity (0, -9.81, 0)
  link rod { revolute swing; offset -pi/2; a 1; mass 1; rod }
  point tip on rod (0, 0, 0)
}
constrain start: (arm.swing, arm.swing') = 0  at 0
constrain top:   arm.tip.y = 0.9      at 2
constrain still: arm.swing' = 0       at 2
minimize integral(arm.swing.force^2)
keyframe 0: arm.swing = 0
keyframe 2: arm.swing = 2
)";

double at(const Motion& motion, double t, int derivative = 0) {
  return value(motion.dofs[0].basis, motion.dofs[0].coefficients, t, derivative);
}

bool says(const Motion& motion, const std::string& part) { return motion.message.find(part) != std::string::npos; }

TEST(Run, DoubleIntegrator) {
  const Motion motion = run_scene(double_integrator);
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_EQ(motion.iterations, 1);
  EXPECT_NEAR(motion.objective, 12, 1e-9);
  EXPECT_LE(motion.violation, 1e-12);
  for (double t = 0; t <= 1; t += 0.01) EXPECT_NEAR(at(motion, t), 3 * t * t - 2 * t * t * t, 1e-10) << t;
}

TEST(Run, DoubleIntegratorOnUnevenKnots) {
  for (const char* knots : {"[0, 1]", "[0, 0.5, 1]", "[0, 0.02, 0.1, 0.5, 0.55, 0.9, 1]", "[0, 0.999, 1]"}) {
    std::string text = double_integrator;
    text.replace(text.find("spans 64"), 8, std::string("knots ") + knots);
    const Motion motion = run_scene(text);
    EXPECT_EQ(motion.status, Status::converged) << knots << ": " << motion.message;
    EXPECT_NEAR(motion.objective, 12, 1e-8) << knots;
    EXPECT_NEAR(at(motion, 0.3), 0.216, 1e-9) << knots;
  }
}

TEST(Run, OtherUnits) {
  // In millimetres, and in milliseconds.
  std::string far = double_integrator;
  far.replace(far.find("(1, 0)"), 6, "(1000, 0)");
  const Motion motion = run_scene(far);
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, 3);
  EXPECT_NEAR(motion.objective, 12e6, 1e-2);
  EXPECT_NEAR(at(motion, 0.5), 500, 1e-6);

  const Motion fast = run_scene(R"(time [0, 1e-3]
trajectory bspline spans 16
dof x
constrain (x, x') = 0      at 0
constrain (x, x') = (1, 0) at 1e-3
minimize integral(x''^2)
)");
  EXPECT_EQ(fast.status, Status::converged) << fast.message;
  EXPECT_LE(fast.iterations, 3);
  EXPECT_NEAR(fast.objective, 12e9, 1e2);
}

TEST(Run, NonlinearInOtherUnits) {
  // A degree of freedom of a thousand units: the limit on steps grows to them.
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 16
dof x
constrain start: (x, x') = 0 at 0
constrain goal:  sinh(x/1000) = 2*at(x, 0)/1000 + 1 at 1
minimize integral(x''^2)*1e-6 + integral(cos(x/1000))
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, 25);
  EXPECT_NEAR(at(motion, 1), 1000 * std::asinh(1.0), 1e-4);
}

TEST(Run, NothingToMinimise) {
  const Motion motion = run_scene("time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain exp(x) = 2 at 0.5\n");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(at(motion, 0.5), std::log(2), 1e-8);
  EXPECT_TRUE(motion.terms.empty());
}

TEST(Run, NothingAtAllToDo) {
  const Motion motion = run_scene("time [0, 1]\ntrajectory bspline spans 8\ndof x = 3\n");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_EQ(motion.iterations, 0);
  EXPECT_EQ(coefficients_of(motion), std::vector<double>(11, 3.0));
}

TEST(Run, ConstraintsSaidTwice) {
  const std::string again =
      "constrain once:  (x, x') = 0      at 0\nconstrain more:  (x, x') = (1, 0) at 1\nconstrain x*2 = 2 at 1\n";
  const Motion motion = run_scene(double_integrator + again);
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, 2);
  EXPECT_NEAR(motion.objective, 12, 1e-8);
}

TEST(Run, ContradictionsAreNamedAndMetHalfWay) {
  for (const char* start : {"0", "5", "-3", "0.5"}) {
    const Motion motion = run_scene(std::string("time [0, 1]\ntrajectory bspline spans 16\ndof x = ") + start + R"(
constrain low:  x = 0 at 0.5
constrain fine: x = 2 at 0
constrain high: x = 1 at 0.5
minimize integral(x''^2)
)");
    EXPECT_EQ(motion.status, Status::infeasible) << start;
    EXPECT_TRUE(says(motion,
                     "'low' (line 4, at 0.5 s) and 'high' (line 6, at 0.5 s) cannot hold together. To reconcile them "
                     "relax 'low' by 1 or 'high' by 1."))
        << motion.message;
    EXPECT_FALSE(says(motion, "'fine'")) << motion.message;
    EXPECT_NEAR(at(motion, 0.5), 0.5, 1e-6) << start;
    EXPECT_NEAR(at(motion, 0), 2, 1e-6) << start;
    ASSERT_EQ(motion.violations.size(), 3U);
    EXPECT_NEAR(motion.violations[0].max, 0.5, 1e-6);
    EXPECT_EQ(motion.violations[0].time, 0.5);
    EXPECT_EQ(motion.violations[0].line, 4);
    EXPECT_NEAR(motion.violation, 0.5, 1e-6);
  }
}

TEST(Run, WhatNoMotionCanDoIsInfeasible) {
  const Motion motion = run_scene(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x = 2\nconstrain never: x^2 = -1 at 0.5\nminimize "
      "integral(x''^2)\n");
  EXPECT_EQ(motion.status, Status::infeasible) << motion.message;
  EXPECT_TRUE(
      says(motion, "'never' (line 4, at 0.5 s) cannot hold by itself: no small change brings it nearer than 1."))
      << motion.message;
  EXPECT_NEAR(motion.violation, 1, 1e-6);
  EXPECT_LE(motion.iterations, 40);
}

// A start where no constraint has a gradient: no direction is better than another, and the outcome says so.
TEST(Run, AStartWithoutAnyGradientIsInfeasible) {
  const Motion motion = run_scene("time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain circle: x^2 = 1 at 0\n");
  EXPECT_EQ(motion.status, Status::infeasible) << motion.message;
  EXPECT_TRUE(says(motion, "'circle' (line 4, at 0 s) cannot hold by itself: no small change brings it nearer than 1."))
      << motion.message;
  EXPECT_TRUE(says(motion, "start from another sketch")) << motion.message;
}

TEST(Run, ANumberThatIsNoneFailsAndLeavesTheMotion) {
  const Motion motion =
      run_scene("time [0, 1]\ntrajectory bspline spans 8\ndof x = -1\nminimize root: integral(sqrt(x))\n");
  EXPECT_EQ(motion.status, Status::failed);
  EXPECT_TRUE(says(motion, "sqrt(x) is not a number at 0.008679 s, in 'root' (line 4): x is -1 there."))
      << motion.message;
  EXPECT_EQ(motion.iterations, 0);
  EXPECT_EQ(coefficients_of(motion), std::vector<double>(11, -1.0));
}

TEST(Run, StepsStayWhereNumbersAreFinite) {
  for (const char* start : {"100", "1e-3", "1.5"}) {
    const Motion motion = run_scene(std::string("time [0, 1]\ntrajectory bspline spans 8\ndof x = ") + start +
                                    "\nminimize integral(x - log(x))\n");
    EXPECT_EQ(motion.status, Status::converged) << motion.message;
    EXPECT_NEAR(motion.objective, 1, 1e-9);
    EXPECT_LE(motion.iterations, 20);
  }
}

TEST(Run, WithoutAnOptimumStopsAtTheLimit) {
  const Motion motion = run_scene(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain x = 0 at 0\nminimize integral(x)\nsolve iterations "
      "30\n");
  EXPECT_EQ(motion.status, Status::stopped) << motion.message;
  EXPECT_EQ(motion.iterations, 30);
  EXPECT_LT(motion.objective, 0);
}

TEST(Run, IterateZeroJudgesAndMovesNothing) {
  const Motion motion = run_scene(pendulum + "iterate 0\n");
  EXPECT_EQ(motion.status, Status::stopped);
  EXPECT_EQ(motion.iterations, 0);
  EXPECT_NEAR(at(motion, 2), 2, 1e-12);  // where the sketch ends
  EXPECT_GT(motion.objective, 1);
  ASSERT_EQ(motion.violations.size(), 3U);
  EXPECT_NEAR(motion.violations[1].max, 0.9 + std::cos(2.0), 1e-9);
  EXPECT_EQ(motion.violations[1].time, 2);

  // A motion that is an optimum already is called so without an iteration.
  RunOptions options;
  options.start = run_scene(pendulum);
  const Motion judged = run_scene(pendulum + "iterate 0\n", options);
  EXPECT_EQ(judged.status, Status::converged) << judged.message;
  EXPECT_EQ(judged.iterations, 0);
  EXPECT_EQ(coefficients_of(judged), coefficients_of(*options.start));
}

TEST(Run, KeyframesCountForTheResetsBehindThem) {
  const std::string head =
      "time [0, 1]\ntrajectory bspline spans 4\ndof x = 5\ndof y = 7\nminimize integral(x^2)\nkeyframe 0: x = 1\n";
  for (const auto& [actions, ends] : std::vector<std::pair<std::string, double>>{
           {"iterate 0\nkeyframe 1: x = 3\niterate 0\n", 1},
           {"iterate 0\nkeyframe 1: x = 3\nreset\niterate 0\n", 3},
           {"iterate 1\nreset\nkeyframe 1: x = 3\niterate 0\n", 1},
           {"iterate 1\nkeyframe 1: x = 3\ncontrol x 0 = 8\nreset\niterate 0\n", 3}}) {
    const Motion motion = run_scene(head + actions);
    EXPECT_NEAR(at(motion, 0), 1, 1e-12) << actions;
    EXPECT_NEAR(at(motion, 1), ends, 1e-12) << actions;
    EXPECT_EQ(motion.dofs[1].coefficients, std::vector<double>(7, 7.0));
  }
}

TEST(Run, IterateGoesSoFarAndNoFurther) {
  const Motion whole = run_scene(pendulum);
  ASSERT_EQ(whole.status, Status::converged) << whole.message;
  ASSERT_GT(whole.iterations, 4);
  const Motion three = run_scene(pendulum + "iterate 3\n");
  EXPECT_EQ(three.status, Status::stopped);
  EXPECT_EQ(three.iterations, 3);
  EXPECT_TRUE(says(three, "at iteration 3: no more were allowed")) << three.message;
  // Two and one are three, and going on leads to the same end.
  EXPECT_EQ(coefficients_of(run_scene(pendulum + "iterate 2\niterate 1\n")), coefficients_of(three));
  const Motion on = run_scene(pendulum + "iterate 3\nsolve\n");
  EXPECT_EQ(on.iterations, whole.iterations);
  EXPECT_EQ(coefficients_of(on), coefficients_of(whole));
  const Motion enough = run_scene(pendulum + "iterate 1000\n");
  EXPECT_EQ(enough.status, Status::converged);
  EXPECT_EQ(enough.iterations, whole.iterations);
}

TEST(Run, LimitsAndTolerances) {
  const Motion two = run_scene(pendulum + "solve iterations 2\n");
  EXPECT_EQ(two.status, Status::stopped);
  EXPECT_EQ(two.iterations, 2);
  EXPECT_TRUE(says(two, "no more were allowed")) << two.message;

  RunOptions options;
  options.iterations = 1;
  EXPECT_EQ(run_scene(pendulum + "solve iterations 2\n", options).iterations, 1);

  const int exact = run_scene(pendulum).iterations;
  const Motion coarse = run_scene(pendulum + "solve tolerance 0.1\n");
  EXPECT_EQ(coarse.status, Status::converged);
  EXPECT_LT(coarse.iterations, exact);
  EXPECT_LE(coarse.violation, 0.1);
  RunOptions strict;
  strict.tolerance = 1e-8;
  EXPECT_EQ(run_scene(pendulum + "solve tolerance 0.1\n", strict).iterations, exact);
}

TEST(Run, StartsFromAnotherMotion) {
  RunOptions options;
  options.start = run_scene(pendulum);
  const Motion again = run_scene(pendulum, options);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(again.status, Status::converged);

  // On a finer basis: fewer iterations than from the sketch, and a little better than before.
  const std::string finer = with_spans(pendulum, 32);
  const Motion cold = run_scene(finer), warm = run_scene(finer, options);
  EXPECT_EQ(warm.status, Status::converged) << warm.message;
  EXPECT_LT(warm.iterations, cold.iterations);
  EXPECT_LT(warm.objective, options.start->objective);
  EXPECT_NEAR(warm.objective, options.start->objective, 0.05 * warm.objective);
}

TEST(Run, AnInterruptionLeavesTheMotionReached) {
  int asked = 0;
  RunOptions options;
  options.interrupted = [&] { return asked++ == 3; };
  const Motion motion = run_scene(pendulum + "solve\nsolve\n", options);
  EXPECT_EQ(motion.status, Status::stopped);
  EXPECT_EQ(motion.iterations, 3);
  EXPECT_EQ(asked, 4);  // the second action is not begun
  EXPECT_TRUE(says(motion, "Interrupted at iteration 3")) << motion.message;
  EXPECT_EQ(coefficients_of(motion), coefficients_of(run_scene(pendulum + "iterate 3\n")));
}

TEST(Run, ProgressTellsEveryIteration) {
  std::vector<IterationRecord> lines;
  RunOptions options;
  options.progress = [&](const IterationRecord& line) { lines.push_back(line); };
  const Motion motion = run_scene(pendulum, options);
  ASSERT_EQ(static_cast<int>(lines.size()), motion.iterations + 1);
  for (std::size_t k = 0; k < lines.size(); ++k) EXPECT_EQ(lines[k].iteration, static_cast<int>(k));
  EXPECT_EQ(lines.front().step, 0);
  EXPECT_GT(lines[1].step, 0);
  EXPECT_GT(lines.front().violation, 0.1);
  EXPECT_LE(lines.back().violation, 1e-8);
  EXPECT_LE(lines.back().stationarity, 1e-8);
  EXPECT_NEAR(lines.back().objective, motion.objective, 1e-12 * motion.objective);
}

// What the objective is the sum of is told with each iteration, soft constraints and what lies outside a window too.
TEST(Run, ProgressTellsTheTerms) {
  const std::string text =
      "time [0, 1]\ntrajectory bspline spans 12\ndof x\nconstrain start: x = 0 at 0\n"
      "constrain near: x = 1 at 0.5, 1 weight 30\nminimize effort: integral(x''^2)\nminimize calm: integral(x'^2)\n"
      "iterate 1\ncontrol x 6 = 0.7\nwindow [0.4, 1]\nsolve\n";
  RunOptions options;
  options.record = true;
  const Motion motion = run_scene(text, options);
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  ASSERT_GE(motion.record.size(), 3U);
  for (const IterationRecord& record : motion.record) {
    ASSERT_EQ(record.terms.size(), 3U);
    EXPECT_EQ(record.terms[2].first, "near");
    double sum = 0;
    for (const auto& [name, value] : record.terms) sum += value;
    EXPECT_NEAR(sum, record.objective, 1e-9 * std::max(1.0, std::abs(sum)));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(motion.record.back().terms[k].first, motion.terms[k].first);
    EXPECT_NEAR(motion.record.back().terms[k].second, motion.terms[k].second, 1e-9);
  }
}

Motion without_seconds(Motion motion) {
  motion.seconds = {};
  return motion;
}

TEST(Run, TheSameTwiceToTheLastBit) {
  for (const std::string& text : {pendulum, file_text("examples/throw_regularised.scene"),
                                  file_text("tests/golden/p92.scene"), double_integrator}) {
    RunOptions options;
    options.frames_per_second = 30;
    const Motion first = without_seconds(run_scene(text, options)), second = without_seconds(run_scene(text, options));
    EXPECT_EQ(first, second);
    const auto a = coefficients_of(first), b = coefficients_of(second);
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
  }
}

TEST(Run, AMotionTellsEverything) {
  RunOptions options;
  options.frames_per_second = 10;
  const Motion motion = run_scene(pendulum + "let height = arm.tip.y\nconstant unused = 7\n", options);
  EXPECT_EQ(motion.start, 0);
  EXPECT_EQ(motion.end, 2);
  ASSERT_EQ(motion.dofs.size(), 1U);
  EXPECT_EQ(motion.dofs[0].name, "arm.swing");
  ASSERT_EQ(motion.terms.size(), 1U);
  EXPECT_EQ(motion.terms[0].first, "objective 1");
  EXPECT_EQ(motion.terms[0].second, motion.objective);
  ASSERT_EQ(motion.violations.size(), 3U);
  EXPECT_EQ(motion.violations[0].name, "start");
  EXPECT_EQ(motion.constants, (std::vector<std::pair<std::string, double>>{{"unused", 7}}));
  EXPECT_GE(motion.seconds.total, motion.seconds.evaluate + motion.seconds.factor);
  EXPECT_GT(motion.seconds.evaluate, 0);
  ASSERT_TRUE(motion.samples);
  ASSERT_EQ(motion.samples->times.size(), 21U);
  const auto& height = motion.samples->values.at("height");
  EXPECT_NEAR(height.front().at(0), -1, 1e-8);
  EXPECT_NEAR(height.back().at(0), 0.9, 1e-8);
}

TEST(Run, RefusesWhatConstantsMakeNonsense) {
  Problem problem = problem_of(
      "time [0, 1]\nconstant when = 0.5\ntrajectory bspline spans 4\ndof x\nconstrain x = 1 at when\nminimize "
      "integral(x^2, 0, when) + at(x, when)\nkeyframe when: x = 1\n");
  EXPECT_EQ(run(problem, {}).violations[0].time, 0.5);
  problem.constants[0].value.number = 1.5;
  EXPECT_THROW(run(problem, {}), InputError);
}

}  // namespace
}  // namespace spacetime::optimizer
