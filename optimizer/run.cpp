#include "optimizer/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/diagnostic.h"
#include "common/sample.h"
#include "optimizer/newton.h"
#include "optimizer/sketch.h"

namespace spacetime::optimizer {
namespace {

using Clock = std::chrono::steady_clock;

// Without a limit of its own a solve ends after so many iterations: ten times what the hardest examples take.
constexpr int default_iterations = 1000;

struct Outcome {
  Status status = Status::stopped;
  std::string message;
};

// The largest violation of each hard constraint, in the scene's order.
std::vector<Violation> violations(const Transcription& t, const Values& values) {
  std::vector<Violation> result;
  std::vector<int> of_constraint(t.problem->constraints.size(), -1);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (row.kind != Row::Kind::hard) continue;
    int& index = of_constraint[row.statement];
    if (index < 0) {
      const Constraint& constraint = t.problem->constraints[row.statement];
      index = static_cast<int>(result.size());
      result.push_back({constraint.name, 0, std::nullopt, constraint.place.line});
      if (!std::isnan(row.time)) result.back().time = row.time;
    }
    const double amount = std::abs(excess(row, values.residual[r]));
    if (amount > result[index].max) {
      result[index].max = amount;
      if (!std::isnan(row.time)) result[index].time = row.time;
    }
  }
  return result;
}

std::string worst_of(const std::vector<Violation>& all) {
  const auto worst = std::ranges::max_element(all, {}, &Violation::max);
  if (worst == all.end() || worst->max == 0) return "every hard constraint holds";
  std::string text = fmt::format("'{}' (line {}) is off by {:.3g}", worst->name, worst->line, worst->max);
  if (worst->time) text += fmt::format(" at {:.4g} s", *worst->time);
  return text;
}

Outcome outcome_of(StepResult result, const Transcription& t, const NewtonState& state, double tolerance) {
  const std::string worst = worst_of(violations(t, state.values));
  switch (result) {
    case StepResult::converged:
      return {Status::converged,
              fmt::format("Hard constraints hold, and the gradient of the Lagrangian vanishes, to {:.3g}.", tolerance)};
    case StepResult::infeasible:
      return {Status::infeasible,
              "No motion near this one satisfies every hard constraint, and no change reduces the violation: " + worst +
                  ". Relax a constraint, give it a weight, or start from another sketch."};
    case StepResult::not_finite:
      return {Status::failed,
              "The objective or a constraint is not a finite number along this motion. Start from another sketch, or "
              "keep arguments of sqrt, log and divisions away from zero."};
    case StepResult::singular:
      return {Status::failed,
              "The equations of the step could not be solved however strongly they were regularised; " + worst + "."};
    case StepResult::exhausted:
      return {Status::stopped,
              fmt::format("Rounding hides any further progress: the gradient of the Lagrangian is down "
                          "to {:.3g} of the objective's; {}.",
                          state.measures.stationarity, worst)};
    case StepResult::stepped:
      break;
  }
  return {Status::stopped, ""};
}

class Runner {
 public:
  Runner(const Problem& problem, const RunOptions& options)
      : problem_(problem),
        options_(options),
        begun_(Clock::now()),
        t_(transcribe(problem)),
        layout_(arrange(t_)),
        newton_(t_, layout_) {
    auto x = options.start ? sketch_from(problem, t_.constants, *options.start) : sketch(problem, t_.constants);
    x.resize(t_.unknowns(), 0.0);
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
      const Parameter& parameter = problem.parameters[k];
      x[t_.first_parameter() + k] = evaluate(problem, t_.constants, parameter.start, "the start of " + parameter.name);
    }
    state_ = newton_.start(std::move(x));
  }

  Motion run() {
    report();
    auto actions = problem_.actions;
    if (actions.empty()) actions.push_back({Solve{}, {}});
    Outcome outcome;
    for (const PlacedAction& action : actions) {
      outcome = std::visit([&](const auto& a) { return perform(a, action); }, action.action);
      if (interrupted_) break;
    }
    return motion(outcome);
  }

 private:
  Outcome perform(const Solve& solve, const PlacedAction& placed) {
    if (solve.method == Solve::Method::sqp92) not_built(placed, "the method 'sqp92'");
    if (solve.method == Solve::Method::bfgs) not_built(placed, "the method 'bfgs'");
    if (solve.starts > 1) not_built(placed, "'starts'");
    return iterate(options_.iterations.value_or(solve.iterations.value_or(default_iterations)),
                   options_.tolerance.value_or(solve.tolerance));
  }
  Outcome perform(const Iterate& action, const PlacedAction&) {
    return iterate(action.iterations, options_.tolerance.value_or(Solve{}.tolerance));
  }
  template <class Other>
  Outcome perform(const Other&, const PlacedAction& placed) {
    not_built(placed, fmt::format("the action '{}'", name_of(placed.action)));
  }
  [[noreturn]] static void not_built(const PlacedAction& placed, std::string_view what) {
    throw InputError(fmt::format("line {}: {} is not built yet", placed.place.line, what));
  }

