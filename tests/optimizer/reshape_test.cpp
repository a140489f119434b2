// Actions that change the motion itself: shake, filter, key, damp, refine.
#include "optimizer/reshape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "optimizer/quadrature.h"
#include "optimizer/refine.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string head = R"(time [0, 2]
trajectory bspline spans 32
dof x = 0.3
dof y = 0.1
minimize bend: integral(1e-3*x''^2 + 1e-6*y''^2 + (x - sin(7*t))^2 + (y - cos(40*t)/2)^2*100)
)";

double bending(const Trajectory& curve) {
  const auto rule = gauss_legendre(breakpoints(curve.basis), 0, 2);
  double sum = 0;
  for (std::size_t s = 0; s < rule.times.size(); ++s) {
    sum += rule.weights[s] * std::pow(value(curve.basis, curve.coefficients, rule.times[s], 2), 2);
  }
  return sum;
}

double at(const Trajectory& curve, double t, int derivative = 0) {
  return value(curve.basis, curve.coefficients, t, derivative);
}

double largest_difference(const Trajectory& a, const Trajectory& b) {
  double largest = 0;
  for (int k = 0; k <= 1000; ++k) largest = std::max(largest, std::abs(at(a, 0.002 * k) - at(b, 0.002 * k)));
  return largest;
}

