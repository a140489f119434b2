#include "optimizer/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "common/diagnostic.h"
#include "common/sample.h"
#include "optimizer/edit.h"
#include "optimizer/outcome.h"
#include "optimizer/sketch.h"

namespace spacetime::optimizer {
namespace {

using Clock = std::chrono::steady_clock;

// Without a limit of its own a solve ends after so many iterations: ten times what the hardest examples take.
constexpr int default_iterations = 1000;

// A problem with everything that is made from it.  The parts refer to one another, so it stays where it is.
struct Numerics {
  Problem problem;
  Transcription t;
  Layout layout;
  Newton newton;

  explicit Numerics(Problem p) : problem(std::move(p)), t(transcribe(problem)), layout(arrange(t)), newton(t, layout) {}
  Numerics(const Numerics&) = delete;
  Numerics& operator=(const Numerics&) = delete;
};

class Runner {
 public:
  Runner(const Problem& problem, const RunOptions& options)
      : options_(options), begun_(Clock::now()), edited_{problem, {}} {
    rebuild();
    state_ = now_->newton.start(declared_start());
  }

  Motion run() {
    report();
    auto actions = edited_.problem.actions;
    if (actions.empty()) actions.push_back({Solve{}, {}});
    for (; action_ < static_cast<int>(actions.size()) && !ended_; ++action_) {
      declare();
      const PlacedAction& placed = actions[action_];
      try {
        std::visit([&](const auto& action) { perform(action, name_of(placed.action)); }, placed.action);
      } catch (const InputError& error) {
        // What earlier actions reached is kept.
        if (state_.iterations == 0) throw InputError(fmt::format("line {}: {}", placed.place.line, error.what()));
        end(fmt::format("Stopped before line {}: {}.", placed.place.line, error.what()));
      }
    }
    if (!ended_) declare();  // what is declared after the last action is judged
    if (!judged_) perform(Iterate{0}, "iterate");
    return motion();
  }

 private:
  void perform(const Solve& solve, std::string_view) {
    if (solve.method == Solve::Method::sqp92) not_built("the method 'sqp92'");
    if (solve.method == Solve::Method::bfgs) not_built("the method 'bfgs'");
    if (solve.starts > 1) not_built("'starts'");
    iterate(options_.iterations.value_or(solve.iterations.value_or(default_iterations)),
            options_.tolerance.value_or(solve.tolerance));
  }
  void perform(const Iterate& action, std::string_view) {
    iterate(action.iterations, options_.tolerance.value_or(Solve{}.tolerance));
  }
  void perform(const Reset&, std::string_view) { restart(declared_start()); }
  void perform(const Control& control, std::string_view) {
    const Transcription& t = now_->t;
    const auto dof = std::ranges::find(t.problem->dofs, control.dof, &Dof::name) - t.problem->dofs.begin();
    const int size = t.problem->dofs[dof].basis.size();
    if (control.index >= size) {
      throw InputError(fmt::format("'{}' has {} coefficients, numbered from 0", control.dof, size));
    }
    auto x = state_.x;
    x[t.first[dof] + control.index] = evaluate(*t.problem, t.constants, control.value, "control " + control.dof);
    restart(std::move(x));
  }
  template <class Edit>
  requires requires(Edited& edited, const Edit& edit) { apply(edited, edit); }
  void perform(const Edit& edit, std::string_view) {
    Edited next = edited_;
    apply(next, edit);
    auto numerics = std::make_unique<Numerics>(in_effect(next, action_));  // refused here, nothing is lost
    edited_ = std::move(next);
    now_ = std::move(numerics);
    restart(state_.x);
  }
  template <class Other>
  void perform(const Other&, std::string_view name) {
    not_built(fmt::format("the action '{}'", name));
  }
  [[noreturn]] static void not_built(std::string_view what) {
    throw InputError(fmt::format("{} is not built yet", what));
  }

  // Statements declared since the last action take effect.
  void declare() {
    const auto begins = [&](const auto& statement) { return statement.since == action_ && action_ > 0; };
    if (std::ranges::any_of(edited_.problem.constraints, begins) ||
        std::ranges::any_of(edited_.problem.objective, begins)) {
      rebuild();
      restart(state_.x);
    }
  }

  void rebuild() { now_ = std::make_unique<Numerics>(in_effect(edited_, action_)); }

