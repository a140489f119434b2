// Acts: lines of the scene language, performed one after another.  A line is compiled as the end of the present text;
// then its actions are sent, and when all are answered the line is part of the text.
#include <algorithm>
#include <limits>

#include "gui/apply.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

using Kind = Wanted::Kind;
using Place = Notice::Place;

// Acts that wait; somebody who asks for more asks a daemon that does not answer.
constexpr std::size_t most_tasks = 64;

// Whether two problems are the same but for their actions.
bool same_but_for_actions(const Problem& a, const Problem& b) {
  return a.start == b.start && a.end == b.end && a.constants == b.constants && a.parameters == b.parameters &&
         a.dofs == b.dofs && a.programs == b.programs && a.functionals == b.functionals &&
         a.constraints == b.constraints && a.objective == b.objective && a.keyframes == b.keyframes &&
         a.plots == b.plots && a.bodies == b.bodies;
}

std::ptrdiff_t actions_of(const Scene& scene) { return std::ranges::count_if(scene.outline, &Statement::action); }

bool iterates(const Statement& statement) { return statement.word == "solve" || statement.word == "iterate"; }

std::string with_line_end(std::string text) {
  if (text.empty() || text.back() != '\n') text += '\n';
  return text;
}

// What is wrong with the act, its lines counted from its own first; what is wrong elsewhere comes second.
std::string mistakes(const Scene& compiled, int lines_before) {
  std::string sentences;
  for (const Diagnostic& diagnostic : compiled.diagnostics) {
    if (!sentences.empty()) sentences += "\n";
    const int line = diagnostic.span.line - lines_before;
    if (line > 1) sentences += "line " + std::to_string(line) + ": ";
    sentences += diagnostic.message;
  }
  return sentences;
}

// Part of an act may have been done: the optimizer is to be led back to where the present entry is.
void lose_place(State& state, Effects& effects) {
  Work& work = state.work;
  work.at = 0;
  if (!work.run) return;
  work.discarded = true;
  notify(state, {.place = Place::optimisation,
                 .severity = Severity::warning,
                 .text = "The run was given up: an act beside it was left half done.",
                 .until = state.clock + 10});
  stop_run(state, effects);
}

// The statements that the act adds, with their places in its own text.
std::vector<Statement> added_statements(const Scene& base, const Scene& compiled, std::size_t begin, int lines) {
  std::vector<Statement> added(compiled.outline.begin() + static_cast<std::ptrdiff_t>(base.outline.size()),
                               compiled.outline.end());
  for (Statement& statement : added) {
    statement.begin -= begin;
    statement.end -= begin;
    statement.line -= lines;
  }
  return added;
}

// How many runs there were up to the present entry; of a session that was brought back each entry that iterated is one.
int runs_up_to(const State& state) {
  int runs = 0;
  for (int i = 0; i <= state.present; ++i) {
    const Entry& entry = state.log[i];
    if (entry.iterated) runs = std::max(runs + (entry.record.run == 0 ? 1 : 0), entry.record.run);
  }
  return runs;
}

// A run that goes on where the last one ended is recorded with that, one after an edit anew, from the motion it began
// at.
void begin_record(State& state) {
  const Entry& entry = state.log[state.present];
  if (state.work.recorded == entry.number) return;
  state.record = {};
  state.record.run = runs_up_to(state) + 1;
  if (!entry.motion) return;
  const Motion& motion = *entry.motion;
  IterationRecord start;
  start.iteration = motion.iterations;
  start.objective = motion.objective;
  start.terms = motion.terms;
  start.violation = motion.violation;
  start.stationarity = std::numeric_limits<double>::quiet_NaN();  // a motion does not tell it
  state.record.iterations.push_back(std::move(start));
}

}  // namespace

void drop_notices_of_acts(State& state) {
  std::erase_if(state.notices, [](const Notice& notice) { return notice.until == 0 && !notice.lasting; });
}

