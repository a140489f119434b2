// The penalty function of 1994 and its gradient.
#include "optimizer/penalty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/optimizer/reference.h"

namespace spacetime::optimizer {
namespace {

// All that a penalty function may meet: equations, inequalities, bounds, soft rows, functionals that use one another,
// parameters.
const std::string rich = R"(time [0, 1]
trajectory bspline spans 6
dof x in [-0.5, 0.4]
dof y
parameter k = 1 in [0, 1]
constrain start: x = 0.3 at 0
constrain reach: at(y, 0.2)*at(x, 0.7) = k
constrain area: integral(x*y + at(y, 0.5)^2) <= 0.1
constrain low: y <= 0.2 over [0, 1] every 0.25
constrain near: x = y at 0.1, 0.6 weight 3
minimize integral(x''^2 + sin(y)*x'^2 + y''^2) + k*(at(x, 1) - integral(y) - 2)^2
)";

struct Case {
  explicit Case(const std::string& text) : problem(problem_of(text)), t(transcribe(problem)), layout(arrange(t)) {}
  // The unknowns with these in the places of the free ones.
  std::vector<double> with(const Penalty& penalty, const Eigen::VectorXd& free) const {
    return penalty.moved(std::vector<double>(t.unknowns(), 0.0), free);
  }
  Problem problem;
  Transcription t;
  Layout layout;
};

TEST(Penalty, GradientAgainstDifferences) {
  Case c(rich);
  ASSERT_GT(c.t.functionals(), 1);
  Penalty penalty(c.t, c.layout, 50);
  EXPECT_EQ(penalty.size(), 2 * 9 + 1);
  const Eigen::VectorXd x = test_point(penalty.size());
  const PenaltyPoint here = penalty.at(c.with(penalty, x));
  ASSERT_TRUE(here.finite);
  Eigen::VectorXd differences(penalty.size());
  constexpr double h = 1e-5;
  for (int k = 0; k < penalty.size(); ++k) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(penalty.size(), k);
    differences[k] =
        (penalty.at(c.with(penalty, x + step)).value - penalty.at(c.with(penalty, x - step)).value) / (2 * h);
  }
  EXPECT_LE(relative_difference(here.gradient, differences), 1e-8);
}

TEST(Penalty, IsTheObjectiveWithThePriceOfViolations) {
  Case c(rich);
  const Eigen::VectorXd x = test_point(19);
  Penalty penalty(c.t, c.layout, 7), none(c.t, c.layout, 0);
  const PenaltyPoint dear = penalty.at(c.with(penalty, x)), free = none.at(c.with(none, x));
  EXPECT_NEAR(free.value, free.values.objective, 1e-12 * free.value);
  EXPECT_EQ(free.objective_size, free.gradient.cwiseAbs().maxCoeff());
  double squares = 0, largest = 0;
  const auto add = [&](double amount) {
    squares += amount * amount;
    largest = std::max(largest, amount);
  };
  for (std::size_t r = 0; r < c.t.rows.size(); ++r) {
    const double residual = dear.values.residual[r];
    if (c.t.rows[r].kind == Row::Kind::functional) {
      EXPECT_NEAR(residual, 0, 1e-12);
    }
    if (c.t.rows[r].kind == Row::Kind::hard) add(c.t.rows[r].at_most ? std::max(0.0, residual) : std::abs(residual));
  }
  for (int k = 0; k < 9; ++k) add(std::max({0.0, x[k] - 0.4, -0.5 - x[k]}));
  add(std::max({0.0, x[18] - 1, -x[18]}));
  EXPECT_NEAR(dear.value, free.value + 7 * squares, 1e-12 * dear.value);
  EXPECT_NEAR(dear.violation, largest, 1e-12);
}

// Of a quadratic problem it is exact.
TEST(Penalty, CurvatureIsTheDiagonalOfTheHessian) {
  Case c("time [0, 1]\ntrajectory bspline spans 5\ndof x\nconstrain x = 1 at 0.3, 1\nminimize integral(x''^2 + x^2)\n");
  Penalty penalty(c.t, c.layout, 20);
  const Eigen::VectorXd x = test_point(penalty.size());
  const Eigen::VectorXd found = penalty.curvature(penalty.at(c.with(penalty, x)));
  for (int k = 0; k < penalty.size(); ++k) {
    const Eigen::VectorXd step = Eigen::VectorXd::Unit(penalty.size(), k);
    const double exact = (penalty.at(c.with(penalty, x + step)).gradient - penalty.at(c.with(penalty, x)).gradient)[k];
    EXPECT_NEAR(found[k], exact, 1e-9 * exact);
  }
}

}  // namespace
}  // namespace spacetime::optimizer
