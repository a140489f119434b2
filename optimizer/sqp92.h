// The method of 1992: Lagrange-Newton steps with a merit function along the line.
//
//   [ W(x, l)  A^T ] [ d  ]     [ g ]      W = Hessian of f + sum l c,  A = Jacobian of c,  g = gradient of f
//   [ A        0   ] [ l+ ] = - [ c ]      x+ = x + a d,  a by backtracking on  f + weight * sum |c|
//
// [Cohen92 §3.6.2 and §3.6.3].  Where the paper is silent:
// - multipliers start at 0, and move by the same fraction a of their step as x does;
// - each violation's weight in the merit function is w = max(|l+|, (w + |l+|) / 2) [Powell 1978; Papalambros and Wilde
//   1988, which the paper follows]: enough for d to lead downhill, and bad multipliers are forgotten again;
// - where W is not convex on the constraints' tangent space, d is no descent direction and the step no minimisation: a
//   multiple of the identity is added to W until the inertia is that of a minimum (conjugate gradients do not know the
//   inertia: until the curvature along d is not negative);
// - a is halved from 1, or from where `damp` is met, until the merit falls sufficiently.
//
// Equations only: inequalities and bounds are refused by name.
#pragma once

#include "optimizer/method.h"

namespace spacetime::optimizer {

struct Sqp92State : Standing {
  Linearisation linear;                        // at x
  Eigen::VectorXd gradient;                    // of the whole objective, in KKT positions
  Eigen::VectorXd merit_weights;               // of violations, in KKT positions
  StepResult condition = StepResult::stepped;  // not_finite where x cannot be gone on from
};

class Sqp92 {
 public:
  // Both must outlive it.  With `linear_cg` the system is solved as the paper does, by conjugate gradients that
  // minimise the square of its residual; without, by a banded factorisation.  Throws InputError for inequalities and
  // conditions.
  Sqp92(const Transcription& transcription, const Layout& layout, bool linear_cg);

  Sqp92State start(std::vector<double> x);
  // With functionals in x, multipliers and the merit's weights (one a row) as they were.
  Sqp92State resume(std::vector<double> x, std::vector<double> multipliers, const std::vector<double>& weights);
  StepResult step(Sqp92State& state, double tolerance);  // stepped, converged, not_finite, singular or exhausted

  // What `exhausted` means here.
  static std::string ending(const Sqp92State&) { return "No length along the step reduces the merit function"; }

 private:
  struct Direction {
    Eigen::VectorXd d, multipliers;  // at unknowns; at equations
    double shift = 0;
  };
  void judge(Sqp92State& state);
  std::optional<Direction> factored(Sqp92State& state);
  std::optional<Direction> conjugate(Sqp92State& state) const;
  Eigen::VectorXd scales(const Sqp92State& state, double mean) const;
  bool is_hard(std::size_t row) const { return t_.rows[row].kind != Row::Kind::soft; }

  const Transcription& t_;
  const Layout& layout_;
  bool linear_cg_;
  Workspace workspace_;
  Kkt kkt_;
};

}  // namespace spacetime::optimizer
