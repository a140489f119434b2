// Gradients and Hessians of the whole problem against differences, with everything that can stand in one: functionals
// within functionals, soft and hard rows, several bases, integrals over parts of the time.
#include <gtest/gtest.h>

#include <random>

#include "tests/optimizer/evaluated.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::vector<std::string> scenes{
    // Rows with and without weight, at every kind of scope; x and y of different bases.
    R"(time [0, 2]
trajectory bspline spans 6
dof x = 0.3
trajectory bspline knots [0, 0.2, 0.9, 2]
dof y = 0.2
constrain hard: x*y' = sin(y) + t         over [0, 2] every 0.3
constrain pair: (x^2, y'') = (y, cos(x))  at 0.5, 0.9      weight 3
constrain all:  exp(x)*x' = 1                              weight 1e-2
minimize integral(x''^2*cosh(y) + x*y'*x') + 2*at(sin(x')*y, 0.7)
minimize integral(x^4, 0.3, 1.1) weight 0.7
)",
    // Functionals: in objectives and in rows, with others inside, and rows that have both a time and a functional.
    R"(time [0, 1]
trajectory bspline spans 5
dof x = 0.4
dof y = 0.1
let mean = integral(x)
let spread = integral((x - mean)^2*exp(y))
constrain one: spread*at(y, 0.3) = at(x', 0.9)
constrain two: x*mean = sin(y)*spread  at 0.2, 0.6
constrain mild: at(x, 1) - at(x, 0)*integral(y'^2) = 0.3  weight 5
minimize mean^2*spread + integral(x''^2 + y'^2) + integral(y, 0.1, 0.45)*at(x'^2, 0.5)
minimize sin(integral(x'*y))*exp(at(y, 0)) weight 2
)",
    // An arm, so that programs of a thousand operations are among them.
    R"(time [0, 1]
trajectory bspline spans 4
creature arm {
  gravity (0, -9.81, 0)
  link upper { revolute a = 0.3; offset -pi/2; a 0.5; mass 2; rod }
  link fore  { revolute b = 0.2; a 0.4; mass 1; rod }
  point hand on fore (0.1, 0, 0)
}
constrain reach: arm.hand.x*integral(arm.kinetic) = 0.2  at 0.5, 1
constrain swing: at(arm.hand.x', 0.4) = at(arm.hand.y, 0.8)
constrain quiet: arm.force = 0  over [0, 1] count 3  weight 0.1
minimize integral(dot(arm.force, arm.force))
)"};

class Derivatives : public ::testing::TestWithParam<int> {
 protected:
  static constexpr unsigned seed = 31;

  Derivatives() : problem_(problem_of(scenes[static_cast<std::size_t>(GetParam())])), here_(problem_), random_(seed) {}

  Eigen::VectorXd vector(int size, double scale) {
    std::uniform_real_distribution<double> entry(-scale, scale);
    return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return entry(random_); });
  }

  // Multipliers of hard rows as given; soft ones pull with w r.
  Eigen::VectorXd pulls(const Eigen::VectorXd& multipliers) const {
    Eigen::VectorXd all = multipliers;
    for (int r = 0; r < here_.rows(); ++r) {
      if (here_.t.rows[r].kind == Row::Kind::soft) all[r] = here_.t.rows[r].weight * here_.values.residual[r];
    }
    return all;
  }
  double lagrangian(const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers) {
    here_.at(x);
    double sum = here_.values.objective;
    for (int r = 0; r < here_.rows(); ++r) {
      if (here_.t.rows[r].kind != Row::Kind::soft) sum += multipliers[r] * here_.values.residual[r];
    }
    return sum;
  }
  Eigen::VectorXd gradient(const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers) {
    here_.at(x);
    return here_.gradient() + here_.jacobian().transpose() * pulls(multipliers);
  }

  Problem problem_;
  Evaluated here_;
  std::mt19937_64 random_;
};

TEST_P(Derivatives, AgreeWithDifferences) {
  SCOPED_TRACE("seed 31");
  const int n = here_.t.unknowns();
  constexpr double h = 1e-5;
  for (int round = 0; round < 3; ++round) {
    const Eigen::VectorXd x = vector(n, 0.8), lambda = vector(here_.rows(), 2);

    const Eigen::VectorXd slope = gradient(x, lambda);
    for (int u = 0; u < n; ++u) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, u);
      const double difference = (lagrangian(x + step, lambda) - lagrangian(x - step, lambda)) / (2 * h);
      EXPECT_NEAR(slope[u], difference, 1e-7 * slope.cwiseAbs().maxCoeff()) << "unknown " << u;
    }

    here_.at(x);
    here_.add_curvature(lambda);
    Eigen::MatrixXd curvature = here_.hessian();
    const Eigen::MatrixXd jacobian = here_.jacobian();
    for (int r = 0; r < here_.rows(); ++r) {
      if (here_.t.rows[r].kind != Row::Kind::soft) continue;
      curvature += here_.t.rows[r].weight * jacobian.row(r).transpose() * jacobian.row(r);
    }
    for (int u = 0; u < n; ++u) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(n, u);
      const Eigen::VectorXd difference = (gradient(x + step, lambda) - gradient(x - step, lambda)) / (2 * h);
      EXPECT_LE((curvature.col(u) - difference).cwiseAbs().maxCoeff(), 1e-7 * curvature.cwiseAbs().maxCoeff())
          << "unknown " << u;
    }
  }
}

TEST_P(Derivatives, SettledFunctionalsHaveTheirValues) {
  const Eigen::VectorXd x = vector(here_.t.unknowns(), 0.8);
  std::vector<double> settled(x.begin(), x.end());
  settle_functionals(here_.t, settled, here_.workspace);
  const Values values = evaluate(here_.t, settled, here_.workspace);
  for (int k = 0; k < here_.t.functionals(); ++k) EXPECT_NEAR(values.residual[k], 0, 1e-14);
  for (int u = 0; u < here_.t.first_functional(); ++u) EXPECT_EQ(settled[u], x[u]);
}

INSTANTIATE_TEST_SUITE_P(OfScenes, Derivatives, ::testing::Range(0, 3));

}  // namespace
}  // namespace spacetime::optimizer
