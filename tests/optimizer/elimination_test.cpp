// What is eliminated and what is held by constraints end at the same optimum, where the curve that is held can follow
// exactly what holds it: then both scenes speak of the same motions.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const Trajectory& curve(const Motion& motion, const std::string& name) {
  const auto found = std::ranges::find(motion.dofs, name, &Trajectory::name);
  EXPECT_NE(found, motion.dofs.end()) << name;
  return *found;
}

void expect_same_curve(const Motion& a, const Motion& b, const std::string& name) {
  const auto &left = curve(a, name).coefficients, &right = curve(b, name).coefficients;
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_NEAR(left[i], right[i], 1e-7) << name << ' ' << i;
}

struct Pair {
  Motion held, eliminated;
};

Pair solved(const std::string& common, const std::string& held, const std::string& eliminated) {
  Pair out{run_scene(common + held), run_scene(common + eliminated)};
  EXPECT_EQ(out.held.status, Status::converged) << out.held.message;
  EXPECT_EQ(out.eliminated.status, Status::converged) << out.eliminated.message;
  EXPECT_GT(out.held.dofs.size(), out.eliminated.dofs.size());
  EXPECT_NEAR(out.held.objective, out.eliminated.objective, 1e-9 * out.held.objective);
  return out;
}

// A lift's hand is a spline, so a ball can be in it exactly: n spans need n + 3 instances.  The flight is a parabola,
// which a spline can follow as well, once the hand falls with
// the ball at the moment of the release.
TEST(Elimination, OfABallWhileItIsHeldEndsWhereTheConstraintsEnd) {
  const std::string common = R"(
time [0, 2]
constant g = 9.81
trajectory bspline spans 16
creature lift {
  gravity (0, -g, 0)
  link cart { prismatic right axis (1, 0, 0); mass 2 }
  link hand { prismatic up axis (0, 1, 0); mass 1 }
}
creature ball {
  gravity (0, -g, 0)
  link slideX { prismatic X axis (1, 0, 0) }
  link slideY { prismatic Y axis (0, 1, 0); mass 0.2 }
}
minimize energy: integral(dot(lift.force, lift.force))
constrain rest: (lift.q, lift.q') = 0 at 0, 2
)";
  const std::string held = R"(
constrain held: (ball.X, ball.Y) = (lift.right, lift.up) over [0, 1] count 11
constrain flight: ball.force = 0 over [1, 2]
constrain falling: (lift.right'', lift.up'') = (0, -g) at 1
constrain goal: (ball.X, ball.Y) = (2.5, 0.5) at 1.75
)";
  const std::string eliminated = R"(
define flown(h) = at(h, 1) + at(h', 1)*(t - 1)
eliminate ball.X = if(t < 1, lift.right, flown(lift.right))
eliminate ball.Y = if(t < 1, lift.up, flown(lift.up) - g/2*(t - 1)^2)
constrain falling: (lift.right'', lift.up'') = (0, -g) at 1
constrain goal: (ball.X, ball.Y) = (2.5, 0.5) at 1.75
)";
  const Pair pair = solved(common, held, eliminated);
  for (const std::string name : {"lift.right", "lift.up"}) expect_same_curve(pair.held, pair.eliminated, name);
}

// Two links of one length whose hand stays on a line: a sin q1 + a sin(q1 + q2) = 0, so q2 = -2 q1.
TEST(Elimination, OfAnArmsAngleEndsWhereTheConstraintsEnd) {
  const std::string common = R"(
time [0, 1]
trajectory bspline spans 12
creature arm {
  gravity (0, -9.81, 0)
  link upper { revolute shoulder; a 0.5; mass 2; rod }
  link fore { revolute elbow; a 0.5; mass 1.5; rod }
}
)";
  const std::string goals = R"(
constrain begin: (arm.shoulder, arm.shoulder') = (0.2, 0) at 0
constrain end: (arm.shoulder, arm.shoulder') = (1.2, 0) at 1
minimize energy: integral(dot(arm.force, arm.force))
)";
  const Pair pair = solved(common, "constrain rail: arm.fore.y = 0 over [0, 1] count 15\n" + goals,
                           "eliminate arm.elbow = -2*arm.shoulder\n" + goals);
  expect_same_curve(pair.held, pair.eliminated, "arm.shoulder");
  const auto &shoulder = curve(pair.held, "arm.shoulder").coefficients,
             &elbow = curve(pair.held, "arm.elbow").coefficients;
  for (std::size_t i = 0; i < elbow.size(); ++i) EXPECT_NEAR(elbow[i], -2 * shoulder[i], 1e-8);
}

}  // namespace
}  // namespace spacetime::optimizer
