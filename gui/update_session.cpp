// Files, the log, and going to and fro in it.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "gui/apply.h"
#include "gui/journal.h"

namespace spacetime::gui {
namespace {

namespace fs = std::filesystem;
using Kind = Wanted::Kind;
using Place = Notice::Place;

constexpr std::size_t most_recent = 12;

// Nothing of the session before is left but how it is looked at.
void begin(State& state, std::string file, std::string saved, bool discard, Effects& effects) {
  if (!state.log.empty()) effects.push_back(JournalEnd{would_lose(state) && !discard});
  if (state.work.run) effects.push_back(Cancel{state.work.run});
  if (state.work.drag && state.work.drag->run) effects.push_back(Cancel{state.work.drag->run});
  State next;
  next.file = std::move(file);
  next.saved = std::move(saved);
  next.symbolic = state.symbolic;
  next.optimizer = state.optimizer;
  next.recent = std::move(state.recent);
  next.left = std::move(state.left);
  next.film = std::move(state.film);  // it is of the motion that was, and goes on
  next.clock = state.clock;
  next.dark = state.dark;
  next.pace = state.pace;
  next.playback = state.playback;
  next.playback.time = 0;
  next.playback.playing = false;
  next.revision = state.revision + 1;
  next.opened = state.opened + 1;
  next.work.last = state.work.last;
  next.work.entries = state.work.entries;
  for (const Notice& notice : state.notices)  // of daemons that are lost
    if (notice.lasting && notice.about.empty()) next.notices.push_back(notice);
  state = std::move(next);
  effects.push_back(WatchFile{state.file});
}

void open_text(State& state, std::string file, std::string text, bool discard, Effects& effects) {
  begin(state, file, text, discard, effects);
  state.work.opening = text;
  ask_compile(state, effects, std::move(text), {Kind::open_whole});
}

// A file that was read once more, as an editor beside the window has it, is looked at as it was before.
void look_as_before(State& state, const State& before, bool discard) {
  state.work.again = true;
  state.opened = before.opened;
  state.selection = before.selection;
  state.pins = before.pins;
  state.span = before.span;
  state.playback.time = before.playback.time;
  if (!discard) state.drafts = before.drafts;
  state.copied = before.copied;
  state.console = before.console;
  std::erase_if(state.console, &ConsoleLine::waiting);
}

void remember(State& state, const std::string& file, Effects& effects) {
  std::erase(state.recent, file);
  state.recent.insert(state.recent.begin(), file);
  if (state.recent.size() > most_recent) state.recent.resize(most_recent);
  effects.push_back(KeepSettings{state.dark, state.recent});
}

// Whether it is the last save that is answered; it is not awaited any more then.
bool answer_save(State& state, int number) {
  if (number == 0 || number != state.work.saving) return false;
  state.work.saving = 0;
  state.saving.clear();
  return true;
}

// Where an action's line begins: the spaces before it belong to it.
std::size_t line_begin(const std::string& text, std::size_t begin) {
  const std::size_t end = begin == 0 ? std::string::npos : text.find_last_not_of(" \t", begin - 1);
  if (end == std::string::npos) return 0;
  return text[end] == '\n' ? end + 1 : begin;
}

// The text up to its first action, and what follows it, statement by statement: together they are the text.
std::pair<std::string, std::vector<std::string>> split(const Scene& scene) {
  std::vector<std::size_t> cuts;
  for (const Statement& statement : scene.outline) {
    if (cuts.empty() && !statement.action) continue;
    cuts.push_back(line_begin(scene.text, statement.begin));
  }
  if (cuts.empty()) return {scene.text, {}};
  std::vector<std::string> script;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const std::size_t end = i + 1 < cuts.size() ? cuts[i + 1] : scene.text.size();
    script.push_back(scene.text.substr(cuts[i], end - cuts[i]));
  }
  return {scene.text.substr(0, cuts.front()), script};
}

// More curves than these at once are a tangle; the person chooses.
constexpr std::size_t curves_shown_first = 6;

template <typename Named>
void select_first(State& state, const std::vector<Named>& dofs) {
  state.selection = {};
  for (const Named& dof : dofs)
    if (state.selection.dofs.size() < curves_shown_first) state.selection.dofs.push_back(dof.name);
}

void begin_log(State& state, std::shared_ptr<const Scene> scene, Effects& effects) {
  Work& work = state.work;
  work.opening.reset();
  state.scene = scene;
  Entry entry;
  entry.text = scene->text;
  entry.scene = scene;
  entry.number = ++work.entries;
  state.log = {entry};
  state.present = 0;
  if (!scene->problem) return;
  state.script = std::move(work.script);
  const Problem& problem = *scene->problem;
  std::erase_if(state.selection.dofs, [&](const std::string& name) {
    return std::ranges::none_of(problem.dofs, [&](const auto& dof) { return dof.name == name; });
  });
  if (state.selection.dofs.empty() && state.selection.expressions.empty()) select_first(state, problem.dofs);
  const bool again = std::exchange(work.again, false);
  state.playback.time = again ? std::clamp(state.playback.time, problem.start, problem.end) : problem.start;
  load_anew(state, state.log.front(), effects);
  effects.push_back(JournalBegin{});
  effects.push_back(JournalLine{journal_begin(state)});
  if (!state.pins.empty()) effects.push_back(JournalLine{journal_pins(state)});
}

}  // namespace

