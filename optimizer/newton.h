// Our method: Newton-Lagrange with exact second derivatives and a primal-dual barrier for limits, globalised by a
// filter with second-order corrections and a radius that limits the step while the quadratic model does not yet hold.
// optimizer/README.md tells why so.  newton.cpp judges points and makes steps, search.cpp accepts them.
#pragma once

#include <optional>
#include <vector>

#include "common/motion.h"
#include "optimizer/filter.h"
#include "optimizer/kkt.h"
#include "optimizer/limits.h"

namespace spacetime::optimizer {

// How things stand at a point.
struct Measures {
  double violation = 0;     // largest of hard rows, in their own units
  double sum = 0;           // of |c| and |c + s|: the filter's measure
  double stationarity = 0;  // largest component of the Lagrangian's gradient, over max(1, that of the objective's)
  double gap = 0;           // sum of slack * multiplier over max(1, |objective|): what limits may still hide

  bool within(double tolerance) const {
    return violation <= tolerance && stationarity <= tolerance && gap <= tolerance;
  }
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
  Barrier barrier;
  bool outside = false;  // x touches or leaves its bounds
  Measures measures;
  StepResult condition = StepResult::stepped;  // not_finite or singular where x cannot be gone on from

  std::vector<char> active;    // rows whose condition holds
  std::vector<char> switches;  // how often each has changed sides

  Filter filter;
  double most_violation = 0;  // of the start
  double shift = 0;           // the inertia correction that was needed last, decaying
  double radius = 0;          // limit on the change of a coefficient while the model does not hold
  double restore_from = 0;    // while the violation alone is reduced: its sum where that began
  double damping = 0;         // of those steps
  bool curved = false;        // whether they take the violations' own curvature in
  Eigen::VectorXd sizes;      // of rows, at the last of those steps: violations are compared over their square roots
  double least_sum = 0;       // of violations, that a later step must fall below to be progress
  int without_progress = 0;   // steps since then
  Eigen::VectorXd proposed;   // the last step's multipliers, where they are better than the least-squares ones
  int iterations = 0;

  double step = 0, shift_used = 0;  // of the last step: largest change of a coefficient, correction
  Seconds seconds;                  // evaluating and factoring so far
};

class Newton {
 public:
  // Both must outlive it.
  Newton(const Transcription& transcription, const Layout& layout);

  // Near the dual point of an earlier solve, where there is one: the barrier then begins low, or where that solve ended
  // if what it had reached still holds.
  NewtonState start(std::vector<double> x, const Carried* carried = nullptr);

  // One accepted step, or why there is none.  The state holds the point reached, judged.
  StepResult step(NewtonState& state, double tolerance);

  // Adds what follows from a state's x, active rows and barrier: values, derivatives, multipliers, measures.  All else
  // that a step depends on is what a checkpoint keeps (resume.h): whatever is added to the state belongs there, too.
  void complete(NewtonState& state);

  int pivoted_solves() const { return kkt_.pivoted_solves(); }
  void set_pivoted_solves(int count) { kkt_.set_pivoted_solves(count); }

 private:
  struct Trial {
    std::vector<double> x;
    Values values;
    Barrier barrier;
    double sum = 0;    // the filter's measure
    double merit = 0;  // objective with barrier
    bool finite = false;
  };
  // The step's direction, and what the quadratic model says along it.
  struct Model {
    Eigen::VectorXd d, multipliers;    // at unknowns; at equations and limits: new ones
    Limits::Change change;             // of slacks and the barrier's multipliers
    double size = 0;                   // largest change of a coefficient
    double descent = 0;                // of the merit along d
    double pull = 0;                   // of multipliers * c along d
    double curvature = 0;              // of the Lagrangian along d
    double merit = 0, lagrangian = 0;  // here
    double price = 0;                  // of the present violation: sum |multiplier c|
  };
  enum class Verdict { rejected, objective_step, violation_step };

  // newton.cpp
  void judge(NewtonState& state);
  // Multipliers of equations, zero elsewhere, and what they leave of the gradient of the Lagrangian.
  struct Pull {
    Eigen::VectorXd multipliers, left;
    double squares = 0;  // sum over the free unknowns
  };
  Pull pull_of(const NewtonState& state, const Eigen::VectorXd& pulled, Eigen::VectorXd multipliers) const;
  Pull best_multipliers(NewtonState& state, const Eigen::VectorXd& pulled, Eigen::VectorXd least_squares) const;
  void move_inside(NewtonState& state);
  void settle_conditions(NewtonState& state);
  void lower_barrier(NewtonState& state, double tolerance) const;
  Model model_of(const NewtonState& state, Eigen::VectorXd solution) const;
  double filter_sum(const Eigen::VectorXd& c, const Barrier& barrier) const;
  double largest_change(const Eigen::VectorXd& direction) const;
  double most_length(const Eigen::VectorXd& direction) const { return optimizer::most_length(t_, layout_, direction); }

  // search.cpp
  Trial try_at(NewtonState& state, const Eigen::VectorXd& change, const Barrier& barrier) const;
  double lagrangian(const Model& model, const Trial& trial) const;
  bool holds(const Model& model, const Trial& trial, double length, double error) const;
  Verdict verdict(const NewtonState& state, const Model& model, const Trial& trial, double length) const;
  std::optional<Trial> corrected(NewtonState& state, const Model& model, const Trial& trial, double length);
  Barrier moved(const NewtonState& state, const Model& model, double length) const;
  StepResult search(NewtonState& state, const Model& model, double tolerance);
  bool stalls(NewtonState& state, double tolerance) const;
  StepResult begin_restoration(NewtonState& state, double merit, double tolerance);
  StepResult restore(NewtonState& state, double tolerance);
  BorderedMatrix violation_curvature(NewtonState& state, const Eigen::VectorXd& violation) const;
  Eigen::VectorXd sizes_of_statements(const NewtonState& state) const;
  void accept(NewtonState& state, Trial trial);

  const Transcription& t_;
  const Layout& layout_;
  mutable Workspace workspace_;
  Kkt kkt_;
  Limits limits_;
};

// Adds the time of its own life to a number.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds);
  ~Stopwatch();
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  double begun_;
};

// Constants of the method that both files share.
inline constexpr double first_radius = 0.6;  // see search.cpp
inline constexpr double rounding = 1e-13;    // of the objective: differences below are noise

}  // namespace spacetime::optimizer
