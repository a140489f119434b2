// Runs and their progress, samples, the console, and whose answer an answer is.
#include <algorithm>

#include "gui/apply.h"
#include "gui/journal.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

using Kind = Wanted::Kind;
using Place = Notice::Place;

constexpr std::size_t most_console_lines = 200;
constexpr int most_console_waiting = 16;
constexpr double retry_pause = 1;  // s, after a sample was refused

std::optional<Wanted> take(State& state, int number) {
  const auto found = state.work.wanted.find(number);
  if (found == state.work.wanted.end()) return std::nullopt;
  const Wanted wanted = found->second;
  state.work.wanted.erase(found);
  return wanted;
}

void merge(Curves& curves, const Iterated& event) {
  for (const Trajectory& changed : event.changed) {
    const auto found = std::ranges::find(curves.dofs, changed.name, &Trajectory::name);
    if (found == curves.dofs.end()) continue;
    const Basis& basis = changed.basis.knots.empty() ? found->basis : changed.basis;
    if (static_cast<int>(changed.coefficients.size()) != basis.size()) continue;
    found->basis = Basis(basis);
    found->coefficients = changed.coefficients;
  }
  for (const auto& [name, value] : event.parameters) {
    for (auto& parameter : curves.parameters) {
      if (parameter.first == name) parameter.second = value;
    }
  }
}

void end_run(State& state) {
  Work& work = state.work;
  work.run = 0;
  state.stopping = work.unseen = work.discarded = work.pausing = work.whole = false;
}

// A record that is longer than can be drawn keeps its ends and every second of what lies between; what comes after is
// kept as it comes, until it is too long once more.
constexpr std::size_t most_records = 4096;

void thin(std::vector<IterationRecord>& records) {
  if (records.size() <= most_records) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < records.size(); ++i)
    if (i % 2 == 0 || i + 1 == records.size()) std::swap(records[kept++], records[i]);
  records.resize(kept);
}

// A run of which nothing is left: what it has shown goes, and the optimizer is led back to where the present entry is,
// since nobody knows how far it has come.  Answers that were asked for beside the run may be of its iterates.
void take_back_run(State& state) {
  Work& work = state.work;
  const bool seen = !work.unseen;
  end_run(state);
  work.at = 0;
  work.scripting = false;
  forget(state, Kind::checkpoint);
  forget(state, Kind::look);
  if (!seen) return;
  const auto ghost = work.ghosted == state.log[state.present].number ? state.ghost : nullptr;
  const auto pose = state.pose;
  show(state, state.log[state.present]);
  state.ghost = ghost;  // of the edit before the run
  state.pose = pose;
}

// One step less on the way to the present entry.
void count_step(State& state) {
  Work& work = state.work;
  if (--work.steps > 0) return;
  work.at = work.going;
  work.unloaded.clear();
  work.going = 0;
  work.sampled = -1;
}

std::string joined(const std::vector<Logged>& log) {
  std::string text;
  for (const Logged& logged : log) {
    if (!logged.line.empty()) text += logged.line + "\n";
  }
  return text;
}

// A run is over: what it came to is an entry of the log.
void finish_run(State& state, const Done& event, Effects& effects) {
  Work& work = state.work;
  if (work.discarded) {
    work.next_time = 0;
    return take_back_run(state);
  }
  const bool seen = !work.unseen, pausing = work.pausing;
  end_run(state);
  // Checkpoints of entries made during the run show its end, if they are answered after it.
  forget(state, Kind::checkpoint);
  work.next_time = 0;
  if (event.status == Status::failed || event.status == Status::infeasible) {
    notify(state, {Place::optimisation, Severity::warning, event.message});
  }
  const bool as_asked = event.log.size() == 1 && same_action(event.log.front().action, work.action);
  const std::string text = as_asked ? work.line : joined(event.log);
  if (text.empty()) {
    // Nothing was done, or nothing that could be done again.
    work.at = 0;
    work.scripting = false;
    if (seen) show(state, state.log[state.present]);
    if (seen) {
      notify(state, {.place = Place::optimisation,
                     .text = "Stopped, and back to the motion before: " + event.message,
                     .until = state.clock + 10});
    }
    return;
  }
  std::vector<Statement> statements;
  for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
    Statement statement = iterating_statement(trimmed(text.substr(begin, text.find('\n', begin) - begin)));
    if (as_asked) statement.text = trimmed(text);
    statement.line = static_cast<int>(std::count(text.begin(), text.begin() + begin, '\n')) + 1;
    statement.begin += begin;
    statement.end += begin;
    statements.push_back(std::move(statement));
    if (as_asked || text.find('\n', begin) == std::string::npos) break;
  }
  const Entry& last = state.log.back();
  Entry entry;
  entry.text = trimmed(text);
  entry.scene = appended(*last.scene, text, statements, nullptr);
  entry.iterated = true;
  if (work.scripted) take_from_script(state);
  if (seen) entry.record = state.record;
  // Where the person did something else meanwhile, or stands at what it began from, it stays an entry of its own.
  const bool behind = seen || state.present + 1 < static_cast<int>(state.log.size());
  append(state, std::move(entry), work.merge && behind && last.number == work.began, seen, effects);
  if (seen) work.recorded = state.log.back().number;
  if (!pausing || !seen || event.status != Status::stopped) return;
  int iterations = 0;
  for (const Logged& logged : event.log) iterations += iterations_in(logged.action);
  const std::string rest = rest_line(work.action, iterations);
  if (rest.empty()) return;
  state.paused = {state.log.back().number, rest, work.scripted};
  work.ghosted = state.log.back().number;  // it goes on, and so does what it began from
}

}  // namespace