void load(State& state, std::shared_ptr<const Problem> problem, Wanted wanted, Effects& effects) {
  Request request;
  request.method = "problem/load";
  request.problem = std::move(problem);
  ask(state, effects, std::move(request), wanted);
}

void load_anew(State& state, const Entry& entry, Effects& effects) {
  load(state, entry.scene->problem, {Kind::load, entry.number}, effects);
  state.work.at = entry.number;
  ask_motion(state, effects, {Kind::checkpoint, entry.number});
}

void apply(State&, const Open& event, Effects& effects) { effects.push_back(ReadFile{event.file, event.discard}); }

void apply(State& state, const OpenText& event, Effects& effects) {
  open_text(state, "", event.text, event.discard, effects);
}

void apply(State& state, const Film& event, Effects& effects) {
  if (state.film) return;  // one at a time
  if (state.running || state.steering)
    return notify(state, {Place::status, Severity::warning, "The motion is still changing: make pictures of it then."});
  const auto checkpoint = state.present < 0 ? nullptr : state.log[state.present].checkpoint;
  if (!checkpoint || checkpoint->empty())  // empty: of a scene that the optimizer could not take
    return notify(state, {Place::status, Severity::warning, "There is no motion to make pictures of yet."});
  state.film = {event.file, ""};
  const Entry& entry = state.log[state.present];
  MakeFilm make{event, entry.checkpoint, entry.scene->problem, state.dark};
  if (make.film.rate <= 0) make.film.rate = state.playback.rate;
  effects.push_back(std::move(make));
}

void apply(State& state, const DropFilm&, Effects& effects) {
  state.film.reset();
  effects.push_back(StopFilm{});
}

void apply(State& state, const Filmed& event, Effects&) {
  if (!state.film || state.film->first != event.file) return;
  state.film->second = event.text;
  if (event.what == Filmed::What::progress) return;
  state.film.reset();
  const bool done = event.what == Filmed::What::done;
  notify(state, {Place::status, done ? Severity::note : Severity::error,
                 done ? event.file + " is made." : event.file + " could not be made: " + event.text});
}

void apply(State& state, const FileRead& event, Effects& effects) {
  const State before = state;
  open_text(state, event.file, event.text, event.discard, effects);
  if (event.file == before.file) look_as_before(state, before, event.discard);
  remember(state, event.file, effects);
}

void apply(State& state, const FileFailed& event, Effects&) {
  answer_save(state, event.number);
  notify(state, {.severity = Severity::error, .text = event.message, .about = event.file, .lasting = true});
}

