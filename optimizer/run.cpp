#include "optimizer/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/diagnostic.h"
#include "common/sample.h"
#include "optimizer/session.h"

namespace spacetime::optimizer {
namespace {

// The action with what the caller asked for in place of its own.
Action as_asked(Action action, const RunOptions& options) {
  if (auto* solve = std::get_if<Solve>(&action)) {
    if (options.iterations) solve->iterations = options.iterations;
    if (options.tolerance) solve->tolerance = *options.tolerance;
  } else if (const auto* iterate = std::get_if<Iterate>(&action); iterate && options.tolerance) {
    Solve some;
    some.iterations = iterate->iterations;
    some.tolerance = *options.tolerance;
    return some;
  }
  return action;
}

// What is left of an action of which so many iterations are done.
Action rest_of(Action action, int done) {
  if (auto* solve = std::get_if<Solve>(&action)) {
    solve->iterations = std::max(0, solve->iterations.value_or(default_iterations) - done);
  } else if (auto* iterate = std::get_if<Iterate>(&action)) {
    iterate->iterations = std::max(0, iterate->iterations - done);
  }
  return action;
}

bool has_many_starts(const Action& action) {
  const auto* solve = std::get_if<Solve>(&action);
  return solve && solve->starts > 1;
}

Checkpoint::Progress progress_of(const std::optional<Motion>& start, int actions) {
  if (!start || !start->checkpoint) return {};
  const auto& progress = start->checkpoint->progress;
  if (!progress) {
    throw CheckpointError("/checkpoint",
                          "it was made in a session, not while the problem's own actions were performed; "
                          "use the motion without its checkpoint");
  }
  if (progress->action > actions || progress->iterations > start->iterations) {
    throw CheckpointError("/checkpoint/progress", "the problem has no such action, or the motion fewer iterations");
  }
  return *progress;
}

}  // namespace

Motion run(const Problem& problem, const RunOptions& options) {
  auto actions = problem.actions;
  if (actions.empty()) actions.push_back({Solve{}, {}});
  const int count = static_cast<int>(actions.size());
  Checkpoint::Progress progress = progress_of(options.start, count);
  const bool resumed = options.start && options.start->checkpoint;

  Session session(problem, resumed ? std::nullopt : options.start);
  if (resumed) session.set_motion(*options.start);
  std::vector<IterationRecord> records;
  bool interrupted = false, ended = false;  // or an action was refused
  Watch watch;
  watch.threads = options.threads;
  watch.checkpoint = options.checkpoint;
  if (options.progress || options.record) {
    watch.progress = [&](const IterationRecord& record) {
      if (options.progress) options.progress(record);
      if (options.record) records.push_back(record);
    };
  }
  watch.go_on = [&] {
    ended = interrupted = options.interrupted && options.interrupted();
    return !ended;
  };
  if (watch.progress) watch.progress(session.record());
  if (resumed && !options.start->record.empty() && options.record) records = options.start->record;

  while (progress.action < count && !ended) {
    const auto& [asked, place] = actions[progress.action];
    const Action action = as_asked(asked, options);
    session.declare(progress.action);
    const int before = session.iterations() - progress.iterations;
    const std::size_t recorded = records.size();
    std::optional<Motion> beginning;
    if (options.checkpoint && has_many_starts(action)) beginning = session.moment();
    try {
      session.perform(rest_of(action, progress.iterations), watch);
    } catch (const InputError& error) {
      // What earlier actions reached is kept.
      if (session.iterations() == 0) throw InputError(fmt::format("line {}: {}", place.line, error.what()));
      session.stop(fmt::format("Stopped before line {}: {}.", place.line, error.what()));
      ended = true;
    }
    if (interrupted && beginning) {
      records.resize(recorded);
      session.set_motion(*beginning);
      session.stop(
          "Interrupted while solving from many starts: this is the motion before that, from where it resumes.");
    }
    progress.iterations = session.iterations() - before;
    const bool under_way = ended || (progress.action + 1 == count && !is_edit(action) && !has_many_starts(action));
    if (under_way) break;  // with more iterations it might go on
    progress = {progress.action + 1, 0};
  }
  std::optional<Checkpoint> checkpoint;
  if (options.checkpoint) {
    checkpoint = session.checkpoint();
    checkpoint->progress = progress;
  }
  if (!ended) session.declare(count);  // what is declared after the last action is judged

  Motion motion = session.motion(options.tolerance.value_or(Solve{}.tolerance));
  motion.checkpoint = std::move(checkpoint);
  motion.record = std::move(records);
  if (options.frames_per_second > 0) {
    motion.samples = session.samples(frame_times(problem.start, problem.end, options.frames_per_second));
  }
  return motion;
}

}  // namespace spacetime::optimizer
