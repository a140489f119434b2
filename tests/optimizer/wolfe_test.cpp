// The line search of bfgs, and the conjugate gradients of sqp92.
#include "optimizer/wolfe.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "optimizer/conjugate.h"

namespace spacetime::optimizer {
namespace {

constexpr double far = 1e3;

bool low(const LinePoint& start, const LinePoint& there) {
  return there.value <= start.value + 1e-4 * there.length * start.slope;
}
bool flat(const LinePoint& start, const LinePoint& there) {
  return std::abs(there.slope) <= 0.9 * std::abs(start.slope);
}

// A random curve that falls at 0, rises in the end, and waves between.
struct Curve {
  double steepness, bowl, height, pace, shift;
  LinePoint operator()(double a) const {
    return {a, bowl * a * a - steepness * a + height * std::sin(pace * a + shift),
            2 * bowl * a - steepness + height * pace * std::cos(pace * a + shift)};
  }
};

TEST(Wolfe, HoldsWhereTheSearchEnds) {
  std::mt19937 generator(20261);
  std::uniform_real_distribution<double> exponent(-3, 3), number(0, 1);
  int searched = 0;
  for (int k = 0; k < 2000; ++k) {
    SCOPED_TRACE(k);
    const double steepness = std::pow(10, exponent(generator)), bowl = std::pow(10, exponent(generator));
    const double pace = 3 * number(generator) * bowl / steepness + 0.1;
    const Curve curve{steepness, bowl, 0.9 * number(generator) * steepness / pace, pace, 6 * number(generator)};
    const LinePoint start = curve(0);
    ASSERT_LT(start.slope, 0);
    LinePoint last;
    const auto phi = [&](double a) { return last = curve(a); };
    const auto found = wolfe_search(phi, start, 1, 1e9, 0);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length, last.length);
    EXPECT_TRUE(low(start, *found));
    EXPECT_TRUE(flat(start, *found));
    ++searched;
  }
  EXPECT_EQ(searched, 2000);
}

TEST(Wolfe, StopsAtTheLongestLength) {
  const auto falling = [](double a) { return LinePoint{a, -a, -1}; };
  const auto found = wolfe_search(falling, falling(0), 1, 5, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->length, 5);
  EXPECT_TRUE(low(falling(0), *found));
}

TEST(Wolfe, AvoidsWhatIsNotANumber) {
  const auto barrier = [](double a) {
    return a < 0.3 ? LinePoint{a, -a - 0.01 * std::log(0.3 - a), -1 + 0.01 / (0.3 - a)} : LinePoint{a, INFINITY, NAN};
  };
  const auto found = wolfe_search(barrier, barrier(0), 1, far, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(found->length, 0.3);
  EXPECT_TRUE(low(barrier(0), *found));
  EXPECT_TRUE(flat(barrier(0), *found));
}

TEST(Wolfe, FindsNothingUphillOrWithoutDecrease) {
  const auto rising = [](double a) { return LinePoint{a, a, 1}; };
  EXPECT_FALSE(wolfe_search(rising, rising(0), 1, far, 0));
  const auto deceiving = [](double a) { return LinePoint{a, a, -1}; };  // slopes that are not the values'
  EXPECT_FALSE(wolfe_search(deceiving, deceiving(0), 1, far, 0));
}

TEST(ConjugateGradients, FindTheLeastSquaresSolutionOfLeastSize) {
  std::mt19937 generator(20262);
  std::normal_distribution<double> number;
  const Eigen::Index n = 12;
  Eigen::MatrixXd directions = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(generator); });
  directions = Eigen::HouseholderQR<Eigen::MatrixXd>(directions).householderQ() * Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(n, -5, 6);  // of both signs
  values[3] = values[8] = 0;
  const Eigen::MatrixXd matrix = directions * values.asDiagonal() * directions.transpose();
  const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return number(generator); });
  const LeastSquares found =
      least_squares_cg([&](const Eigen::VectorXd& v) { return Eigen::VectorXd(matrix * v); }, b, 1e-13, 100);
  const Eigen::VectorXd expected = matrix.completeOrthogonalDecomposition().solve(b);
  EXPECT_LE((found.solution - expected).norm(), 1e-10 * expected.norm());
  EXPECT_LE(found.iterations, 2 * n);
}

}  // namespace
}  // namespace spacetime::optimizer