// A scene with mistakes, or one in which nothing was done, follows its file.
void apply(State& state, const FileChanged& event, Effects& effects) {
  if (event.refused) {
    if (answer_save(state, event.number)) state.work.overwrite = event.file;
    return notify(state, {.severity = Severity::warning,
                          .text = "Not saved: '" + event.file +
                                  "' was changed by another program since it was read. Save once more to replace "
                                  "what is there, or save under another name.",
                          .about = event.file,
                          .lasting = true});
  }
  if (event.file != state.file) return;
  if (state.log.size() <= 1 && !state.work.run && !unsaved(state)) {
    effects.push_back(ReadFile{event.file});
  } else {
    notify(state, {.severity = Severity::warning,
                   .text = "The file was changed by another program: open it again to see it.",
                   .about = event.file,
                   .lasting = true});
  }
}

void apply(State& state, const Save& event, Effects& effects) {
  const std::string file = event.file.empty() ? state.file : event.file;
  if (!state.scene) return;
  if (file.empty()) {
    notify(state, {Place::status, Severity::error, "The scene has no file yet: give it a name."});
    return;
  }
  const bool overwrite = std::exchange(state.work.overwrite, {}) == file;
  state.saving = file;
  state.work.saving = ++state.work.last;
  effects.push_back(WriteFile{file, text_to_save(state), overwrite, state.work.saving});
}

void apply(State& state, const FileWritten& event, Effects& effects) {
  // Of the scene before this one, or with another save behind it, which tells what this scene's file is.
  if (!answer_save(state, event.number)) return remember(state, event.file, effects);
  // Whatever was told of files was about this one, or one that matters no more.
  std::erase_if(state.notices, [](const Notice& notice) { return notice.lasting && !notice.about.empty(); });
  state.file = event.file;
  state.saved = event.text;
  remark(state, fs::path(event.file).filename().string() + " is saved.");
  effects.push_back(JournalLine{journal_saved(state)});
  effects.push_back(WatchFile{event.file});
  remember(state, event.file, effects);
}

void apply(State& state, const SettingsRead& event, Effects&) {
  state.dark = event.dark;
  state.recent = event.recent;
}

void apply(State& state, const SessionsFound& event, Effects&) { state.left = event.left; }

void apply(State& state, const Restored& event, Effects& effects) {
  begin(state, event.file, event.saved, event.discard, effects);
  std::erase_if(state.left, [&](const LeftBehind& one) { return one.journal == event.journal; });
  Work& work = state.work;
  state.log = event.log;
  state.script = event.script;
  for (Entry& entry : state.log) entry.number = ++work.entries;
  state.present = event.present;
  show(state, state.log[state.present]);
  if (state.motion) {
    state.playback.time = state.motion->start;
    select_first(state, state.motion->dofs);
  }
  // It goes on in a journal of its own.
  effects.push_back(JournalBegin{});
  effects.push_back(JournalLine{journal_begin(state)});
  for (std::size_t i = 0; i < state.log.size(); ++i) {
    const Entry& entry = state.log[i];
    if (i > 0) effects.push_back(JournalLine{journal_entry(entry, *state.log[i - 1].scene, i, state.script.size())});
    if (entry.checkpoint) effects.push_back(JournalLine{journal_checkpoint(entry)});
  }
  effects.push_back(JournalLine{journal_present(state.present)});
  state.pins = event.pins;
  effects.push_back(JournalLine{journal_pins(state)});
  effects.push_back(JournalDrop{event.journal, true});
}

void apply(State& state, const DropSession& event, Effects& effects) {
  std::erase_if(state.left, [&](const LeftBehind& one) { return one.journal == event.journal; });
  effects.push_back(JournalDrop{event.journal, false});
}