  Outcome iterate(int limit, double tolerance) {
    for (int k = 0;; ++k) {
      const bool last = k == limit;
      if (!last && options_.interrupted && options_.interrupted()) {
        interrupted_ = true;
        return {Status::stopped, "Interrupted after " + count() + ". " + standing()};
      }
      if (last && !reached(tolerance)) {
        return {Status::stopped, "Stopped after " + count() + ", as many as were allowed. " + standing()};
      }
      const StepResult result = newton_.step(state_, tolerance);
      if (result != StepResult::stepped) return outcome_of(result, t_, state_, tolerance);
      report();
    }
  }

  bool reached(double tolerance) const {
    return state_.measures.within(tolerance) && state_.condition == StepResult::stepped;
  }
  std::string count() const {
    return fmt::format("{} iteration{}", state_.iterations, state_.iterations == 1 ? "" : "s");
  }
  std::string standing() const {
    return fmt::format("The gradient of the Lagrangian is at {:.3g} of the objective's; {}.",
                       state_.measures.stationarity, worst_of(violations(t_, state_.values)));
  }

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

  void report() const {
    if (!options_.progress) return;
    options_.progress({state_.iterations, state_.values.objective, state_.measures.violation,
                       state_.measures.stationarity, state_.step, state_.shift_used, elapsed()});
  }

  Motion motion(const Outcome& outcome) {
    // Judged with functionals at their true values, so that each relation is measured in its own units.
    Workspace workspace;
    auto x = state_.x;
    settle_functionals(t_, x, workspace);
    const Values values = evaluate(t_, x, workspace, state_.active);

    Motion motion;
    motion.start = problem_.start;
    motion.end = problem_.end;
    motion.status = outcome.status;
    motion.message = outcome.message;
    if (newton_.pivoted_solves() > 0) {
      motion.message += fmt::format(" ({} of the steps needed a pivoted solve.)", newton_.pivoted_solves());
    }
    motion.iterations = state_.iterations;
    motion.objective = values.objective;
    for (std::size_t k = 0; k < problem_.objective.size(); ++k) {
      motion.terms.emplace_back(problem_.objective[k].name, values.terms[k]);
    }
    add_soft_terms(values, motion);
    motion.violations = violations(t_, values);
    for (const Violation& violation : motion.violations) motion.violation = std::max(motion.violation, violation.max);
    for (int dof = 0; dof < t_.dofs(); ++dof) {
      motion.dofs.push_back({problem_.dofs[dof].name,
                             problem_.dofs[dof].basis,
                             {x.begin() + t_.first[dof], x.begin() + t_.first[dof + 1]}});
    }
    for (std::size_t k = 0; k < problem_.parameters.size(); ++k) {
      motion.parameters.emplace_back(problem_.parameters[k].name, x[t_.first_parameter() + k]);
    }
    for (const Constant& constant : problem_.constants) {
      motion.constants.emplace_back(constant.name, t_.constants.at(constant.name));
    }
    if (options_.frames_per_second > 0) {
      const auto functionals = std::span(x).subspan(t_.first_functional());
      motion.samples =
          sample(problem_, motion, functionals, frame_times(problem_.start, problem_.end, options_.frames_per_second));
    }
    motion.seconds = state_.seconds;
    motion.seconds.total = elapsed();
    return motion;
  }

  void add_soft_terms(const Values& values, Motion& motion) const {
    std::vector<double> sums(problem_.constraints.size(), 0.0);
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      if (t_.rows[r].kind != Row::Kind::soft) continue;
      const double amount = excess(t_.rows[r], values.residual[r]);
      sums[t_.rows[r].statement] += t_.rows[r].weight / 2 * amount * amount;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      if (problem_.constraints[k].weight) motion.terms.emplace_back(problem_.constraints[k].name, sums[k]);
    }
  }

  const Problem& problem_;
  const RunOptions& options_;
  Clock::time_point begun_;
  Transcription t_;
  Layout layout_;
  Newton newton_;
  NewtonState state_;
  bool interrupted_ = false;
};

}  // namespace

Motion run(const Problem& problem, const RunOptions& options) { return Runner(problem, options).run(); }

}  // namespace spacetime::optimizer
