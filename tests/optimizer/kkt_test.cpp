// One Newton step against dense linear algebra: well-posed systems, and rows that say the same, nothing, or contradict
// one another.
#include "optimizer/kkt.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <string>

#include "tests/optimizer/evaluated.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string head = R"(time [0, 1]
trajectory bspline spans 8
dof x = 0.3
dof y = 0.1
minimize integral(x''^2 + y''^2 + (x - 1)^2 + cosh(x - 2*y))
)";

struct System : Evaluated {
  explicit System(const Problem& problem) : Evaluated(problem), kkt(t, layout) {
    Eigen::VectorXd start = Eigen::VectorXd::NullaryExpr(
        t.unknowns(), [](Eigen::Index k) { return 0.5 + 0.1 * std::sin(1.3 * static_cast<double>(k)); });
    std::vector<double> settled(start.begin(), start.end());
    settle_functionals(t, settled, workspace);
    at(Eigen::Map<const Eigen::VectorXd>(settled.data(), start.size()));
    add_curvature(Eigen::VectorXd::Zero(rows()));
  }

  // Soft rows give way by 1/w.
  Eigen::VectorXd diagonal() const {
    Eigen::VectorXd compliance = Eigen::VectorXd::Zero(rows());
    for (int r = 0; r < rows(); ++r) {
      if (t.rows[r].kind == Row::Kind::soft) compliance[r] = -1 / t.rows[r].weight;
    }
    return rows_placed(compliance);
  }

  std::optional<Kkt::Step> step(double hint = 0) {
    return kkt.step(linear, diagonal(), -(linear.gradient + rows_placed(residual())), hint);
  }

  Kkt kkt;
};

// The step by the null space of the rows: d = d0 + Z p with A d0 = -c (least squares), Z^T (W (d0 + Z p) + g) = 0.
Eigen::VectorXd dense_step(const System& s) {
  const Eigen::MatrixXd a = s.jacobian(), w = s.hessian();
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal(a);
  const Eigen::VectorXd d0 = orthogonal.solve(-s.residual());
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a.transpose());
  const Eigen::MatrixXd q = qr.householderQ();
  const Eigen::MatrixXd z = q.rightCols(a.cols() - qr.rank());
  const Eigen::VectorXd p = (z.transpose() * w * z).ldlt().solve(-z.transpose() * (w * d0 + s.gradient()));
  return d0 + z * p;
}

double difference(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / std::max(1e-300, expected.cwiseAbs().maxCoeff());
}

TEST(Kkt, StepsAsTheNullSpaceMethod) {
  for (const std::string constraints :
       {"constrain x = 0 at 0, 1\nconstrain (x', y) = (1, 2) at 0.5\n", "constrain x*y = 1 over [0, 1] every 0.25\n",
        "constrain integral(x)*integral(y) = 1\nconstrain x = y at 0\n", "constrain x + at(x, 1) = y at 0.2, 0.4\n"}) {
    const Problem problem = problem_of(head + constraints);
    System s(problem);
    const auto step = s.step();
    ASSERT_TRUE(step) << constraints;
    EXPECT_EQ(step->shift, 0) << constraints;
    const Eigen::VectorXd d = s.of_unknowns(step->solution), lambda = s.of_rows(step->solution);
    EXPECT_LE(difference(d, dense_step(s)), 1e-7) << constraints;
    const Eigen::VectorXd balance = s.hessian() * d + s.jacobian().transpose() * lambda + s.gradient();
    EXPECT_LE(balance.cwiseAbs().maxCoeff(), 1e-9 * s.gradient().cwiseAbs().maxCoeff()) << constraints;
    EXPECT_LE((s.jacobian() * d + s.residual()).cwiseAbs().maxCoeff(), 1e-9) << constraints;
  }
}

TEST(Kkt, SoftRowsPullByTheirWeight) {
  for (const char* weight : {"1e-6", "1", "1e6"}) {
    const Problem problem = problem_of(head + "constrain soft: x = 2*y over [0, 1] every 0.1 weight " + weight + "\n");
    System s(problem);
    const auto step = s.step();
    ASSERT_TRUE(step);
    const double w = s.t.rows[0].weight;
    const Eigen::MatrixXd a = s.jacobian(), curvature = s.hessian() + w * a.transpose() * a;
    const Eigen::VectorXd expected = curvature.ldlt().solve(-(s.gradient() + w * a.transpose() * s.residual()));
    EXPECT_LE(difference(s.of_unknowns(step->solution), expected), 1e-7) << weight;
  }
}

TEST(Kkt, RowsSaidTwiceStepAsOnce) {
  const std::string once = "constrain x = 1 at 0, 0.5, 1\nconstrain y' = x at 0.5\n";
  const Problem single = problem_of(head + once), twice = problem_of(head + once + once);
  System a(single), b(twice);
  const auto expected = a.step(), found = b.step();
  ASSERT_TRUE(expected && found);
  EXPECT_EQ(found->shift, 0);
  EXPECT_LE(difference(b.of_unknowns(found->solution), a.of_unknowns(expected->solution)), 1e-7);
  EXPECT_LE((b.jacobian() * b.of_unknowns(found->solution) + b.residual()).cwiseAbs().maxCoeff(), 1e-9);
  // Two that say the same share the load.
  const Eigen::VectorXd one = a.of_rows(expected->solution), two = b.of_rows(found->solution);
  EXPECT_LE(difference(two.head(4) + two.tail(4), one), 1e-6);
}

