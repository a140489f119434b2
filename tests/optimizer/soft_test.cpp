// Soft constraints, against the optima of quadratics.
#include <gtest/gtest.h>

#include <cmath>

#include "common/bspline.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string head = R"(time [0, 1]
trajectory bspline spans 8
dof x
constrain ends: (x, x', at(x', 1)) = 0  at 0
minimize energy: integral(x''^2)
)";

// From rest to rest over a distance X costs 12 X^2; missing 1 costs w/2 (X - 1)^2:  X = w / (24 + w).
TEST(Soft, PullsAsFarAsItsWeightPays) {
  for (const double w : {1e-3, 1.0, 24.0, 1e3, 1e6}) {
    SCOPED_TRACE(w);
    const Motion motion = run_scene(head + "constrain goal: x = 1 at 1 weight " + std::to_string(w) + "\n");
    EXPECT_EQ(motion.status, Status::converged) << motion.message;
    EXPECT_EQ(motion.iterations, 1);
    const double distance = w / (24 + w), energy = 12 * distance * distance;
    const double price = w / 2 * (distance - 1) * (distance - 1);
    EXPECT_NEAR(motion.objective, energy + price, 1e-9 * (energy + price));
    ASSERT_EQ(motion.terms.size(), 2U);
    EXPECT_EQ(motion.terms[0].first, "energy");
    EXPECT_NEAR(motion.terms[0].second, energy, 1e-8 * energy);
    EXPECT_EQ(motion.terms[1].first, "goal");
    EXPECT_NEAR(motion.terms[1].second, price, 1e-8 * price);
    // What is soft is no violation.
    ASSERT_EQ(motion.violations.size(), 1U);
    EXPECT_EQ(motion.violations[0].name, "ends");
    EXPECT_LE(motion.violation, 1e-8);
  }
}

TEST(Soft, EachInstanceAndComponentCounts) {
  // Three instances of two components, each pulling a constant towards another value.
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 4
dof x
constrain still: x' = 0 at 0
constrain line: x'' = 0
constrain (x, x) = (1, 3) at 0, 0.5, 1 weight 2
constrain x = 8 at 0.25 weight 4
minimize integral(x''^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  const double mean = (3 * 2 * 1 + 3 * 2 * 3 + 4 * 8) / 16.0;
  EXPECT_NEAR(motion.dofs[0].coefficients[3], mean, 1e-8);
  const double price = 3 * (std::pow(mean - 1, 2) + std::pow(mean - 3, 2)) + 2 * std::pow(mean - 8, 2);
  EXPECT_NEAR(motion.objective, price, 1e-8);
}

TEST(Soft, OfInfiniteWeightIsHard) {
  const Motion motion = run_scene(head + "constrain goal: x = 1 at 1 weight inf\n");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.objective, 12, 1e-9);
  ASSERT_EQ(motion.violations.size(), 2U);
  EXPECT_EQ(motion.violations[1].name, "goal");
}

TEST(Soft, OfNoWeightAsksNothing) {
  const Motion motion = run_scene(head + "constant w = 0\nconstrain goal: x = 1 at 1 weight w\n");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_EQ(motion.objective, 0);
  ASSERT_EQ(motion.terms.size(), 2U);
  EXPECT_EQ(motion.terms[1].second, 0);
}

TEST(Soft, OfNegativeWeightIsRefused) {
  Problem problem = problem_of(head + "constant w = 1\nconstrain goal: x = 1 at 1 weight w\n");
  problem.constants[0].value.number = -1;
  EXPECT_THROW(run(problem, {}), InputError);
}

TEST(Soft, ContradictionsSettleByWeight) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 8
dof x
constrain a: x = 0 at 0.5 weight 3
constrain b: x = 1 at 0.5 weight 1
minimize 1e-3*integral(x''^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.objective, 3.0 / 2 * 0.0625 + 1.0 / 2 * 0.5625, 1e-9);
}

// The exact Hessian of a soft constraint that bends: w J^T J alone would not converge in so few iterations.
TEST(Soft, ConvergesQuadraticallyWithLargeResiduals) {
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 8
dof x = 1
constrain x^2 = -3 over [0, 1] every 0.125 weight 1
minimize integral(x''^2 + 8*(x - 2)^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, 9);
}

TEST(Soft, FunctionalsMayBeSoftToo) {
  // min 12 c^2 + w/2 (c - 1)^2 as c = integral(x), x = 6 c t (1 - t).
  const Motion motion = run_scene(R"(time [0, 1]
trajectory bspline spans 8
dof x
constrain x = 0 at 0, 1
constrain area: integral(x) = 1 weight 6
minimize integral(x'^2)
)");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.objective, 12 * 0.04 + 3 * 0.64, 1e-9);
}

}  // namespace
}  // namespace spacetime::optimizer