  // Goes on from x with the problem as it stands; unknowns stay in place, since only statements have changed.
  void restart(std::vector<double> x) {
    const int iterations = state_.iterations;
    const Seconds seconds = state_.seconds;
    state_ = now_->newton.start(std::move(x));
    state_.iterations = iterations;
    state_.seconds.evaluate += seconds.evaluate;
    state_.seconds.factor += seconds.factor;
    judged_ = false;
  }

  std::vector<double> declared_start() const {
    const Problem& problem = now_->problem;
    const Transcription& t = now_->t;
    auto x = options_.start ? sketch_from(problem, t.constants, *options_.start) : sketch(problem, t.constants);
    x.resize(t.unknowns(), 0.0);
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
      const Parameter& parameter = problem.parameters[k];
      double& p = x[t.first_parameter() + k];
      p = evaluate(problem, t.constants, parameter.start, "the start of " + parameter.name);
      if (!options_.start) continue;
      for (const auto& [name, value] : options_.start->parameters) {
        if (name == parameter.name) p = value;
      }
    }
    return x;
  }

  void end(std::string message) {
    outcome_ = {Status::stopped, std::move(message)};
    ended_ = judged_ = true;
  }

  void iterate(int limit, double tolerance) {
    judged_ = true;
    for (int k = 0;; ++k) {
      const bool last = k == limit;
      if (!last && options_.interrupted && options_.interrupted()) {
        return end("Interrupted after " + count() + ". " + standing());
      }
      if (last && !reached(tolerance)) {
        outcome_ = {Status::stopped, "Stopped after " + count() + ", as many as were allowed. " + standing()};
        return;
      }
      const StepResult result = now_->newton.step(state_, tolerance);
      if (result != StepResult::stepped) {
        outcome_ = outcome_of(result, now_->t, state_, tolerance);
        return;
      }
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
                       state_.measures.stationarity, worst_of(violations(now_->t, state_.x, state_.values)));
  }

  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

  void report() {
    const IterationRecord record{state_.iterations,
                                 state_.values.objective,
                                 state_.measures.violation,
                                 state_.measures.stationarity,
                                 state_.step,
                                 state_.shift_used,
                                 elapsed()};
    if (options_.progress) options_.progress(record);
    if (options_.record) record_.push_back(record);
  }

  Motion motion() {
    // Judged with functionals at their true values, so that each relation is measured in its own units.
    const Transcription& t = now_->t;
    const Problem& problem = now_->problem;
    Workspace workspace;
    auto x = state_.x;
    settle_functionals(t, x, workspace);

    Motion motion;
    motion.start = problem.start;
    motion.end = problem.end;
    motion.status = outcome_.status;
    motion.message = outcome_.message;
    if (const int pivoted = now_->newton.pivoted_solves(); pivoted > 0) {
      motion.message += fmt::format(" ({} of the steps needed a pivoted solve.)", pivoted);
    }
    motion.iterations = state_.iterations;
    measure(t, x, evaluate(t, x, workspace, state_.active), motion);
    for (int dof = 0; dof < t.dofs(); ++dof) {
      motion.dofs.push_back(
          {problem.dofs[dof].name, problem.dofs[dof].basis, {x.begin() + t.first[dof], x.begin() + t.first[dof + 1]}});
    }
    for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
      motion.parameters.emplace_back(problem.parameters[k].name, x[t.first_parameter() + k]);
    }
    for (const Constant& constant : problem.constants) {
      motion.constants.emplace_back(constant.name, t.constants.at(constant.name));
    }
    if (options_.frames_per_second > 0) {
      const auto functionals = std::span(x).subspan(t.first_functional());
      motion.samples =
          sample(problem, motion, functionals, frame_times(problem.start, problem.end, options_.frames_per_second));
    }
    motion.record = std::move(record_);
    motion.seconds = state_.seconds;
    motion.seconds.total = elapsed();
    return motion;
  }

  const RunOptions& options_;
  Clock::time_point begun_;
  Edited edited_;
  int action_ = 0;  // the next
  std::unique_ptr<Numerics> now_;
  NewtonState state_;
  Outcome outcome_;
  bool judged_ = false;  // the outcome speaks of the present point
  bool ended_ = false;   // interrupted, or an action was refused
  std::vector<IterationRecord> record_;
};

}  // namespace

Motion run(const Problem& problem, const RunOptions& options) { return Runner(problem, options).run(); }

}  // namespace spacetime::optimizer
