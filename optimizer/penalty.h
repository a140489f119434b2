// The unconstrained problem of 1994: constraints as a price.
//
//   F(x) = f(x) + w sum c_i(x)^2 + w sum max(0, violated amount of inequality or bound)^2      [LGC94 eq. 21]
//
// Soft constraints are in f with weights of their own.  Functionals are no unknowns here: z is always F's value, and
// the gradient follows by the chain rule through the rows z - F(x) = 0.
#pragma once

#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {

// At one point.  Gradients are by the free unknowns, in order: all but those of functionals and what a window fixes.
struct PenaltyPoint {
  std::vector<double> x;  // of all unknowns
  Values values;
  double value = 0;           // F
  Eigen::VectorXd gradient;   // of F
  double objective_size = 0;  // largest component of the gradient of f
  double violation = 0;       // largest, in its own units
  bool finite = false;
};

class Penalty {
 public:
  // Both must outlive it.
  Penalty(const Transcription& transcription, const Layout& layout, double weight);

  int size() const { return static_cast<int>(free_.size()); }
  std::vector<double> moved(std::vector<double> x, const Eigen::VectorXd& change) const;  // by free unknowns
  double most_length(const Eigen::VectorXd& change) const;                                // see layout.h; likewise
  PenaltyPoint at(std::vector<double> x);          // functionals among x are set to their values
  PenaltyPoint settled_at(std::vector<double> x);  // they have them already

  // The diagonal of F's Hessian without the curvature of constraints, in absolute value.
  Eigen::VectorXd curvature(const PenaltyPoint& point);

 private:
  Eigen::VectorXd reduced(Eigen::VectorXd gradient) const;
  double price(std::size_t row) const;  // what multiplies half a squared residual

  const Transcription& t_;
  const Layout& layout_;
  double weight_;
  std::vector<int> free_;  // unknowns
  Workspace workspace_;
  Linearisation linear_;
};

}  // namespace spacetime::optimizer