// More instances than the splines have coefficients: what is asked can be met, but not by independent rows.
TEST(Kkt, AnOverDeterminedHoldIsMet) {
  const Problem problem = problem_of(head + "constrain x'' = 6*t - 2 over [0, 1] every 0.01\n");
  System s(problem);
  const auto step = s.step();
  ASSERT_TRUE(step);
  EXPECT_LE((s.jacobian() * s.of_unknowns(step->solution) + s.residual()).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LE(difference(s.of_unknowns(step->solution), dense_step(s)), 1e-5);
}

TEST(Kkt, ContradictionsAreMetHalfWay) {
  const Problem problem = problem_of(head + "constrain x = 1 at 0.5\nconstrain x = 2 at 0.5\nconstrain y = 3 at 0\n");
  System s(problem);
  const auto step = s.step();
  ASSERT_TRUE(step);
  const Eigen::VectorXd left = s.jacobian() * s.of_unknowns(step->solution) + s.residual();
  EXPECT_NEAR(left[0], 0.5, 1e-6);
  EXPECT_NEAR(left[1], -0.5, 1e-6);
  EXPECT_NEAR(left[2], 0, 1e-6);
}

// sin(x)^2 = 1 at x = 0 has no gradient: the row can ask nothing, and must not spoil the others.
TEST(Kkt, ARowWithoutGradientAsksNoEndlessStep) {
  const Problem problem = problem_of(head + "constrain sin(x - 0.25)^2 = 1 at 0\nconstrain y = 1 at 1\n");
  System s(problem);
  Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(s.x.data(), s.t.unknowns());
  x[0] = 0.25;
  s.at(x);
  s.add_curvature(Eigen::VectorXd::Zero(s.rows()));
  ASSERT_EQ(s.jacobian().row(0).cwiseAbs().maxCoeff(), 0);
  const auto step = s.step();
  ASSERT_TRUE(step);
  const Eigen::VectorXd d = s.of_unknowns(step->solution);
  EXPECT_LE(d.cwiseAbs().maxCoeff(), 100);
  EXPECT_NEAR((s.jacobian() * d + s.residual())[1], 0, 1e-9);
}

TEST(Kkt, CurvatureIsCorrectedUntilTheStepDescends) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x = 0.3\nconstrain x = 0 at 0\nminimize integral(50*cos(x) + "
      "x'^2)\n");
  System s(problem);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> before(s.hessian(), Eigen::EigenvaluesOnly);
  ASSERT_LT(before.eigenvalues()[0], 0);
  const auto step = s.step();
  ASSERT_TRUE(step);
  EXPECT_GT(step->shift, 0);
  const Eigen::VectorXd d = s.of_unknowns(step->solution);
  EXPECT_LT(s.gradient().dot(d), 0);
  EXPECT_TRUE(d.allFinite());
  // A hint near what was needed is enough, and is not overshot by far.
  const auto again = s.step(step->shift);
  ASSERT_TRUE(again);
  EXPECT_GT(again->shift, 0);
  EXPECT_LE(again->shift, 3 * step->shift);
}

TEST(Kkt, MultipliersAreThoseOfLeastSquares) {
  for (const std::string constraints :
       {"constrain x = 0 at 0, 1\nconstrain x*y = 1 over [0, 1] every 0.25\n",
        "constrain x = 0 at 0, 1\nconstrain x = 0 at 0, 1\nconstrain y = x at 0.3 weight 100\n",
        "constrain integral(x) = at(y, 0)*at(x, 0.5)\n"}) {
    const Problem problem = problem_of(head + constraints);
    System s(problem);
    const auto found = s.kkt.least_squares_multipliers(s.linear, s.linear.gradient);
    ASSERT_TRUE(found);
    Eigen::MatrixXd a = s.jacobian();
    Eigen::VectorXd lambda = s.of_rows(*found);
    for (int r = 0; r < s.rows(); ++r) {
      if (s.t.rows[r].kind != Row::Kind::soft) continue;
      a.row(r).setZero();
      lambda[r] = 0;
    }
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal(a.transpose());
    const Eigen::VectorXd expected = orthogonal.solve(-s.gradient());
    const Eigen::VectorXd left = s.gradient() + a.transpose() * lambda;
    EXPECT_LE((left - (s.gradient() + a.transpose() * expected)).cwiseAbs().maxCoeff(),
              1e-8 * s.gradient().cwiseAbs().maxCoeff())
        << constraints;
  }
}

TEST(Kkt, FeasibilityStepsAreTheSmallest) {
  const Problem problem = problem_of(
      head + "constrain x*y = 1 over [0, 1] every 0.25\nconstrain y' = 0 at 0.5\nconstrain x = 1 at 0 weight 9\n");
  System s(problem);
  const Eigen::VectorXd hard = s.residual().head(6);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(s.rows());
  right.head(6) = -hard;
  const Eigen::VectorXd sizes = s.kkt.row_sizes(s.linear.jacobian);
  ASSERT_TRUE(s.kkt.factor_feasibility(s.linear, s.rows_placed(right), sizes, 1e-12));
  const auto solution = s.kkt.solve(s.rows_placed(right));
  ASSERT_TRUE(solution);
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal(s.jacobian().topRows(6));
  EXPECT_LE(difference(s.of_unknowns(*solution), orthogonal.solve(-hard)), 1e-8);
  // Damping shortens it.
  ASSERT_TRUE(s.kkt.factor_feasibility(s.linear, s.rows_placed(right), sizes, 10));
  const auto damped = s.kkt.solve(s.rows_placed(right));
  ASSERT_TRUE(damped);
  EXPECT_LT(s.of_unknowns(*damped).norm(), 0.3 * s.of_unknowns(*solution).norm());
}

}  // namespace
}  // namespace spacetime::optimizer