void opened(State& state, const Compiled& event, const Wanted& wanted, Effects& effects) {
  Work& work = state.work;
  if (wanted.kind == Kind::open_head || !event.scene->problem) return begin_log(state, event.scene, effects);
  auto [head, script] = split(*event.scene);
  if (script.empty()) return begin_log(state, event.scene, effects);
  state.scene = event.scene;  // to be looked at meanwhile
  work.script = std::move(script);
  ask_compile(state, effects, std::move(head), {Kind::open_head});
}

void go(State& state, Effects& effects) {
  Work& work = state.work;
  const Entry& entry = state.log[state.present];
  const bool awaited = std::ranges::any_of(work.wanted, [&](const auto& wanted) {
    return wanted.second.kind == Kind::checkpoint && wanted.second.entry == entry.number;
  });
  if (!entry.checkpoint && awaited) return;
  if (!entry.checkpoint && state.present > 0) {
    // It could not be asked for; the nearest one before it can be come back to.
    for (int i = state.present - 1; i >= 0; --i) {
      if (state.log[i].checkpoint) return apply(state, GoTo{i}, effects);
    }
  }
  if (!entry.scene->problem) {
    work.going = entry.number;
    return ask_compile(state, effects, entry.scene->text, {Kind::go_compile, entry.number});
  }
  if (!entry.checkpoint || entry.checkpoint->empty()) return load_anew(state, entry, effects);
  work.going = entry.number;
  load(state, entry.scene->problem, {Kind::go, entry.number}, effects);
  Request request;
  request.method = "motion/set";
  request.params = "\"motion\":" + *entry.checkpoint;
  ask(state, effects, std::move(request), {Kind::go, entry.number});
  work.steps = 2;
}

void went(State& state, const Compiled& event, Effects& effects) {
  Work& work = state.work;
  Entry* entry = entry_of(state, std::exchange(work.going, 0));
  if (!entry) return;
  entry->scene = event.scene;
  const bool present = entry == &state.log[state.present];
  if (present) state.scene = event.scene;
  if (!event.scene->problem) {
    work.failed = entry->number;
  } else if (present) {
    work.restored = false;
    go(state, effects);
  }
}

void apply(State& state, const GoTo& event, Effects& effects) {
  if (event.entry < 0 || event.entry >= static_cast<int>(state.log.size())) return;
  if (!state.log[event.entry].checkpoint) return;
  Work& work = state.work;
  drop_acts(state, effects);
  drop_notices_of_acts(state);  // they are of what is left
  work.failed = 0;
  if (work.drag) leave_drag(state, effects);
  if (work.going) {
    forget(state, Kind::go);
    forget(state, Kind::go_compile);
    work.at = work.going = 0;
  }
  if (work.run) {
    work.unseen = true;
    stop_run(state, effects);
  }
  forget(state, Kind::look);
  forget(state, Kind::sample);
  work.sample = 0;
  work.sampled = -1;
  work.next_time = 0;
  state.present = event.entry;
  show(state, state.log[event.entry]);
  effects.push_back(JournalLine{journal_present(event.entry)});
}

void apply(State& state, const Undo&, Effects& effects) {
  if (!can_undo(state)) return;
  const Work& work = state.work;
  const Task* next = work.job.task ? &*work.job.task : work.tasks.empty() ? nullptr : &work.tasks.front();
  const bool first_half = next && next->merge;  // of what is one act to the person
  if (state.waiting > 0) {                      // that was done last
    drop_acts(state, effects);
    if (work.discarded) show(state, state.log[state.present]);
    if (!first_half) return;
  }
  const bool runs = state.running && !work.unseen;
  int entry = state.present;
  if (!runs || (work.merge && work.began == state.log[entry].number)) --entry;
  while (entry >= 0 && !state.log[entry].checkpoint) --entry;
  apply(state, GoTo{entry}, effects);
}

void apply(State& state, const Redo&, Effects& effects) {
  if (!can_redo(state)) return;
  int entry = state.present + 1;
  while (!state.log[entry].checkpoint) ++entry;
  apply(state, GoTo{entry}, effects);
}

}  // namespace spacetime::gui
