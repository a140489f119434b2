// Inequalities, bounds, conditions and parameters, against problems with known answers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "optimizer/transcription.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

double at(const Motion& motion, int dof, double t, int derivative = 0) {
  return value(motion.dofs[dof].basis, motion.dofs[dof].coefficients, t, derivative);
}

// Bryson and Denham: J = 4/(9 l) for 1/l >= 6.
std::string bryson_denham(double l, const std::string& bound, const std::string& constraint) {
  return "time [0, 1]\nconstant l = " + std::to_string(l) + "\ntrajectory bspline spans 64\ndof x" + bound +
         "\nconstrain (x, x') = (0, 1) at 0\nconstrain (x, x') = (0, -1) at 1\n" + constraint +
         "minimize integral(x''^2) weight 0.5\n";
}

TEST(Limits, BrysonDenhamAsInstancesAndAsABound) {
  for (const double l : {1.0 / 12, 1.0 / 9, 0.15}) {
    const double best = 4 / (9 * std::stod(std::to_string(l)));
    for (const auto& text : {bryson_denham(l, "", "constrain x <= l\n"), bryson_denham(l, " in [-1, l]", "")}) {
      const Motion motion = run_scene(text);
      EXPECT_EQ(motion.status, Status::converged) << motion.message;
      EXPECT_NEAR(motion.objective, best, 1e-4) << "l = " << l;
      EXPECT_LE(motion.violation, 1e-8);
    }
  }
}

TEST(Limits, AChainHoldsBothSides) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 16
dof x
constrain (x, x') = 0 at 0
constrain -0.2 <= x <= 0.3 over [0, 1] count 33
minimize integral((x - sin(9*t))^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  double low = 0, high = 0;
  for (int k = 0; k <= 32; ++k) {
    low = std::min(low, at(motion, 0, k / 32.0));
    high = std::max(high, at(motion, 0, k / 32.0));
  }
  EXPECT_NEAR(high, 0.3, 1e-6);
  EXPECT_NEAR(low, -0.2, 1e-6);
}

// min integral x''^2 with x(1) pulled to 1 softly, only from below: 12 X^2 ... with x' free at the end it is 3 X^2.
TEST(Limits, ASoftInequalityAsksOnlyWhereItIsViolated) {
  const std::string head = "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain (x, x') = 0 at 0\n";
  // 3 X^2 + 5 (1 - X)^2 is least at X = 5/8.
  const Motion pulled = run_scene(head + "constrain reach: x >= 1 at 1 weight 10\nminimize integral(x''^2)\n");
  EXPECT_EQ(pulled.status, Status::converged) << pulled.message;
  EXPECT_NEAR(at(pulled, 0, 1), 5.0 / 8, 1e-7);
  const Motion idle = run_scene(head + "constrain reach: x <= 1 at 1 weight 10\nminimize integral(x''^2)\n");
  EXPECT_EQ(idle.status, Status::converged) << idle.message;
  EXPECT_NEAR(at(idle, 0, 1), 0, 1e-9);
}

TEST(Limits, AConditionOnTimeKeepsItsInstancesOnly) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 20
dof x
constrain x = 1 over [0, 1] every 0.05 when t < 0.31
minimize integral((x - 2)^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(at(motion, 0, 0.3), 1, 1e-8);
  EXPECT_GT(at(motion, 0, 0.5), 1.5);
}

TEST(Limits, AConditionOnTheMotionHoldsWhereItApplies) {
  // The point must be above the table only while it is over it.
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 16
dof x
dof y
constrain (x, y) = (0, 0.5) at 0
constrain (x, y) = (2, -1) at 1
constrain table: y >= 0 over [0, 1] count 33 when x < 1
minimize integral(x''^2 + y''^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  for (int k = 0; k <= 32; ++k) {
    const double below = at(motion, 0, k / 32.0) < 1 ? -at(motion, 1, k / 32.0) : 0;
    EXPECT_LE(below, 1e-7);
  }
}

TEST(Limits, AParameterIsChosenWithTheMotion) {
  const Motion motion = run_scene(R"(time [0, 1]
constant m = 0.5
parameter k = 2 in [0, 20]
trajectory bspline spans 32
dof x = 0.5
constrain (x, x') = (1, 0) at 0
constrain (x, x') = (-1, 0) at 1
minimize integral((m*x'' + k*x)^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  ASSERT_EQ(motion.parameters.size(), 1U);
  EXPECT_NEAR(motion.parameters[0].second, 0.5 * std::numbers::pi * std::numbers::pi, 1e-5);
}

TEST(Limits, ARowThatDoesNotCountMayBeNoNumber) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 16
dof x
constrain (x, x') = 0 at 0
constrain (x, x') = (1, 0) at 1
constrain sqrt(x - 0.2) = 0.9 at 0.3 when x > 0.9
minimize integral(x''^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.objective, 12, 1e-6);
}

TEST(Limits, BoundsThatLeaveNoRoomAreRefused) {
  Problem problem = problem_of("time [0, 1]\ntrajectory bspline spans 4\ndof x in [0, 1]\nminimize integral(x^2)\n");
  problem.dofs[0].upper->number = 0;
  EXPECT_THROW(transcribe(problem), InputError);
}

}  // namespace
}  // namespace spacetime::optimizer
