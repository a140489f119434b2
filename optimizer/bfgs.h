// The method of 1994: BFGS on a penalty function of the B-spline coefficients.
//
//   d = -H grad F,   x+ = x + a d,   delta = x+ - x,   gamma = grad F(x+) - grad F(x)
//   H+ = H + (1 + gamma'H gamma / delta'gamma) delta delta' / delta'gamma
//          - (delta gamma'H + H gamma delta') / delta'gamma                                    [LGC94 eq. 21 and 22]
//
// a meets the strong Wolfe conditions; no coefficient changes by more than `longest_step`, or `damp`, in one step.  The
// minimum of F violates each hard constraint by about |multiplier| / (2 w): what the method reaches is that, not the
// constrained minimum, and it says so.
#pragma once

#include "optimizer/method.h"
#include "optimizer/penalty.h"

namespace spacetime::optimizer {

struct BfgsOptions {
  double weight = 1e3;          // w of every hard constraint and bound
  bool diagonal_start = false;  // H0 = 1 / diagonal of F's Hessian at the start, in place of the paper's identity
};

struct BfgsState : Standing {
  PenaltyPoint point;
  Eigen::MatrixXd inverse;  // H, its lower triangle; by free unknowns
  bool at_minimum = false;  // of F, to the tolerance
};

class Bfgs {
 public:
  // Both must outlive it.  Throws InputError for conditions, and for more unknowns than a dense H is made for.
  Bfgs(const Transcription& transcription, const Layout& layout, BfgsOptions options = {});

  BfgsState start(const std::vector<double>& x);
  // With functionals in x and H as they were: its lower triangle, row by row.
  BfgsState resume(const std::vector<double>& x, const std::vector<double>& inverse);
  StepResult step(BfgsState& state, double tolerance);  // stepped, converged, not_finite or exhausted

  int size() const { return penalty_.size(); }  // unknowns of H

  // What `exhausted` means here.
  std::string ending(const BfgsState& state) const;

 private:
  void judge(BfgsState& state) const;

  const Transcription& t_;
  BfgsOptions options_;
  Penalty penalty_;
};

}  // namespace spacetime::optimizer