bool push_task(State& state, Task task) {
  if (state.work.tasks.size() >= most_tasks) {
    notify(state, {task.place, Severity::error, "So many acts wait already that this one was dropped.", task.about});
    return false;
  }
  state.work.tasks.push_back(std::move(task));
  return true;
}

void apply(State& state, const Act& event, Effects&) {
  drop_notices_of_acts(state);
  push_task(state, {event.line, event.place, event.about, event.draft});
}

void apply(State& state, const RunScript&, Effects&) {
  drop_notices_of_acts(state);
  Work& work = state.work;
  if (!state.script.empty()) {
    work.scripting = true;
  } else if (!work.run && work.tasks.empty()) {
    work.tasks.push_back({.line = "solve", .place = Place::optimisation});
  }
}

void take_from_script(State& state) {
  if (!state.script.empty()) state.script.erase(state.script.begin());
}

void begin_task(State& state, Effects& effects) {
  Work& work = state.work;
  work.job.task = std::move(work.tasks.front());
  work.tasks.pop_front();
  if (!work.job.task->scripted) work.job.task->line = with_line_end(std::move(work.job.task->line));
  work.job.base = state.scene;
  ask_compile(state, effects, ready_for_more(state.scene->text) + work.job.task->line, {Kind::act_compile});
}

void compiled_base(State& state, const Compiled& event) {
  Work& work = state.work;
  Entry& entry = state.log[state.present];
  // A checkpoint may have brought iterations meanwhile: then once more.
  if (event.scene->text == state.scene->text) {
    if (event.scene->problem) entry.scene = state.scene = event.scene;
    work.inexact = false;
  }
  work.tasks.push_front(std::move(*work.job.task));
  work.job = {};
}

void compiled_task(State& state, const Compiled& event, Effects& effects) {
  Work& work = state.work;
  const Scene &base = *work.job.base, &compiled = *event.scene;
  const Task task = *work.job.task;
  const std::size_t begin = compiled.text.size() - task.line.size();
  const auto lines = static_cast<int>(std::count(compiled.text.begin(), compiled.text.begin() + begin, '\n'));
  if (!compiled.problem) return refuse_task(state, mistakes(compiled, lines), effects);
  auto statements = added_statements(base, compiled, begin, lines);
  if (statements.empty()) return refuse_task(state, "There is no statement in this line.", effects);
  const bool runs = std::ranges::any_of(statements, iterates);
  if (runs && statements.size() > 1) {  // each has its turn
    work.job = {};
    for (std::size_t i = statements.size(); i-- > 0;) {
      const std::size_t end = i + 1 < statements.size() ? statements[i + 1].begin : task.line.size();
      Task part = task;
      part.line = task.line.substr(statements[i].begin, end - statements[i].begin);
      part.merge = part.merge && i == 0;
      work.tasks.push_front(part);
    }
    if (task.scripted) {  // the script has them one by one, too
      take_from_script(state);
      for (std::size_t i = statements.size(); i-- > 0;) state.script.insert(state.script.begin(), work.tasks[i].line);
    }
    return;
  }
  if (runs && work.run) {
    work.tasks.push_front(task);
    work.tasks.front().iterates = true;
    work.job = {};
    return;
  }
  const bool declares = !same_but_for_actions(*base.problem, *compiled.problem);
  const bool acts = std::ranges::any_of(statements, &Statement::action);
  if (acts && !work.unloaded.empty()) return refuse_task(state, work.unloaded, effects);
  if (declares && work.inexact) return ask_compile(state, effects, base.text, {Kind::base});

  work.job.added = std::move(statements);
  if (declares) work.job.declared = compiled.problem;
  if (declares && work.unloaded.empty()) {
    Request request;
    request.method = "problem/update";
    request.problem = compiled.problem;
    request.answer = Request::Answer::done;
    ask(state, effects, std::move(request), {Kind::act_do});
    ++work.job.unanswered;
    work.job.changed = true;
  }
  const auto& actions = compiled.problem->actions;
  for (auto i = static_cast<std::size_t>(actions_of(base)); i < actions.size(); ++i) {
    const std::string action = json_of(actions[i].action);
    if (runs) {
      cut_redo(state);
      // What follows a drag is a part of it, and does not dawdle.
      work.run = ask_action(state, effects, action, {Kind::run}, task.merge ? 0 : state.pace);
      work.action = action;
      work.line = task.line;
      work.merge = task.merge;
      work.began = state.log[state.present].number;
      work.scripted = task.scripted;
      work.whole = is_of_many_starts(action);
      state.paused.reset();
      state.stopping = false;
      begin_record(state);
      if (!state.ghost || work.ghosted != work.began) {
        keep_ghost(state, state.curves);
        work.ghosted = 0;
      }
      work.job = {};
      return;
    }
    work.job.asked.push_back(action);
    ask_action(state, effects, action, {Kind::act_do});
    ++work.job.unanswered;
  }
  if (work.job.unanswered == 0) finish_task(state, effects);
}

