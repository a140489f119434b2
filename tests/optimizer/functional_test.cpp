// Functionals that couple distant times, against problems of the calculus of variations with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/bspline.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string head = "time [0, 1]\ntrajectory bspline spans 16\ndof x\n";

Motion converged(const std::string& text, int most_iterations) {
  const Motion motion = run_scene(text);
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, most_iterations);
  EXPECT_LE(motion.violation, 1e-7);
  return motion;
}

double at(const Motion& motion, int dof, double t, int derivative = 0) {
  return value(motion.dofs[dof].basis, motion.dofs[dof].coefficients, t, derivative);
}

TEST(Functional, ADifferenceOfEndsInTheObjective) {
  // From rest to rest over X: 12 X^2 + 4 (X - 2)^2, so X = 1/2.
  const Motion motion = converged(head + R"(constrain (x, x') = 0 at 0
constrain x' = 0 at 1
minimize integral(x''^2) + 4*(at(x, 1) - at(x, 0) - 2)^2
)",
                                  1);
  EXPECT_NEAR(motion.objective, 12, 1e-9);
  EXPECT_NEAR(at(motion, 0, 1), 0.5, 1e-9);
}

TEST(Functional, ASquaredIntegralInTheObjective) {
  // For c = integral(x) the best is 12 c^2; 12 c^2 + 4 (c - 1)^2 at c = 1/4.
  const Motion motion =
      converged(head + "constrain x = 0 at 0, 1\nminimize integral(x'^2) + 4*(integral(x) - 1)^2\n", 1);
  EXPECT_NEAR(motion.objective, 3, 1e-9);
  EXPECT_NEAR(at(motion, 0, 0.5), 6 * 0.25 / 4, 1e-9);
}

// Without any other objective the functional's own curvature is all there is.
TEST(Functional, ASquareAlone) {
  const Motion motion =
      converged(head + "constrain x'' = 0\nminimize (at(x, 0) + 2*at(x, 1) - 3)^2 + at(x', 0)^2\n", 3);
  EXPECT_NEAR(motion.objective, 0, 1e-12);
  EXPECT_NEAR(at(motion, 0, 0.3), 1, 1e-6);
}

TEST(Functional, AnAreaUnderTheLowestString) {
  // min integral(x'^2) with integral(x) = c: the parabola 6 c t (1 - t), 12 c^2.
  const Motion motion =
      converged(head + "constrain x = 0 at 0, 1\nconstrain area: integral(x) = 3\nminimize integral(x'^2)\n", 1);
  EXPECT_NEAR(motion.objective, 108, 1e-8);
  for (double t = 0; t <= 1; t += 0.05) EXPECT_NEAR(at(motion, 0, t), 18 * t * (1 - t), 1e-9);
}

TEST(Functional, TwoIntegralsAreEqual) {
  // With integrals c: x = t + 6 (c - 1/2) t (1 - t) costs 1 + 12 (c - 1/2)^2, y costs 12 c^2; best at c = 1/4.
  const Motion motion = converged(head + R"(dof y
constrain (x, y) = 0      at 0
constrain (x, y) = (1, 0) at 1
constrain balance: integral(x) = integral(y)
minimize integral(x'^2 + y'^2)
)",
                                  1);
  EXPECT_NEAR(motion.objective, 2.5, 1e-9);
}

// Dido: the largest area under a rope of given length is that under an arc. With half its angle 1 rad and chord 1, the
// rope is 1/sin(1) long and the area (1 - sin(1) cos(1)) / (4 sin(1)^2).
TEST(Functional, TheLargestAreaUnderARope) {
  const Motion motion = converged(R"(time [0, 1]
trajectory bspline spans 32
dof x
constrain x = 0 at 0, 1
constrain rope: integral(sqrt(1 + x'^2)) = 1/sin(1)
minimize -integral(x)
keyframe 0: x = 0
keyframe 0.5: x = 0.3
keyframe 1: x = 0
)",
                                  100);
  const double s = std::sin(1.0), c = std::cos(1.0), radius = 1 / (2 * s);
  EXPECT_NEAR(motion.objective, -(1 - s * c) / (4 * s * s), 1e-7);
  for (double t = 0; t <= 1; t += 0.05) {
    const double arc = std::sqrt(radius * radius - (t - 0.5) * (t - 0.5)) - radius * c;
    EXPECT_NEAR(at(motion, 0, t), arc, 2e-6) << t;
  }
}

// The same from a straight start, where the rope's row has no gradient at all.
TEST(Functional, TheRopeStraightAtFirst) {
  const Motion motion = converged(head + R"(constrain x = 0 at 0, 1
constrain rope: integral(sqrt(1 + x'^2)) = 1/sin(1)
minimize -integral(x)
)",
                                  30);
  EXPECT_NEAR(motion.objective, -0.1925475, 1e-6);
}

TEST(Functional, NestedInTheObjective) {
  // A line of slope 1 with mean 3: its variance is 1/12.
  const Motion motion = converged(head + R"(constrain x' = 1 at 0
constrain line: x'' = 0
let mean = integral(x)
minimize spread: integral((x - mean)^2)
minimize place: (mean - 3)^2
)",
                                  2);
  EXPECT_NEAR(motion.objective, 1.0 / 12, 1e-10);
  EXPECT_NEAR(at(motion, 0, 0), 2.5, 1e-8);
}

// Of all curves of variance 1 the least integral(x'^2) is pi^2: the first eigenvalue of a free string.
TEST(Functional, NestedInAConstraint) {
  const Motion motion = converged(head + R"(let mean = integral(x)
constrain place:  mean = 2
constrain spread: integral((x - mean)^2) = 1
minimize integral(x'^2)
keyframe 0: x = 0
keyframe 1: x = 1
)",
                                  15);
  EXPECT_NEAR(motion.objective, std::numbers::pi * std::numbers::pi, 1e-6);
  EXPECT_NEAR(std::abs(at(motion, 0, 0) - 2), std::numbers::sqrt2, 1e-5);
}

TEST(Functional, OverAPartOfTheTime) {
  // Only the first third is asked for: x rises to its mean 1 there at no cost in x', but for x(0) = 0.
  const Motion motion = converged(head + R"(constrain x = 0 at 0
constrain part: integral(x, 0, 0.3)/0.3 = 1
minimize integral(x'^2)
)",
                                  5);
  // x'' = -m on [0, h], x' = 0 after: x = a (2 h t - t^2)/h^2 with mean 2a/3; cost 4 a^2 / (3 h), a = 3/2; and the
  // spline, smoother than that, costs a little more.
  EXPECT_GT(motion.objective, 3 / 0.3);
  EXPECT_LT(motion.objective, 3 / 0.3 * 1.001);
}

TEST(Functional, InARelationWithATimeOfItsOwn) {
  // x(t) = t * (what x is at the end), which is 2: a line.
  const Motion motion = converged(
      head + "constrain x = 2 at 1\nconstrain ray: x = t*at(x, 1) over [0, 1] every 0.05\nminimize integral(x^2)\n", 3);
  EXPECT_NEAR(at(motion, 0, 0.4), 0.8, 1e-8);
  EXPECT_NEAR(motion.objective, 4.0 / 3, 1e-7);
}

}  // namespace
}  // namespace spacetime::optimizer