void stop_run(State& state, Effects& effects) {
  if (!state.work.run || state.stopping) return;
  state.stopping = true;
  effects.push_back(Cancel{state.work.run});
}

void apply(State& state, const Pause&, Effects& effects) {
  if (!can_pause(state)) return;
  state.work.pausing = true;
  state.work.scripting = false;
  stop_run(state, effects);
}

void apply(State& state, const Continue&, Effects&) {
  if (!can_continue(state) || state.waiting > 0) return;
  push_task(state, {.line = state.paused->line, .place = Place::optimisation});
  state.work.scripting = state.paused->scripting && !state.script.empty();
}

void apply(State& state, const Stop&, Effects& effects) {
  state.paused.reset();
  state.work.pausing = false;
  state.work.scripting = false;
  std::erase_if(state.work.tasks, [](const Task& task) { return task.iterates; });
  stop_run(state, effects);
}

void apply(State& state, const Compiled& event, Effects& effects) {
  const auto wanted = take(state, event.number);
  if (!wanted) return;
  switch (wanted->kind) {
    case Kind::open_whole:
    case Kind::open_head:
      return opened(state, event, *wanted, effects);
    case Kind::base:
      return compiled_base(state, event);
    case Kind::act_compile:
      return compiled_task(state, event, effects);
    default:
      return went(state, event, effects);
  }
}

void apply(State& state, const Iterated& event, Effects& effects) {
  Work& work = state.work;
  const bool steered = work.drag && work.drag->run == event.number;
  if (!steered && (event.number != work.run || work.unseen || work.discarded)) return;
  if (state.curves) {
    auto curves = std::make_shared<Curves>(*state.curves);
    merge(*curves, event);
    state.curves = std::move(curves);
    ++state.revision;
  }
  if (!steered) {
    state.record.iterations.insert(state.record.iterations.end(), event.records.begin(), event.records.end());
    thin(state.record.iterations);
    return;
  }
  work.drag->moved = true;
  advance_drag(state, effects);
}

void apply(State& state, const Done& event, Effects& effects) {
  const auto wanted = take(state, event.number);
  if (!wanted) return;
  if (wanted->kind == Kind::run) return finish_run(state, event, effects);
  if (wanted->kind == Kind::act_do && state.work.job.task) return performed(state, event, effects);
  if ((wanted->kind == Kind::steer || wanted->kind == Kind::steer_run) && state.work.drag) {
    --state.work.drag->unanswered;
  }
  if (wanted->kind == Kind::go) count_step(state);
}

void apply(State& state, const Reached& event, Effects& effects) {
  const auto wanted = take(state, event.number);
  if (!wanted) return;
  Work& work = state.work;
  if (wanted->kind == Kind::checkpoint) {
    Entry* entry = entry_of(state, wanted->entry);
    if (!entry) return;
    work.unloaded.clear();
    entry->motion = event.motion;
    entry->checkpoint = event.checkpoint;
    // The run has gone on since the act: it has led here by so many iterations more.
    if (const std::string iterations = joined(event.log);
        !iterations.empty() && entry == &state.log.back() && entry != &state.log.front()) {
      const Scene& before = *(entry - 1)->scene;
      entry->scene = appended(*entry->scene, iterations, {iterating_statement(trimmed(iterations))}, nullptr);
      entry->text += "\n" + trimmed(iterations);
      entry->iterated = true;
      if (entry == &state.log[state.present]) state.scene = entry->scene;
      effects.push_back(JournalLine{journal_entry(*entry, before, state.log.size() - 1, state.script.size())});
    }
    effects.push_back(JournalLine{journal_checkpoint(*entry)});
    if (entry != &state.log[state.present] || work.drag) return;
  } else if (work.drag && wanted->kind == Kind::steer) {
    --work.drag->unanswered;
  }
  if (work.run) {  // newer curves are shown already
    if (!state.curves || work.unseen) return;
    auto curves = std::make_shared<Curves>(*state.curves);
    curves->constants = event.motion->constants;
    state.curves = std::move(curves);
  } else {
    state.motion = event.motion;
    state.curves = curves_of(*event.motion);
    work.next_time = std::min(work.next_time, state.clock);
  }
  ++state.revision;
}