void drop_acts(State& state, Effects& effects) {
  Work& work = state.work;
  work.tasks.clear();
  work.scripting = false;
  if (work.job.unanswered > 0) {
    forget(state, Kind::act_do);
    lose_place(state, effects);
  }
  forget(state, Kind::act_compile);
  forget(state, Kind::base);
  work.job = {};
}

void performed(State& state, const Done& event, Effects& effects) {
  Work& work = state.work;
  for (const Logged& logged : event.log) {
    if (!logged.line.empty()) work.job.prelude.push_back(logged.line);
  }
  work.job.changed = true;
  if (--work.job.unanswered > 0) return;
  work.job.refusal.empty() ? finish_task(state, effects) : refuse_task(state, work.job.refusal, effects);
}

void refuse_task(State& state, const std::string& why, Effects& effects) {
  Work& work = state.work;
  const Task task = *work.job.task;
  notify(state, {task.place, Severity::error, why, task.about});
  work.scripting = false;
  if (task.merge || (!work.tasks.empty() && work.tasks.front().merge)) work.tasks.clear();
  if (work.job.changed) lose_place(state, effects);
  work.job = {};
}

void finish_task(State& state, Effects& effects) {
  Work& work = state.work;
  const Task task = *work.job.task;
  // A checkpoint of the run that goes on may have brought iterations since it was compiled.
  auto scene = state.scene;
  const bool grown = scene->text != work.job.base->text;
  Entry entry;
  for (const std::string& line : work.job.prelude) {
    scene = appended(*scene, line + "\n", {iterating_statement(line)}, nullptr);
    entry.text += line + "\n";
  }
  scene = appended(*scene, task.line, work.job.added, work.job.declared);
  entry.text += trimmed(task.line);
  entry.actions = work.job.asked;
  entry.iterated = !work.job.prelude.empty();
  entry.scene = std::move(scene);
  // Its places are those of a text without the lines of the prelude.
  work.inexact = work.inexact || (work.job.declared && (entry.iterated || grown));
  const auto draft = task.draft ? state.drafts.find(task.about) : state.drafts.end();
  if (draft != state.drafts.end() && draft->second == *task.draft) state.drafts.erase(draft);
  if (task.scripted) take_from_script(state);
  // After a drag the curves shown are those it led to already.
  const auto& before = state.log[state.present].motion;
  if (!work.run) keep_ghost(state, before ? curves_of(*before) : state.curves);
  if (work.run && !state.record.iterations.empty())
    state.record.edits.push_back(state.record.iterations.back().iteration);
  work.job = {};
  if (!work.run) cut_redo(state);  // not before: what could be redone outlives an act that is refused
  append(state, std::move(entry), task.merge, true, effects);
  if (!work.run) work.ghosted = state.log.back().number;
  if (work.run) ask_motion(state, effects, {Kind::look});  // what a set constant is worth
}

}  // namespace spacetime::gui
