// Gauss-Legendre quadrature on the knot spans of the trajectories.
#pragma once

#include <span>
#include <vector>

namespace spacetime::optimizer {

// Four points a span: exact for polynomials up to degree seven, so for the products of two derivatives of cubics.
inline constexpr int points_per_span = 4;

struct Quadrature {
  std::vector<double> times;    // s, rising
  std::vector<double> weights;  // s; their sum is to - from
};

// The integral over [from, to], split at every breakpoint inside.  An interval that runs backwards integrates
// backwards: its weights are negative.  An empty interval has no points.
Quadrature gauss_legendre(std::span<const double> breakpoints, double from, double to);

}  // namespace spacetime::optimizer
