#include "gui/update.h"

#include <algorithm>

#include "common/sample.h"
#include "gui/apply.h"
#include "gui/journal.h"
#include "gui/words.h"
#include "protocol/writer.h"

namespace spacetime::gui {
namespace {

// How often samples are refreshed while the motion changes, s, and how many there are.
constexpr double sample_pause = 0.2;
constexpr int sample_count = 201;
constexpr int span_count = 401;  // more where less than all is shown: one for every few pixels

// Rising; those of the whole that come near the span's give way to them, since slopes are worked out by differences.
std::vector<double> sample_times(const Problem& problem, std::pair<double, double> span) {
  const std::vector<double> whole = even_times(problem.start, problem.end, sample_count);
  const double from = std::max(span.first, problem.start), to = std::min(span.second, problem.end);
  if (!(from < to) || (from == problem.start && to == problem.end)) return whole;
  const double near = (to - from) / (span_count - 1) / 2;
  std::vector<double> times;
  for (const double t : whole)
    if (t < from - near) times.push_back(t);
  for (const double t : even_times(from, to, span_count)) times.push_back(t);
  for (const double t : whole)
    if (t > to + near) times.push_back(t);
  return times;
}

void sample(State& state, Effects& effects) {
  Work& work = state.work;
  const bool there = work.run || (work.drag && work.drag->begun) || work.at == state.log[state.present].number;
  const bool known = work.sampled == state.revision && work.sampled_span == state.span;
  if (work.sample || !state.curves || known || !there || work.going) return;
  if (state.clock < work.next_time || state.optimizer.condition != Daemon::Condition::ready) return;
  Writer times(false);
  times.numbers(sample_times(*state.scene->problem, state.span));
  Request request;
  request.method = "sample";
  request.params = "\"times\":" + times.take();
  request.answer = Request::Answer::sampled;
  work.sample = ask(state, effects, std::move(request), {Wanted::Kind::sample});
  work.sampled = state.revision;
  work.sampled_span = state.span;
  work.next_time = state.clock + sample_pause;
}

// What is next, when nothing is under way.
void advance(State& state, Effects& effects) {
  Work& work = state.work;
  if (work.opening || work.job.task || work.going) return;
  if (!ready(state)) {
    if (!work.tasks.empty()) {
      const Task task = work.tasks.front();
      work.tasks.clear();
      notify(state, {task.place, Severity::error, "The scene has mistakes: mend them first.", task.about});
    }
    return;
  }
  const int present = state.log[state.present].number;
  if (work.run && (work.unseen || work.discarded)) return;
  if (!work.run && work.at != present && !(work.drag && work.drag->begun)) {
    if (work.failed != present) return go(state, effects);
    if (!work.tasks.empty()) {
      work.tasks.clear();
      notify(state, {Notice::Place::status, Severity::error,
                     "The optimizer is not where the session is: save it and open it again."});
    }
    return;
  }
  if (work.tasks.empty() && work.scripting && !work.run && !work.drag) {
    if (state.script.empty()) {
      work.scripting = false;
    } else {
      work.tasks.push_back({.line = state.script.front(), .scripted = true});
    }
  }
  if (!work.tasks.empty() && !(work.drag && work.drag->begun)) {
    if (!(work.tasks.front().iterates && work.run)) begin_task(state, effects);
  } else if (work.drag) {
    advance_drag(state, effects);
  }
  if (!work.job.task) sample(state, effects);
}

}  // namespace

Effects update(State& state, const Event& event) {
  Effects effects;
  std::visit([&](const auto& which) { apply(state, which, effects); }, event);
  advance(state, effects);
  state.running = state.work.run != 0;
  state.waiting = static_cast<int>(state.work.tasks.size()) + (state.work.job.task ? 1 : 0);
  return effects;
}

int ask(State& state, Effects& effects, Request request, Wanted wanted) {
  const int number = ++state.work.last;
  state.work.wanted[number] = wanted;
  request.number = number;
  effects.push_back(std::move(request));
  return number;
}

void ask_compile(State& state, Effects& effects, std::string text, Wanted wanted) {
  Request request;
  request.symbolic = true;
  request.method = "scene/compile";
  request.params = member("text", text);
  request.answer = Request::Answer::scene;
  request.text = std::move(text);
  ask(state, effects, std::move(request), wanted);
}

int ask_action(State& state, Effects& effects, const std::string& action, Wanted wanted, double pace) {
  const bool runs = wanted.kind == Wanted::Kind::run || wanted.kind == Wanted::Kind::steer_run;
  Request request;
  request.method = "action/do";
  request.params = "\"action\":" + action;
  if (pace > 0) request.params += ",\"pace\":" + number_text(pace);
  request.answer = runs ? Request::Answer::run : Request::Answer::done;
  return ask(state, effects, std::move(request), wanted);
}

void ask_motion(State& state, Effects& effects, Wanted wanted) {
  const bool checkpoint = wanted.kind == Wanted::Kind::checkpoint;
  Request request;
  request.method = "motion/get";
  request.params = checkpoint ? "\"checkpoint\":true,\"multipliers\":true" : "\"multipliers\":true";
  request.answer = checkpoint ? Request::Answer::checkpoint : Request::Answer::reached;
  ask(state, effects, std::move(request), wanted);
}

void forget(State& state, Wanted::Kind kind) {
  std::erase_if(state.work.wanted, [&](const auto& wanted) { return wanted.second.kind == kind; });
}

std::string member(std::string_view name, std::string_view text) {
  Writer to(false);
  to.string(name);
  Writer value(false);
  value.string(text);
  return to.take() + ":" + value.take();
}

void notify(State& state, Notice notice) {
  std::erase_if(state.notices, [&](const Notice& one) { return one.place == notice.place && one.text == notice.text; });
  constexpr std::size_t most = 20;
  if (state.notices.size() >= most) state.notices.erase(state.notices.begin());
  state.notices.push_back(std::move(notice));
}

void remark(State& state, const std::string& text) {
  notify(state, {.text = text, .until = state.clock + remark_seconds});
}

Entry* entry_of(State& state, int number) {
  const auto found = std::ranges::find(state.log, number, &Entry::number);
  return found == state.log.end() ? nullptr : &*found;
}

bool ready(const State& state) {
  return state.present >= 0 && state.present < static_cast<int>(state.log.size()) && state.scene &&
         (state.scene->problem || state.work.restored);
}

std::string ready_for_more(std::string text) {
  const auto last = text.find_last_not_of(" \t");
  if (last == std::string::npos || text[last] == '\n') return text;
  const auto line = text.rfind('\n') + 1;
  const bool separated = text[last] == ';' && text.find('#', line) == std::string::npos;
  return separated ? text : text + "\n";
}

std::shared_ptr<const Scene> appended(const Scene& base, const std::string& added,
                                      const std::vector<Statement>& statements,
                                      std::shared_ptr<const Problem> problem) {
  auto scene = std::make_shared<Scene>(base);
  scene->text = ready_for_more(std::move(scene->text));
  const auto begin = scene->text.size();
  const auto lines = static_cast<int>(std::ranges::count(scene->text, '\n'));
  scene->text += added;
  if (problem) scene->problem = std::move(problem);
  for (Statement statement : statements) {
    statement.line += lines;
    statement.begin += begin;
    statement.end += begin;
    scene->outline.push_back(std::move(statement));
  }
  return scene;
}

Statement iterating_statement(const std::string& line) {
  Statement statement;
  statement.word = line.substr(0, line.find_first_of(" \t\n"));
  statement.text = line;
  statement.line = statement.column = 1;
  statement.action = true;
  statement.end = line.size();
  return statement;
}

void cut_redo(State& state) { state.log.resize(static_cast<std::size_t>(state.present + 1)); }

void append(State& state, Entry entry, bool merge, bool seen, Effects& effects) {
  Work& work = state.work;
  if (merge && state.log.size() > 1) {
    Entry& into = state.log.back();
    entry.text = into.text + "\n" + entry.text;
    entry.actions.insert(entry.actions.begin(), into.actions.begin(), into.actions.end());
    entry.iterated = entry.iterated || into.iterated;
    if (seen) state.present = static_cast<int>(state.log.size()) - 2;
    state.log.pop_back();
  }
  entry.number = ++work.entries;
  effects.push_back(JournalLine{journal_entry(entry, *state.log.back().scene, state.log.size(), state.script.size())});
  state.log.push_back(std::move(entry));
  const Entry& last = state.log.back();
  work.at = last.number;
  if (seen) {
    state.present = static_cast<int>(state.log.size()) - 1;
    state.scene = last.scene;
  } else {
    effects.push_back(JournalLine{journal_present(state.present)});
  }
  if (!work.unloaded.empty()) return load_anew(state, last, effects);
  ask_motion(state, effects, {Wanted::Kind::checkpoint, last.number});
}

std::shared_ptr<const Curves> curves_of(const Motion& motion) {
  return std::make_shared<Curves>(Curves{motion.dofs, motion.constants, motion.parameters});
}

void keep_ghost(State& state, std::shared_ptr<const Curves> curves) {
  state.ghost = std::move(curves);
  state.ghost_entry = state.log[state.present].number;
}

void show(State& state, const Entry& entry) {
  state.scene = entry.scene;
  state.work.restored = !entry.scene->problem;
  state.ghost = nullptr;
  state.pose.reset();
  state.motion = entry.motion;
  state.curves = entry.motion ? curves_of(*entry.motion) : nullptr;
  ++state.revision;
  state.record = {};
  for (auto i = &entry - state.log.data(); i >= 0 && state.record.iterations.empty(); --i) {
    state.record = state.log[static_cast<std::size_t>(i)].record;
  }
}

}  // namespace spacetime::gui
