// What a session does to iterate: by Newton, by the papers' methods, from many starts.
#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "common/diagnostic.h"
#include "optimizer/resume.h"
#include "optimizer/session.h"
#include "optimizer/starts.h"

namespace spacetime::optimizer {
namespace {

// How far starts are shaken (rad or m).
constexpr double start_amplitude = 1;

// As long as it lives, one state stands where the other does.
class Instead {
 public:
  Instead(NewtonState& place, NewtonState& other) : place_(place), other_(other) { std::swap(place_, other_); }
  ~Instead() { std::swap(place_, other_); }
  Instead(const Instead&) = delete;
  Instead& operator=(const Instead&) = delete;

 private:
  NewtonState &place_, &other_;
};

constexpr auto ended_by_edit = "Stopped: an edit ended the solve from many starts, and no start has moved the motion.";

}  // namespace

void Session::act(const Solve& solve, const Watch& watch) {
  if (solve.starts > 1 && solve.method != Solve::Method::newton) {
    throw InputError("only the method 'newton' solves from many starts");
  }
  const int limit = solve.iterations.value_or(default_iterations);
  switch (solve.method) {
    case Solve::Method::newton:
      minima_.clear();
      if (solve.starts > 1) return solve_from_many(solve.starts, limit, solve.tolerance, watch);
      return iterate(limit, solve.tolerance, watch);
    case Solve::Method::sqp92:
      return iterate_by<Sqp92State>([&] { return Sqp92(now_->t(), now_->layout, solve.linear_cg); }, limit,
                                    solve.tolerance, watch);
    case Solve::Method::bfgs:
      if (watch.checkpoint) refuse_checkpoint(Bfgs(now_->t(), now_->layout).size());
      return iterate_by<BfgsState>([&] { return Bfgs(now_->t(), now_->layout); }, limit, solve.tolerance, watch);
  }
}

void Session::act(const Iterate& action, const Watch& watch) { iterate(action.iterations, Solve{}.tolerance, watch); }

void Session::iterate(int limit, double tolerance, const Watch& watch) {
  if (foreign()) restart(unknowns());
  iterate(limit, tolerance, watch, [&](bool) -> std::optional<Outcome> {
    const StepResult result = now_->newton.step(state_, tolerance);
    if (result == StepResult::stepped) return std::nullopt;
    return outcome_of(result, now_->t(), now_->layout, state_, tolerance);
  });
}

// The present motion, and others shaken from it with the seeds 1, 2, ...  The best end is gone on from.
void Session::solve_from_many(int starts, int limit, double tolerance, const Watch& watch) {
  const std::shared_ptr<Numerics> numerics = now_;  // an edit while threads are at work puts another in its place
  const int restarts = restarts_;                   // ... or the motion elsewhere
  const Transcription& t = numerics->t();
  std::vector<std::vector<double>> points{state_.x};
  const Curves own = curves();
  for (int seed = 1; seed < starts; ++seed) {
    Curves shaken = own;
    shake(numerics->problem, t.constants, numerics->freedom, Shake{{start_amplitude, {}, 0}, seed, {}}, seed, shaken);
    auto& x = points.emplace_back(state_.x);
    for (int dof = 0; dof < t.dofs(); ++dof) {
      std::copy_n(shaken[dof].begin() + t.from[dof], t.first[dof + 1] - t.first[dof], x.begin() + t.first[dof]);
    }
  }
  // The best of the starts that have ended is shown after each, in the order of the starts; the motion is moved at the
  // end only, so that an edit meanwhile edits the one there was.
  const int before = state_.iterations;
  std::size_t shown = 0, best = 0;
  int iterations = before;
  bool stopped = false;
  const auto asked_to_stop = [&] {
    stopped |= (watch.go_on && !watch.go_on()) || restarts_ != restarts;
    return stopped;
  };
  const auto look_on = [&](std::span<const Ending> ended) {
    while (shown < ended.size()) {
      if (better(ended[shown], ended[best], tolerance)) best = shown;
      iterations += ended[shown].state.iterations;
      ++shown;
      if (watch.progress) {
        NewtonState reached = ended[best].state;
        reached.iterations = iterations;
        const Instead instead(state_, reached);
        watch.progress(record());
      }
      if (shown < points.size() && asked_to_stop()) return false;
    }
    return shown == points.size() || !asked_to_stop();
  };
  if (asked_to_stop()) {
    if (restarts_ == restarts)
      stop(fmt::format("Interrupted before the first of {} starts. ", starts) + standing(tolerance));
    else
      stop(ended_by_edit);
    return;
  }
  const int threads = watch.threads > 0 ? watch.threads : static_cast<int>(std::thread::hardware_concurrency());
  auto endings = solve_from(t, numerics->layout, points, limit, tolerance, {threads, watch.around}, look_on);
  if (restarts_ != restarts) return stop(ended_by_edit);

  iterations = before;
  Seconds seconds = state_.seconds;
  for (std::size_t k = 0; k < endings.size(); ++k) {
    iterations += endings[k].state.iterations;
    seconds.evaluate += endings[k].state.seconds.evaluate;
    seconds.factor += endings[k].state.seconds.factor;
    if (better(endings[k], endings[best], tolerance)) best = k;
  }
  const StepResult result = endings[best].result;
  const auto ended = std::ranges::count(endings, false, &Ending::cut);
  const auto groups = distinct(endings, tolerance);
  std::size_t converged = 0;
  std::vector<Minimum> minima;
  for (const auto& group : groups) {
    const NewtonState& end = endings[group.front()].state;
    auto x = x_;
    now_->close(end.x, x);
    minima.push_back({end.values.objective + objective_outside_, group, trajectories(x)});
    converged += group.size();
  }
  now_->newton.complete(endings[best].state);
  minima_ = std::move(minima);
  state_ = std::move(endings[best].state);
  state_.iterations = iterations;
  state_.seconds = seconds;
  judged_ = true;
  other_ = {};
  const std::string found =
      fmt::format("{} converged, to {} distinct minim{}.", converged, groups.size(), groups.size() == 1 ? "um" : "a");
  if (stopped) {
    stop(fmt::format("Interrupted at {}, when of {} starts {} had ended and {} The best so far is kept. ",
                     nth_iteration(), starts, ended, found) +
         (result == StepResult::converged ? "It has converged." + standing_elsewhere(tolerance) : standing(tolerance)));
    if (watch.progress) watch.progress(record());
    return;
  }
  if (result == StepResult::stepped) {
    stop("Stopped at " + nth_iteration() + ". " + standing(tolerance));
  } else {
    outcome_ = outcome_of(result, now_->t(), now_->layout, state_, tolerance);
    outcome_.message += standing_elsewhere(tolerance);
  }
  outcome_.message += fmt::format(" Of {} starts {}", starts, found);
}

// By another method, which `make` makes: for the first step, and again for what edits have changed.  Where the same
// method has led here its state is gone on with: a run in pieces has the bits of the whole.
template <class State, class Make>
void Session::iterate_by(const Make& make, int limit, double tolerance, const Watch& watch) {
  auto method = std::make_unique<decltype(make())>(make());  // refused here, nothing is lost
  minima_.clear();
  iterate(limit, tolerance, watch, [&](bool afresh) -> std::optional<Outcome> {
    if (afresh) {
      try {
        method = std::make_unique<decltype(make())>(make());
      } catch (const InputError& error) {
        return Outcome{Status::stopped, fmt::format("Stopped at {}: {}.", nth_iteration(), error.what())};
      }
    }
    Seconds before;
    if (const State* led = std::get_if<State>(&other_)) {
      before = led->seconds;
    } else {
      other_ = method->start(state_.x);
    }
    State& state = std::get<State>(other_);
    const StepResult result = method->step(state, tolerance);
    state_.seconds.evaluate += state.seconds.evaluate - before.evaluate;
    state_.seconds.factor += state.seconds.factor - before.factor;
    state_.x = state.x;
    state_.values = state.values;
    state_.measures = state.measures;
    state_.condition = StepResult::stepped;
    state_.step = state.step;
    state_.shift_used = state.shift;
    if (result == StepResult::stepped) {
      ++state_.iterations;
      return std::nullopt;
    }
    if (result == StepResult::exhausted) {
      const std::string worst = worst_of(violations(now_->t(), state.x, state.values), tolerance);
      return Outcome{Status::stopped, method->ending(state) + "; " + worst + "."};
    }
    // What is told of the end is told of this point.
    state_.multipliers = state.multipliers;
    Workspace workspace;
    linearise(now_->t(), now_->layout, state_.x, workspace, state_.linear, state_.active);
    return outcome_of(result, now_->t(), now_->layout, state_, tolerance);
  });
}

void Session::iterate(int limit, double tolerance, const Watch& watch, const Step& step) {
  judged_ = true;
  int restarts = restarts_;
  for (int k = 0;; ++k) {
    const bool last = k >= limit;
    if (!last && watch.go_on && !watch.go_on()) {
      return stop("Interrupted at " + nth_iteration() + ". " + standing(tolerance));
    }
    const bool afresh = restarts_ != restarts;
    restarts = restarts_;
    judged_ = true;  // what edits have changed meanwhile is judged by what follows
    const auto use_up = [&] {
      stop("Stopped at " + nth_iteration() + ": no more were allowed. " + standing(tolerance));
    };
    if (last && state_.condition == StepResult::stepped && !reached(tolerance)) return use_up();
    std::optional<NewtonState> here;
    if (last) here = state_;
    torn_ = true;
    auto outcome = step(afresh);
    torn_ = false;
    if (outcome) {
      outcome_ = std::move(*outcome);
      outcome_.message += standing_elsewhere(tolerance);
      return;
    }
    if (here) {  // its conditions have changed sides: that it looked done is no reason to move it
      state_ = std::move(*here);
      return use_up();
    }
    if (watch.progress) watch.progress(record());
  }
}

// Says what is true of a motion that no `solve` or `iterate` has spoken of since it, or the problem, was edited.
void Session::judge(double tolerance) {
  iterate(0, tolerance, {});
  if (outcome_.status != Status::stopped) return;
  stop((state_.iterations == 0 ? "Nothing has been iterated yet. " : "Edited since " + nth_iteration() + ". ") +
       standing(tolerance) + standing_elsewhere(tolerance));
}

void Session::stop(std::string message) {
  outcome_ = {Status::stopped, std::move(message)};
  judged_ = true;
}

bool Session::reached(double tolerance) const {
  return state_.measures.within(tolerance) && state_.condition == StepResult::stepped;
}

std::string Session::nth_iteration() const { return fmt::format("iteration {}", state_.iterations); }

std::string Session::standing(double tolerance) const {
  return fmt::format("The gradient of the Lagrangian is at {:.3g} of the objective's; {}.",
                     state_.measures.stationarity, worst_of(violations(now_->t(), state_.x, state_.values), tolerance));
}

// What a window leaves to be said.
std::string Session::standing_elsewhere(double tolerance) const {
  if (!now_->part) return "";
  const auto x = settled();
  Workspace workspace;
  const auto all =
      violations(now_->whole, x, evaluate(now_->whole, x, workspace, active_rows(now_->whole, x, workspace)));
  const bool holds = std::ranges::all_of(all, [&](const Violation& v) { return v.max <= tolerance; });
  return " That is within the window" + (holds ? "." : "; over the whole time " + worst_of(all, tolerance) + ".");
}

}  // namespace spacetime::optimizer
