#include "optimizer/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

namespace spacetime::optimizer {
namespace {

double integrate(const Quadrature& rule, const std::function<double(double)>& f) {
  double sum = 0;
  for (std::size_t k = 0; k < rule.times.size(); ++k) sum += rule.weights[k] * f(rule.times[k]);
  return sum;
}

const std::vector<double> knots{0, 0.3, 0.35, 1.2, 2};

TEST(Quadrature, IsExactToDegreeSevenAndNoFurther) {
  const auto rule = gauss_legendre(knots, 0, 2);
  EXPECT_EQ(rule.times.size(), 16U);
  for (int degree = 0; degree <= 8; ++degree) {
    const double exact = std::pow(2.0, degree + 1) / (degree + 1);
    const double error = integrate(rule, [&](double t) { return std::pow(t, degree); }) - exact;
    if (degree <= 7) {
      EXPECT_NEAR(error, 0, 1e-13 * exact) << "degree " << degree;
    } else {
      EXPECT_GT(std::abs(error), 1e-7 * exact) << "degree " << degree;
    }
  }
}

TEST(Quadrature, SplitsAtKnotsAndEnds) {
  // A kink at a knot does no harm, inside a span it does.
  const auto kink = [](double at) { return [at](double t) { return std::abs(t - at); }; };
  const auto rule = gauss_legendre(knots, 0.1, 1.9);
  const auto exact = [](double at) { return (std::pow(at - 0.1, 2) + std::pow(1.9 - at, 2)) / 2; };
  EXPECT_NEAR(integrate(rule, kink(0.35)), exact(0.35), 1e-14);
  EXPECT_GT(std::abs(integrate(rule, kink(0.8)) - exact(0.8)), 1e-4);
}

TEST(Quadrature, StaysInsideAndRises) {
  const auto rule = gauss_legendre(knots, 0.32, 0.9);  // two pieces: to 0.35 and on
  ASSERT_EQ(rule.times.size(), 8U);
  EXPECT_GT(rule.times.front(), 0.32);
  EXPECT_LT(rule.times.back(), 0.9);
  EXPECT_LT(rule.times[3], 0.35);
  EXPECT_GT(rule.times[4], 0.35);
  EXPECT_TRUE(std::is_sorted(rule.times.begin(), rule.times.end()));
  EXPECT_NEAR(std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0), 0.58, 1e-15);
}

TEST(Quadrature, BackwardsIsTheNegative) {
  const auto f = [](double t) { return std::exp(t); };
  const auto forward = gauss_legendre(knots, 0.2, 1.5), backward = gauss_legendre(knots, 1.5, 0.2);
  EXPECT_EQ(integrate(backward, f), -integrate(forward, f));
  EXPECT_GT(integrate(forward, f), 0);
}

TEST(Quadrature, OfNothingHasNoPoints) {
  EXPECT_TRUE(gauss_legendre(knots, 0.7, 0.7).times.empty());
  EXPECT_TRUE(gauss_legendre(knots, 0.3, 0.3).times.empty());
}

TEST(Quadrature, WithoutKnotsIsOnePiece) {
  const auto rule = gauss_legendre({}, -1, 1);
  ASSERT_EQ(rule.times.size(), 4U);
  EXPECT_NEAR(rule.times[3], 0.8611363115940526, 1e-15);  // Abramowitz and Stegun, table 25.4
  EXPECT_NEAR(rule.weights[3], 0.3478548451374538, 1e-15);
}

}  // namespace
}  // namespace spacetime::optimizer
