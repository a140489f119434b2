// The KKT system of one iteration: regularised, factored with the right inertia, solved and refined.
//
//   [ W + D + shift s I   A^T ] [ d  ]     [ g ]      W = Hessian of f + sum lambda c (soft rows' J^T w J left out)
//   [ A                  -E   ] [ l+ ] = - [ c ]      g = gradient of f (soft rows left out)
//
// D is the barrier's curvature at bounded unknowns.  E is 1/w for a soft row, slack over multiplier for a limit
// (c <= 0), and for an equation a vanishing number that makes redundant rows harmless: the least-squares point of an
// over-determined set is found.  Vectors are in the positions of the layout: d at unknowns, l+ at rows.
// [Cohen92 §3.6.2; quasi-definite regularisation: Vanderbei 1995; inertia correction: Waechter and Biegler 2006, §3.1]
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {

class Kkt {
 public:
  Kkt(const Transcription& transcription, const Layout& layout);

  // The multipliers of the equations that come nearest to making gradient + A^T lambda vanish, at rows' positions.
  // Nothing where the system cannot be solved.
  std::optional<Eigen::VectorXd> least_squares_multipliers(const Linearisation& linear,
                                                           const Eigen::VectorXd& gradient);

  struct Step {
    Eigen::VectorXd solution;  // d at unknowns, l+ at rows
    double shift = 0;          // that was needed
  };
  // Factors with the inertia of a minimum (as many negative pivots as rows) and solves: shift 0 first, then from `hint`
  // upwards.  `diagonal` has D at unknowns, -E at soft rows and limits, 0 at equations.  Nothing where no shift is
  // enough.
  std::optional<Step> step(const Linearisation& linear, const Eigen::VectorXd& diagonal, const Eigen::VectorXd& right,
                           double hint);

  // The size A A^T of each row, with a floor: its square root is what turns a violation into a change of the unknowns.
  Eigen::VectorXd row_sizes(const BorderedMatrix& jacobian) const;

  // Factors for a step to feasibility alone: the smallest change of the unknowns that, with E = damping * sizes,
  // reduces c in the rows `wanted` (nonzero there).  False where it cannot be factored.
  bool factor_feasibility(const Linearisation& linear, const Eigen::VectorXd& wanted, const Eigen::VectorXd& sizes,
                          double damping);

  // The same step with the violations' own curvature: that of half the sum of c^2 / sizes, to second order.
  //
  //   [ curvature + damping I   A^T    ] [ d  ]     [ 0 ]
  //   [ A                       -sizes ] [ l+ ] = - [ c ]
  //
  // False as well where this has no minimum.
  bool factor_feasibility(const Linearisation& linear, const BorderedMatrix& curvature, const Eigen::VectorXd& wanted,
                          const Eigen::VectorXd& sizes, double damping);

  // Solves with what was factored last, refined against the matrix without its vanishing regularisation.  Nothing where
  // the residual stays large.
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& right) const;

  bool is_row(int position) const { return role_[position] != Role::unknown; }
  bool is_equation(int position) const { return role_[position] == Role::equation; }
  int pivoted_solves() const { return pivoted_; }  // last resorts taken so far
  void set_pivoted_solves(int count) { pivoted_ = count; }

 private:
  enum class Role : unsigned char { unknown, equation, compliant };
  void assemble(const Linearisation& linear, const Eigen::VectorXd& diagonal);
  std::optional<double> factor(double hint, double at_least);
  bool regularise_and_factor(double shift);
  Eigen::VectorXd row_sizes(const BorderedMatrix& jacobian, const Eigen::VectorXd& diagonal) const;
  Eigen::VectorXd pulled_curvature(const BorderedMatrix& jacobian, const Eigen::VectorXd& diagonal) const;
  std::optional<Eigen::VectorXd> solve_pivoted(const Eigen::VectorXd& right) const;

  std::vector<Role> role_;
  int rows_ = 0;
  bool any_compliant_ = false;

  BorderedMatrix exact_, regular_;
  Factorisation factorisation_;
  Eigen::VectorXd vanishing_;  // what regularisation adds to the diagonal, to be refined away
  double scale_ = 1;           // unit of the shift: a fraction of the mean curvature
  double shift_ = 0;           // of what was factored last
  int pivoted_ = 0;
};

}  // namespace spacetime::optimizer
