#include "common/bspline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace spacetime {
namespace {

constexpr std::uint64_t seed = 20240119;

// The definition by recursion [de Boor 1978, ch. IX]: 0/0 counts as 0, the last span is closed on the right.
double cox_de_boor(const std::vector<double>& u, int i, int degree, double t) {
  if (degree == 0) return (u[i] <= t && t < u[i + 1]) || (t == u.back() && u[i] < u[i + 1] && u[i + 1] == t);
  const auto part = [&](double numerator, double denominator, int j) {
    return denominator == 0 ? 0 : numerator / denominator * cox_de_boor(u, j, degree - 1, t);
  };
  return part(t - u[i], u[i + degree] - u[i], i) + part(u[i + degree + 1] - t, u[i + degree + 1] - u[i + 1], i + 1);
}

double sum(const Basis& basis, const std::vector<double>& c, double t) {
  double q = 0;
  for (int k = 0; k < basis.size(); ++k) q += c[k] * cox_de_boor(basis.knots, k, 3, t);
  return q;
}

std::vector<double> numbers(std::size_t n, std::mt19937_64& random) {
  std::vector<double> result(n);
  for (auto& x : result) x = std::uniform_real_distribution<double>(-1, 1)(random);
  return result;
}

Basis random_basis(int spans, std::mt19937_64& random) {
  std::vector<double> points = {-0.5};
  for (int i = 0; i < spans; ++i) points.push_back(points.back() + std::uniform_real_distribution<>(0.05, 1)(random));
  return basis_on(points);
}

std::vector<Basis> some_bases(std::mt19937_64& random) {
  std::vector<Basis> bases = {uniform_basis(0, 2, 1), uniform_basis(-1, 3, 2), uniform_basis(0, 1, 24)};
  for (const int spans : {1, 2, 3, 7, 40}) bases.push_back(random_basis(spans, random));
  return bases;
}

// Times across the basis, every breakpoint among them.
std::vector<double> some_times(const Basis& basis, std::mt19937_64& random) {
  auto times = breakpoints(basis);
  std::uniform_real_distribution<double> within(basis.knots.front(), basis.knots.back());
  for (int i = 0; i < 100; ++i) times.push_back(within(random));
  return times;
}

TEST(Bspline, BasesCarryQuadrupleEnds) {
  const auto basis = uniform_basis(1, 3, 4);
  EXPECT_EQ(basis.knots, (std::vector<double>{1, 1, 1, 1, 1.5, 2, 2.5, 3, 3, 3, 3}));
  EXPECT_EQ(basis.size(), 7);
  EXPECT_EQ(breakpoints(basis), (std::vector<double>{1, 1.5, 2, 2.5, 3}));
  EXPECT_EQ(basis_on(breakpoints(basis)), basis);
  EXPECT_EQ(uniform_basis(0, 0.3, 3).knots.back(), 0.3);  // exactly
}

TEST(Bspline, ValuesAreThoseOfTheRecursion) {
  std::mt19937_64 random(seed);
  for (const auto& basis : some_bases(random)) {
    for (const double t : some_times(basis, random)) {
      const auto at = basis_values(basis, t);
      for (int k = 0; k < basis.size(); ++k) {
        const bool inside = k >= at.first && k < at.first + 4;
        EXPECT_NEAR(inside ? at.b[0][k - at.first] : 0, cox_de_boor(basis.knots, k, 3, t), 1e-14);
      }
    }
  }
}

TEST(Bspline, SumsToOneAndDerivativesToZero) {
  std::mt19937_64 random(seed);
  for (const auto& basis : some_bases(random)) {
    for (const double t : some_times(basis, random)) {
      const auto at = basis_values(basis, t);
      for (int d = 0; d <= max_derivative; ++d) {
        double total = 0, size = 0;
        for (const double b : at.b[d]) total += b, size += std::fabs(b);
        EXPECT_NEAR(total, d == 0 ? 1 : 0, 1e-14 * size);
      }
    }
  }
}

// Within a span the curve is a cubic, for which these differences are exact but for rounding.
TEST(Bspline, DerivativesAreDifferences) {
  std::mt19937_64 random(seed);
  for (const auto& basis : some_bases(random)) {
    const auto c = numbers(basis.size(), random);
    const auto points = breakpoints(basis);
    for (std::size_t span = 0; span + 1 < points.size(); ++span) {
      const double t = 0.55 * points[span] + 0.45 * points[span + 1], h = 0.2 * (points[span + 1] - points[span]);
      const auto q = [&](double steps) { return sum(basis, c, t + steps * h); };
      EXPECT_NEAR(value(basis, c, t), q(0), 1e-13);
      EXPECT_NEAR(value(basis, c, t, 1), (8 * (q(1) - q(-1)) - (q(2) - q(-2))) / (12 * h), 1e-13 / h);
      EXPECT_NEAR(value(basis, c, t, 2), (q(1) - 2 * q(0) + q(-1)) / (h * h), 1e-13 / (h * h));
    }
  }
}

TEST(Bspline, IsTwiceContinuousAcrossKnots) {
  std::mt19937_64 random(seed);
  const auto basis = random_basis(9, random);
  const auto c = numbers(basis.size(), random);
  const auto points = breakpoints(basis);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double before = std::nextafter(points[i], -1e9);
    for (int d = 0; d <= 2; ++d) {
      EXPECT_NEAR(value(basis, c, before, d), value(basis, c, points[i], d), 1e-11 * std::pow(20, d));
    }
  }
}