void apply(State& state, const Sampled& event, Effects&) {
  if (!take(state, event.number)) return;
  state.work.sample = 0;
  state.samples = event.samples;
}

void apply(State& state, const Acknowledged& event, Effects&) {
  const auto wanted = take(state, event.number);
  if (wanted && wanted->kind == Kind::load) state.work.unloaded.clear();
  if (wanted && wanted->kind == Kind::go) count_step(state);
  if (wanted && wanted->kind == Kind::steer && state.work.drag) --state.work.drag->unanswered;
}

void apply(State& state, const Refused& event, Effects& effects) {
  const auto wanted = take(state, event.number);
  if (!wanted) return;
  Work& work = state.work;
  const auto tell = [&](Place place, const std::string& text) { notify(state, {place, Severity::error, text}); };
  switch (wanted->kind) {
    case Kind::open_whole:
    case Kind::open_head: {
      auto scene = std::make_shared<Scene>();
      scene->text = work.opening.value_or("");
      state.scene = scene;
      work.opening.reset();
      return tell(Place::status, "The scene cannot be compiled: " + event.message);
    }
    case Kind::load:
      if (Entry* entry = entry_of(state, wanted->entry)) {
        // A scene that is only being written: its text can be come back to.
        if (!entry->checkpoint) entry->checkpoint = std::make_shared<const std::string>();
        work.unloaded = event.message;
        forget(state, Kind::checkpoint);
      }
      return notify(state, {Place::optimisation, Severity::note, event.message});
    case Kind::base:
    case Kind::act_compile:
      if (work.job.task) refuse_task(state, event.message, effects);
      return;
    case Kind::act_do:
      if (!work.job.task) return;
      work.job.refusal = event.message;
      if (--work.job.unanswered == 0) refuse_task(state, event.message, effects);
      return;
    case Kind::run:
      take_back_run(state);
      return tell(Place::optimisation, event.message);
    case Kind::go:
    case Kind::go_compile:
      forget(state, Kind::go);
      work.steps = 0;
      work.failed = work.going;
      work.going = 0;
      return tell(Place::status, "The optimizer cannot be led back to here: " + event.message);
    case Kind::steer:
    case Kind::steer_run:
      if (work.drag) --work.drag->unanswered;
      return notify(
          state,
          {.place = Place::view, .severity = Severity::warning, .text = event.message, .until = state.clock + 4});
    case Kind::sample:
      work.sample = 0;
      work.next_time = state.clock + retry_pause;
      return;
    case Kind::console:
      return apply(state, Answered{event.number, event.message, true}, effects);
    case Kind::checkpoint:
    case Kind::look:
      return;
  }
}

void apply(State& state, const Ask& event, Effects& effects) {
  if (state.console.size() >= most_console_lines) state.console.erase(state.console.begin());
  ConsoleLine line;
  line.asked = event.by.empty() ? event.text : "d(" + event.text + ") / d" + event.by;
  const auto waiting =
      std::ranges::count_if(state.work.wanted, [](const auto& wanted) { return wanted.second.kind == Kind::console; });
  const bool possible = state.scene && state.scene->problem;
  if (!possible || waiting >= most_console_waiting) {
    line.wrong = true;
    line.waiting = false;
    line.answer = possible ? "The answers before are still awaited." : "The scene has mistakes: mend them first.";
    state.console.push_back(std::move(line));
    return;
  }
  Request request;
  request.symbolic = true;
  request.method = "expression/query";
  request.params = member("text", event.text) + "," + member("scene", state.scene->text);
  if (!event.by.empty()) request.params += "," + member("by", event.by);
  request.answer = Request::Answer::answered;
  line.number = ask(state, effects, std::move(request), {Kind::console});
  state.console.push_back(std::move(line));
}

// Answers find their line by its number, whoever else waits.
void apply(State& state, const Answered& event, Effects&) {
  state.work.wanted.erase(event.number);
  const auto line = std::ranges::find(state.console, event.number, &ConsoleLine::number);
  if (line == state.console.end()) return;
  line->answer = event.text;
  line->wrong = event.wrong;
  line->waiting = false;
}

}  // namespace spacetime::gui
