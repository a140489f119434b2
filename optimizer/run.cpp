#include "optimizer/run.h"

#include <fmt/format.h>

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

}  // namespace

Motion run(const Problem& problem, const RunOptions& options) {
  Session session(problem, options.start);
  std::vector<IterationRecord> records;
  bool ended = false;  // interrupted, or an action was refused
  Watch watch;
  watch.threads = options.threads;
  watch.progress = [&](const IterationRecord& record) {
    if (options.progress) options.progress(record);
    if (options.record) records.push_back(record);
  };
  watch.go_on = [&] {
    ended = options.interrupted && options.interrupted();
    return !ended;
  };
  watch.progress(session.record());

  auto actions = problem.actions;
  if (actions.empty()) actions.push_back({Solve{}, {}});
  for (int i = 0; i < static_cast<int>(actions.size()) && !ended; ++i) {
    session.declare(i);
    try {
      session.perform(as_asked(actions[i].action, options), watch);
    } catch (const InputError& error) {
      // What earlier actions reached is kept.
      const int line = actions[i].place.line;
      if (session.iterations() == 0) throw InputError(fmt::format("line {}: {}", line, error.what()));
      session.stop(fmt::format("Stopped before line {}: {}.", line, error.what()));
      ended = true;
    }
  }
  if (!ended) session.declare(static_cast<int>(actions.size()));  // what is declared after the last action is judged

  Motion motion = session.motion(options.tolerance.value_or(Solve{}.tolerance));
  motion.record = std::move(records);
  if (options.frames_per_second > 0) {
    motion.samples = session.samples(frame_times(problem.start, problem.end, options.frames_per_second));
  }
  return motion;
}

}  // namespace spacetime::optimizer