TEST(Bspline, EndsAreTheEndCoefficients) {
  std::mt19937_64 random(seed);
  const auto basis = random_basis(5, random);
  const auto c = numbers(basis.size(), random);
  EXPECT_EQ(value(basis, c, basis.knots.front()), c.front());
  EXPECT_EQ(value(basis, c, basis.knots.back()), c.back());
  EXPECT_DEATH(value(basis, c, basis.knots.back() + 0.1), "assertion failed");
}

TEST(Bspline, GrevilleTimesReproduceTime) {  // sum_k greville_k B_k(t) = t
  std::mt19937_64 random(seed);
  for (const auto& basis : some_bases(random)) {
    for (const double t : some_times(basis, random)) EXPECT_NEAR(value(basis, greville(basis), t), t, 1e-13);
  }
}

TEST(Bspline, FitOfACubicIsThatCubic) {
  std::mt19937_64 random(seed);
  const auto cubic = [](double t) { return ((2 * t - 1) * t - 0.7) * t + 0.3; };
  for (const auto& basis : some_bases(random)) {
    std::vector<double> times = {basis.knots.front(), basis.knots.back()}, values;
    for (int i = 0; i < 8 * basis.size(); ++i) {
      times.push_back(basis.knots.front() +
                      (basis.knots.back() - basis.knots.front()) * (i + 0.5) / (8 * basis.size()));
    }
    for (const double t : times) values.push_back(cubic(t));
    const auto c = fit(basis, times, values);
    double size = 0;
    for (const double v : values) size = std::max(size, std::fabs(v));
    for (const double t : some_times(basis, random)) EXPECT_NEAR(value(basis, c, t), cubic(t), 1e-12 * size);
  }
}

// The residual of a least-squares fit is orthogonal to every basis function that is free.
TEST(Bspline, FitIsNearestAndMeetsTheEnds) {
  std::mt19937_64 random(seed);
  const auto basis = random_basis(6, random);
  const auto times = some_times(basis, random);
  const auto values = numbers(times.size(), random);
  const auto c = fit(basis, times, values);
  EXPECT_EQ(c.front(), values.front());
  EXPECT_EQ(value(basis, c, basis.knots.back()), values[breakpoints(basis).size() - 1]);
  for (int k = 1; k + 1 < basis.size(); ++k) {
    double product = 0;
    for (std::size_t s = 0; s < times.size(); ++s) {
      product += cox_de_boor(basis.knots, k, 3, times[s]) * (values[s] - sum(basis, c, times[s]));
    }
    EXPECT_NEAR(product, 0, 1e-12);
  }
}

TEST(Bspline, FitThroughFewTimesStaysFiniteAndMeetsThem) {
  const auto basis = uniform_basis(0, 1, 16);
  const std::vector<double> times = {0, 0.2, 0.5, 0.8, 1}, values = {0, 1, -1, 2, 0};
  const auto c = fit(basis, times, values);
  for (std::size_t s = 0; s < times.size(); ++s) EXPECT_NEAR(value(basis, c, times[s]), values[s], 1e-6);
  for (const double x : c) EXPECT_LT(std::fabs(x), 10);
}

TEST(Bspline, InsertingKnotsLeavesTheCurve) {
  std::mt19937_64 random(seed);
  for (const auto& original : some_bases(random)) {
    const auto c = numbers(original.size(), random);
    auto basis = original;
    auto refined = c;
    std::uniform_real_distribution<double> within(basis.knots.front(), basis.knots.back());
    for (int i = 0; i < 5; ++i) refined = insert_knots(basis, refined, std::array{within(random)});
    if (breakpoints(original).size() > 2)
      refined = insert_knots(basis, refined, std::array{breakpoints(original)[1]});  // doubled
    EXPECT_EQ(refined.size(), static_cast<std::size_t>(basis.size()));
    EXPECT_TRUE(std::ranges::is_sorted(basis.knots));
    for (const double t : some_times(original, random)) {
      EXPECT_NEAR(value(basis, refined, t), value(original, c, t), 1e-13);
    }
  }
}

}  // namespace
}  // namespace spacetime
