#include "optimizer/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spacetime::optimizer {
namespace {

// The zeros of the Legendre polynomial P4 and their weights on [-1, 1]:
//   x = -+ sqrt(3/7 +- 2/7 sqrt(6/5)),  w = (18 -+ sqrt(30)) / 36
struct Rule {
  std::array<double, points_per_span> x, w;
};
Rule rule() {
  const double outer = std::sqrt(3.0 / 7.0 + 2.0 / 7.0 * std::sqrt(1.2));
  const double inner = std::sqrt(3.0 / 7.0 - 2.0 / 7.0 * std::sqrt(1.2));
  const double w_outer = (18 - std::sqrt(30.0)) / 36, w_inner = (18 + std::sqrt(30.0)) / 36;
  return {{-outer, -inner, inner, outer}, {w_outer, w_inner, w_inner, w_outer}};
}

}  // namespace

Quadrature gauss_legendre(std::span<const double> breakpoints, double from, double to) {
  const double low = std::min(from, to), high = std::max(from, to), sign = from <= to ? 1 : -1;
  std::vector<double> ends{low};
  for (const double u : breakpoints) {
    if (u > low && u < high) ends.push_back(u);
  }
  if (high > low) ends.push_back(high);

  const auto [x, w] = rule();
  Quadrature result;
  result.times.reserve(points_per_span * ends.size());
  result.weights.reserve(points_per_span * ends.size());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double half = (ends[k + 1] - ends[k]) / 2, middle = (ends[k + 1] + ends[k]) / 2;
    for (int i = 0; i < points_per_span; ++i) {
      result.times.push_back(middle + half * x[i]);
      result.weights.push_back(sign * half * w[i]);
    }
  }
  return result;
}

}  // namespace spacetime::optimizer
