// Objective, residuals, and their derivatives at a point.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "optimizer/banded.h"
#include "optimizer/layout.h"
#include "optimizer/transcription.h"

namespace spacetime::optimizer {

struct Values {
  double objective = 0;          // soft rows among it
  std::vector<double> terms;     // weighted, one a term of the objective
  std::vector<double> residual;  // one a row: c, r or z - F, in its own units
  bool finite = true;
};

// Derivatives, in the positions of the KKT matrix.
struct Linearisation {
  Eigen::VectorXd gradient;  // of the objective without soft rows; zero at rows
  BorderedMatrix jacobian;   // entries between rows and unknowns
  BorderedMatrix hessian;    // entries among unknowns: of f + sum multiplier c, without w J^T J of the soft rows
};

// Memory that evaluations reuse.
struct Workspace {
  std::vector<double> inputs, outputs;
  std::vector<const double*> pointers;
  std::vector<std::uint8_t> uniform;
};

// How much a residual violates its relation.
inline double excess(const Row& row, double residual) { return row.at_most && residual < 0 ? 0 : residual; }

// Which rows count at x: all but those whose condition fails there.
std::vector<char> active_rows(const Transcription& transcription, std::span<const double> x, Workspace& workspace);

// Rows that are not active are met; all are where `active` is empty.
Values evaluate(const Transcription& transcription, std::span<const double> x, Workspace& workspace,
                std::span<const char> active = {});

// The residuals c, one a row, in KKT positions; and of such: the weights of soft rows that ask something, 0 elsewhere.
Eigen::VectorXd residual_of(const Transcription& transcription, const Layout& layout, const Values& values);
Eigen::VectorXd soft_weights(const Transcription& transcription, const Layout& layout, const Eigen::VectorXd& c);
// The largest component of a Lagrangian's gradient at a free unknown, over that of the objective's or 1.  Both in KKT
// positions.
double stationarity_of(const Layout& layout, const Eigen::VectorXd& lagrangian, const Eigen::VectorXd& objective);

// `result` must have been made for this layout.
Linearisation start_linearisation(const Layout& layout);

// Gradient, Jacobian, and the objective's part of the Hessian.
void linearise(const Transcription& transcription, const Layout& layout, std::span<const double> x,
               Workspace& workspace, Linearisation& result, std::span<const char> active = {});

// Gradient and Jacobian alone, all rows being active; the Hessian is left as it was.
void differentiate(const Transcription& transcription, const Layout& layout, std::span<const double> x,
                   Workspace& workspace, Linearisation& result);

// Adds the rows' part of the Hessian.  `values` must be those at x; `multipliers` has one number a row (those of soft
// rows are not read: they are w r).
void add_row_curvature(const Transcription& transcription, const Layout& layout, std::span<const double> x,
                       const Values& values, std::span<const double> multipliers, Workspace& workspace,
                       Linearisation& result, std::span<const char> active = {});

// The Hessian of sum multiplier c over hard rows alone.
void set_violation_curvature(const Transcription& transcription, const Layout& layout, std::span<const double> x,
                             std::span<const double> multipliers, Workspace& workspace, BorderedMatrix& curvature,
                             std::span<const char> active = {});

// Sets the unknowns of functionals to the functionals' values, in order.
void settle_functionals(const Transcription& transcription, std::vector<double>& x, Workspace& workspace);

}  // namespace spacetime::optimizer
