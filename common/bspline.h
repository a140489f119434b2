// Clamped cubic B-splines: the trajectories of degrees of freedom.
//   q(t) = sum_k coefficient[k] B_k(t),  B_k cubic on the knots u[k..k+4]
// Recurrences as in de Boor; knots carry their multiplicity, the first and last four times.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/problem.h"

namespace spacetime {

inline constexpr int max_derivative = 2;  // trajectories are C2

// The four basis functions that do not vanish at a time, with their derivatives.
struct BasisValues {
  int first = 0;                                              // index of the first of the four coefficients
  std::array<std::array<double, 4>, max_derivative + 1> b{};  // b[d][k] = d-th derivative of B_{first+k}, in 1/s^d
};

// The basis on the given strictly rising breakpoints (both ends among them; at least two).
Basis basis_on(std::span<const double> breakpoints);
Basis uniform_basis(double start, double end, int spans);

// The distinct knots.
std::vector<double> breakpoints(const Basis& basis);

// At a knot the span to its right counts, at the end of time the last one.  t must lie within the knots.
BasisValues basis_values(const Basis& basis, double t);

double value(const Basis& basis, std::span<const double> coefficients, double t, int derivative = 0);

// Times of greatest influence, one a coefficient: (u[k+1] + u[k+2] + u[k+3]) / 3.
std::vector<double> greville(const Basis& basis);

// The coefficients whose curve comes nearest, in least squares, to `values` at `times` (at least one time in the
// support of each coefficient; ends are met exactly when they are among the times).
std::vector<double> fit(const Basis& basis, std::span<const double> times, std::span<const double> values);

// Inserts knots, rising and strictly inside the time: the same curve on a basis with as many coefficients more.
// Coefficients whose knots do not change keep their bits (Oslo algorithm: Cohen, Lyche and Riesenfeld 1980).
std::vector<double> insert_knots(Basis& basis, std::span<const double> coefficients, std::span<const double> times);

}  // namespace spacetime
