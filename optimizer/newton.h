// Our method: Newton-Lagrange with exact second derivatives, globalised by a filter with second-order corrections and
// a radius that limits the step while the quadratic model does not yet hold.  optimizer/README.md tells why so.
#pragma once

#include <optional>
#include <vector>

#include "common/motion.h"
#include "optimizer/filter.h"
#include "optimizer/kkt.h"

namespace spacetime::optimizer {

// How things stand at a point.
struct Measures {
  double violation = 0;     // largest |c| over hard rows, in their own units
  double sum = 0;           // their sum: the filter's measure
  double stationarity = 0;  // largest component of the Lagrangian's gradient, over max(1, that of the objective's)
};

enum class StepResult {
  stepped,
  converged,   // nothing to do: the tolerance is met
  infeasible,  // the violation cannot be reduced from here, and is not small
  not_finite,  // the objective, a constraint or a derivative is not a number here
  singular,    // no regularisation made the system solvable
  exhausted,   // no step is acceptable: rounding hides any further progress
};

struct NewtonState {
  std::vector<double> x;
  Values values;
  Linearisation linear;             // at x
  Eigen::VectorXd gradient;         // of the whole objective, soft rows among it, in KKT positions
  std::vector<double> multipliers;  // one a row; the sign is that of  gradient + A^T multipliers = 0
  Measures measures;
  StepResult condition = StepResult::stepped;  // not_finite or singular where x cannot be gone on from

  Filter filter;
  double most_violation = 0;  // of the start; 0: not begun
  double shift = 0;           // the inertia correction that was needed last, decaying
  double radius = 0;          // limit on the change of a coefficient while the model does not hold
  double restore_from = 0;    // while the violation alone is reduced: its sum where that began
  double damping = 0;         // of those steps
  int iterations = 0;

  double step = 0, shift_used = 0;  // of the last step: largest change of a coefficient, correction
  Seconds seconds;                  // evaluating and factoring so far
};

class Newton {
 public:
  // Both must outlive it.
  Newton(const Transcription& transcription, const Layout& layout);

  NewtonState start(std::vector<double> x);

  // One accepted step, or why there is none.  The state holds the point reached, judged.
  StepResult step(NewtonState& state, double tolerance);

  int pivoted_solves() const { return kkt_.pivoted_solves(); }

 private:
  struct Trial {
    std::vector<double> x;
    Values values;
    double sum = 0;  // of hard violations
  };
  // The step's direction, and what the quadratic model says along it.
  struct Model {
    Eigen::VectorXd d, multipliers;  // at unknowns; at hard rows: new ones
    double size = 0;                 // largest change of a coefficient
    double descent = 0;              // of the objective along d
    double pull = 0;                 // of multipliers * c along d
    double curvature = 0;            // of the Lagrangian along d
    double lagrangian = 0;           // here
    double price = 0;                // of the present violation: sum |multiplier c|
  };
  enum class Verdict { rejected, objective_step, violation_step };

  Model model_of(const NewtonState& state, const Eigen::VectorXd& solution) const;
  double lagrangian(const Model& model, const Values& values) const;
  bool holds(const Model& model, const Trial& trial, double length, double error) const;
  Verdict verdict(const NewtonState& state, const Model& model, const Trial& trial, double length) const;
  std::optional<Trial> corrected(NewtonState& state, const Model& model, const Trial& trial, double length);
  StepResult search(NewtonState& state, const Model& model, double tolerance);
  StepResult restore(NewtonState& state, double tolerance);

  Trial try_at(NewtonState& state, const Eigen::VectorXd& change) const;
  void accept(NewtonState& state, Trial trial);
  void judge(NewtonState& state);
  Eigen::VectorXd residual_of(const Values& values) const;
  double largest_change(const Eigen::VectorXd& direction) const;

  const Transcription& t_;
  const Layout& layout_;
  mutable Workspace workspace_;
  Kkt kkt_;
  Eigen::VectorXd soft_weight_;  // w at soft rows' positions, else 0
};

}  // namespace spacetime::optimizer