std::string message_of(const Action& action) {
  Problem problem = problem_of(head);
  problem.actions = {{action, {6, 1}}};
  try {
    run(problem, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Shake, StaysWithinItsAmplitudeAndTheWindow) {
  const Motion before = run_scene(head + "iterate 0\n");
  const Motion all = run_scene(head + "shake amplitude 0.2 seed 7\niterate 0\n");
  const double moved = largest_difference(before.dofs[0], all.dofs[0]);
  EXPECT_LE(moved, 0.2);
  EXPECT_GT(moved, 0.02);
  EXPECT_GT(largest_difference(all.dofs[0], all.dofs[1]), 0.25);  // each has a curve of its own
  EXPECT_LT(bending(all.dofs[0]), 0.2 * 0.2 * 1e5);               // smooth: eight spans, not thirty-two

  const Motion some = run_scene(head + "window [0.5, 1.5] of y\nshake amplitude 0.2 seed 7\niterate 0\n");
  EXPECT_EQ(some.dofs[0], before.dofs[0]);
  EXPECT_NE(some.dofs[1], before.dofs[1]);
  EXPECT_EQ(at(some.dofs[1], 0.49), at(before.dofs[1], 0.49));
  EXPECT_EQ(at(some.dofs[1], 1.51), at(before.dofs[1], 1.51));
}

TEST(Shake, OneSeedOneCurve) {
  const std::string once = head + "shake amplitude 0.2 seed 3 of x\niterate 0\n";
  EXPECT_EQ(run_scene(once).dofs, run_scene(once).dofs);
  EXPECT_NE(run_scene(once).dofs, run_scene(head + "shake amplitude 0.2 seed 4 of x\niterate 0\n").dofs);
  // Without a seed the first is 1, the second 2.
  EXPECT_EQ(run_scene(head + "shake amplitude 0.1\nshake amplitude 0.1\niterate 0\n").dofs,
            run_scene(head + "shake amplitude 0.1 seed 1\nshake amplitude 0.1 seed 2\niterate 0\n").dofs);
}

TEST(Filter, SmoothsAndKeepsTheEnds) {
  const Motion before = run_scene(head + "solve\n");
  const Motion after = run_scene(head + "solve\nfilter strength 0.3 of y\niterate 0\n");
  EXPECT_EQ(after.dofs[0], before.dofs[0]);
  const Trajectory &rough = before.dofs[1], &fine = after.dofs[1];
  EXPECT_LT(bending(fine), 0.2 * bending(rough));
  for (const double end : {0.0, 2.0}) {
    EXPECT_NEAR(at(fine, end), at(rough, end), 1e-15);
    EXPECT_NEAR(at(fine, end, 1), at(rough, end, 1), 1e-13);
  }
  // In a window: C2 at its ends and nothing outside.
  const Motion windowed = run_scene(head + "solve\nwindow [0.5, 1.5]\nfilter strength 0.3\niterate 0\n");
  EXPECT_LT(bending(windowed.dofs[1]), bending(rough));
  EXPECT_EQ(at(windowed.dofs[1], 0.5, 2), at(rough, 0.5, 2));
  EXPECT_EQ(at(windowed.dofs[1], 1.6), at(rough, 1.6));
}

// A sine of the filter's own period is halved, whatever its phase.
TEST(Filter, HalvesWigglesOfItsPeriod) {
  const std::string wiggle =
      "time [0, 8]\ntrajectory bspline spans 256\ndof x\nminimize integral(1e6*(x - sin(2*pi*t))^2)\nsolve\n";
  const Motion after = run_scene(wiggle + "filter strength 1\niterate 0\n");
  for (const double t : {3.25, 3.75, 4.25}) EXPECT_NEAR(at(after.dofs[0], t), 0.5 * std::sin(2 * M_PI * t), 0.01) << t;
}

TEST(Key, IsMetExactlyByALocalChange) {
  const Motion before = run_scene(head + "solve\n");
  const Motion after = run_scene(head + "solve\nkey 0.77: x = 1.25, y = -0.5\niterate 0\n");
  EXPECT_NEAR(at(after.dofs[0], 0.77), 1.25, 1e-15);
  EXPECT_NEAR(at(after.dofs[1], 0.77), -0.5, 1e-15);
  const double change = 1.25 - at(before.dofs[0], 0.77);
  for (const double t : {0.0, 0.2, 1.4, 2.0}) {
    EXPECT_LE(std::abs(at(after.dofs[0], t) - at(before.dofs[0], t)), 0.05 * std::abs(change)) << t;
  }
  const Motion windowed = run_scene(head + "solve\nwindow [0.5, 1.5] of x\nkey 0.77: x = 1.25\niterate 0\n");
  EXPECT_NEAR(at(windowed.dofs[0], 0.77), 1.25, 1e-15);
  EXPECT_EQ(at(windowed.dofs[0], 0.45), at(before.dofs[0], 0.45));
  const Motion refused = run_scene(head + "iterate 1\nwindow [0.5, 1.5] of y\nkey 0.77: x = 1\n");
  EXPECT_NE(refused.message.find("nothing of 'x' is free at 0.77 s"), std::string::npos) << refused.message;
}

TEST(Damp, IsNeverExceeded) {
  const std::string scene = head + "constrain x = 4 at 1\nconstrain y^2 + x = 5 at 1.5\ndamp 0.125 of x\nsolve\n";
  const Problem problem = problem_of(scene);
  std::string replay = scene.substr(0, scene.rfind("solve"));
  Motion before = run_scene(replay + "iterate 0\n");
  const int all = run(problem, {}).iterations;
  ASSERT_GT(all, 20);
  bool reached = false;
  for (int k = 0; k < all; ++k) {
    replay += "iterate 1\n";
    const Motion after = run_scene(replay);
    const double x = largest_difference(before.dofs[0], after.dofs[0]);
    EXPECT_LE(x, 0.125) << k;
    for (std::size_t c = 0; c < after.dofs[0].coefficients.size(); ++c) {
      EXPECT_LE(std::abs(after.dofs[0].coefficients[c] - before.dofs[0].coefficients[c]), 0.125) << k;
    }
    reached |= x > 0.1;
    before = after;
  }
  EXPECT_TRUE(reached);
  EXPECT_EQ(before.status, Status::converged) << before.message;
}

TEST(Damp, IsNeverExceededByThePapersMethods) {
  const std::string scene = head + "constrain x = 4 at 1\nconstrain y^2 + x = 5 at 1.5\ndamp 0.0625 of x\n";
  for (const std::string method : {"sqp92", "bfgs"}) {
    Motion before = run_scene(scene + "iterate 0\n");
    bool reached = false;
    for (int k = 1; k <= 12; ++k) {
      const Motion after = run_scene(scene + "solve method " + method + " iterations " + std::to_string(k) + "\n");
      double most = 0;
      for (std::size_t c = 0; c < after.dofs[0].coefficients.size(); ++c) {
        most = std::max(most, std::abs(after.dofs[0].coefficients[c] - before.dofs[0].coefficients[c]));
      }
      EXPECT_LE(most, 0.0625) << method << ", iteration " << k;
      reached |= most > 0.06;
      before = after;
    }
    EXPECT_TRUE(reached) << method;
  }
}

TEST(Refine, DoesNotChangeTheMotion) {
  const Motion before = run_scene(head + "solve\n");
  const Motion after = run_scene(head + "solve\nrefine [0.4, 0.9] of x times 2\nrefine [0, 2] of y\niterate 0\n");
  // [0.4, 0.9] overlaps the spans from 0.375 to 0.9375, nine of them, then seventeen of the halves.
  EXPECT_EQ(after.dofs[0].coefficients.size(), 35 + 9 + 17);
  EXPECT_EQ(after.dofs[1].coefficients.size(), 35 + 32);
  for (int dof = 0; dof < 2; ++dof) {
    EXPECT_LE(largest_difference(before.dofs[dof], after.dofs[dof]), 1e-14);
  }
}

TEST(Refine, TouchingInAPointIsNotOverlapping) {
  const Motion after = run_scene(head + "refine [0.5, 0.625] of x\niterate 0\n");
  EXPECT_EQ(after.dofs[0].coefficients.size(), 35 + 2);
}

// A kink that the coarse knots cannot follow: knots come there and not elsewhere.
TEST(Refine, AutomaticallyWhereTheMotionWouldChange) {
  const std::string scene =
      "time [0, 2]\ntrajectory bspline spans 16\ndof x\nminimize integral((x - tanh(40*(t - 0.7)))^2 + "
      "1e-9*x''^2)\nsolve\n";
  const Motion after = run_scene(scene + "refine auto tolerance 0.01\nsolve\nrefine auto tolerance 0.01\nsolve\n");
  const auto knots = breakpoints(after.dofs[0].basis);
  EXPECT_GT(knots.size(), 19U);
  EXPECT_LT(knots.size(), 17U + 2 * 16);
  double narrowest = 1, where = 0;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    if (knots[k + 1] - knots[k] < narrowest) {
      narrowest = knots[k + 1] - knots[k];
      where = knots[k];
    }
  }
  EXPECT_EQ(narrowest, 2.0 / 64);
  EXPECT_NEAR(where, 0.7, 0.3);
  const auto span_at = [&](double t) {
    const auto next = std::ranges::upper_bound(knots, t);
    return *next - *(next - 1);
  };
  EXPECT_EQ(span_at(1.9), 2.0 / 16);
  EXPECT_EQ(run_scene("time [0, 2]\ntrajectory bspline spans 16\ndof x\nminimize integral((x - t^2)^2)\nsolve\n"
                      "refine auto tolerance 1e-6\niterate 0\n")
                .dofs[0]
                .coefficients.size(),
            19U);
}

// A message may name degrees of freedom: the others keep their knots, in the trial as well.
TEST(Refine, AutomaticallyOnlyWhatIsNamed) {
  Problem problem = problem_of(
      "time [0, 2]\ntrajectory bspline spans 16\ndof x\ndof y\nminimize integral((x - tanh(40*(t - 0.7)))^2 + "
      "(y - tanh(40*(t - 0.7)))^2 + 1e-9*(x''^2 + y''^2))\nsolve\nrefine auto tolerance 0.01\n");
  Refine& action = std::get<Refine>(problem.actions.back().action);
  EXPECT_EQ(refined_coefficients(problem, evaluate_constants(problem), most_of(action)), 2 * (19 + 16));
  action.dofs = {"y"};
  EXPECT_EQ(refined_coefficients(problem, evaluate_constants(problem), most_of(action)), 19 + 19 + 16);
  const Motion after = run(problem, {});
  EXPECT_EQ(after.dofs[0].coefficients.size(), 19U);
  EXPECT_GT(after.dofs[1].coefficients.size(), 19U);
}

// Scenes are checked by the language; messages may bring anything.
TEST(Reshape, Refusals) {
  const auto is = [](double number) { return Quantity{number, {}, 0}; };
  EXPECT_EQ(message_of(Smooth{is(0), {}}), "line 6: the strength of a filter, 0 s, must be positive");
  EXPECT_EQ(message_of(Damp{is(-1), {}}), "line 6: the limit of `damp`, -1, must be positive");
  EXPECT_EQ(message_of(Refine{{}, {}, 1, is(0)}), "line 6: the tolerance of `refine auto`, 0, must be positive");
  EXPECT_EQ(message_of(Refine{{}, {}, 30, {}}), "line 6: more than 1048576 coefficients: refine fewer times");
  EXPECT_EQ(message_of(Refine{Interval{is(2), is(3)}, {}, 1, {}}),
            "line 6: the interval [2, 3] does not meet the animation's time, [0, 2]");
  EXPECT_EQ(message_of(PullKeys{is(3), {}}), "line 6: the key's time 3 lies outside the animation's, 0 to 2");
  EXPECT_EQ(message_of(Control{"x", 35, is(0)}), "line 6: 'x' has 35 coefficients, numbered from 0");
  EXPECT_EQ(message_of(Shake{is(1), {}, {"z"}}), "line 6: there is no degree of freedom 'z'");
}

}  // namespace
}  // namespace spacetime::optimizer
