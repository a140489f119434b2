// Where a run stood, so that it can be gone on with to the same bits as if it had never been interrupted.  A checkpoint
// belongs to a motion, whose curves, parameters, knots and number of iterations it does not repeat; what follows from
// all these (values, derivatives, multipliers of equations, measures) is computed again.
//
// Instances are the rows of the problem as edited, within its window: constraints in their order, each instance in
// time, component by component; unknowns those of degrees of freedom, functionals, parameters in this order.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/action.h"
#include "common/diagnostic.h"
#include "common/trajectory.h"

namespace spacetime {

// A checkpoint that does not fit.
class CheckpointError : public InputError {
 public:
  // `path`: the JSON pointer, in the motion's document, of what is at fault.
  CheckpointError(std::string path, std::string message)
      : InputError("motion document: " + path + ": " + message), path_(std::move(path)), message_(std::move(message)) {}
  const std::string& path() const { return path_; }
  const std::string& message() const { return message_; }  // without the path

 private:
  std::string path_, message_;
};

struct Checkpoint {
  // Which of the problem's own actions is under way, and how much of it is done.  An action that is no `solve` or
  // `iterate` is never under way: the next one is.
  struct Progress {
    int action = 0;      // the number of actions where all have been performed
    int iterations = 0;  // done of it
    bool operator==(const Progress&) const = default;
  };

  // What `reset` returns to, where that is not the keyframes.
  struct Start {
    std::vector<Trajectory> dofs;
    std::vector<std::pair<std::string, double>> parameters;
    bool operator==(const Start&) const = default;
  };

  // What a window leaves as it is, as it was measured when the window opened.
  struct Outside {
    double objective = 0;
    std::vector<double> terms;        // of the objective, then of soft constraints
    std::vector<double> functionals;  // one each
    bool operator==(const Outside&) const = default;
  };

  struct Newton {
    // The barrier; empty lists where nothing is limited.
    double mu = 0;
    std::vector<double> slacks, multipliers;  // of hard inequalities, by instance
    std::vector<double> lower, upper;         // multipliers of the unknowns' bounds, of those that have one
    bool outside = false;                     // a bound is touched or left: the next step begins by moving inside

    // `when`, of conditional instances: whether each counts (1) or not (0), and how often that has changed.
    std::vector<int> active, switches;

    struct Entry {
      double violation = 0, objective = 0;
      bool operator==(const Entry&) const = default;
    };
    std::vector<Entry> filter;
    double filter_limit = 0;    // most violation that it admits
    double most_violation = 0;  // where the solve began
    double shift = 0;           // the regularisation that was needed last, decaying
    double radius = 0;          // most change of a coefficient while the model does not hold
    double restore_from = 0;    // while the violation alone is reduced: its sum where that began
    double damping = 0;         // of those steps
    bool curved = false;        // whether they take the violations' own curvature in
    double least_sum = 0;       // the violation that is to be improved upon, and for how many steps it has not been
    int without_progress = 0;
    std::vector<double> proposed;  // multipliers of equations, where the step's are better than the least-squares ones
    bool operator==(const Newton&) const = default;
  };

  // By instance.
  struct Sqp92 {
    std::vector<double> multipliers, weights;
    bool operator==(const Sqp92&) const = default;
  };

  struct Bfgs {
    std::vector<double> inverse;  // H's lower triangle, row by row, by free unknowns but functionals
    bool operator==(const Bfgs&) const = default;
  };

  std::string problem;               // its fingerprint (protocol/problem_json)
  std::string fingerprint;           // of the motion's numbers and these, as a document told it; else empty
  std::optional<Progress> progress;  // where the problem's own actions are performed in turn
  int declared = 0;                  // statements that take effect before this action have done so
  std::vector<Action> edits;         // of the problem, since it was loaded
  Window window;
  std::vector<std::pair<std::string, double>> damping;  // by degree of freedom: most change in one iteration
  int shakes = 0;                                       // without a seed of their own, so far: seeds of the next
  std::optional<Start> start;
  bool judged = false;  // the motion's status speaks of it as it stands

  std::vector<double> functionals;  // their values as unknowns
  std::optional<Outside> outside;   // in a window
  double step = 0, last_shift = 0;  // of the last step: largest change of a coefficient, regularisation
  int pivoted = 0;                  // steps that needed a pivoted solve
  Newton newton;
  std::optional<Sqp92> sqp92;  // where that, or
  std::optional<Bfgs> bfgs;    // that, has led here; at most one
  bool operator==(const Checkpoint&) const = default;
};

// A dense H of more unknowns makes a longer document than anybody reads.
inline constexpr int most_bfgs_checkpoint = 2000;

}  // namespace spacetime
