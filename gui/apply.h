// The parts of `update`: one `apply` an event, and what they share.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gui/effect.h"
#include "gui/event.h"
#include "gui/state.h"

namespace spacetime::gui {

// update_session.cpp: files, the log, undo.
void apply(State& state, const Open& event, Effects& effects);
void apply(State& state, const OpenText& event, Effects& effects);
void apply(State& state, const Save& event, Effects& effects);
void apply(State& state, const DropSession& event, Effects& effects);
void apply(State& state, const Undo& event, Effects& effects);
void apply(State& state, const Redo& event, Effects& effects);
void apply(State& state, const GoTo& event, Effects& effects);
void apply(State& state, const Film& event, Effects& effects);
void apply(State& state, const DropFilm& event, Effects& effects);
void apply(State& state, const Filmed& event, Effects& effects);
void apply(State& state, const FileRead& event, Effects& effects);
void apply(State& state, const FileFailed& event, Effects& effects);
void apply(State& state, const FileWritten& event, Effects& effects);
void apply(State& state, const FileChanged& event, Effects& effects);
void apply(State& state, const SettingsRead& event, Effects& effects);
void apply(State& state, const SessionsFound& event, Effects& effects);
void apply(State& state, const Restored& event, Effects& effects);
void opened(State& state, const Compiled& event, const Wanted& wanted, Effects& effects);
// Of the problem of an entry whose motion is not known, and asks for that.
void load_anew(State& state, const Entry& entry, Effects& effects);
void load(State& state, std::shared_ptr<const Problem> problem, Wanted wanted, Effects& effects);
// Leads the optimizer to the present entry, or goes on with it once its text is compiled.
void go(State& state, Effects& effects);
void went(State& state, const Compiled& event, Effects& effects);

// update_act.cpp: acts and the script.
void apply(State& state, const Act& event, Effects& effects);
void apply(State& state, const RunScript& event, Effects& effects);
void apply(State& state, const Pause& event, Effects& effects);
void apply(State& state, const Continue& event, Effects& effects);
bool push_task(State& state, Task task);  // false, and told: so many wait already that it was dropped
void take_from_script(State& state);      // its first line, which is in the text now
void begin_task(State& state, Effects& effects);
void compiled_task(State& state, const Compiled& event, Effects& effects);
void compiled_base(State& state, const Compiled& event);
void drop_notices_of_acts(State& state);                            // what was told of the last ones
void drop_acts(State& state, Effects& effects);                     // those that wait and the one that has its turn
void performed(State& state, const Done& event, Effects& effects);  // a part of the task
void refuse_task(State& state, const std::string& why, Effects& effects);
void finish_task(State& state, Effects& effects);

// update_run.cpp: runs, samples, the console; answers and where they belong.
void apply(State& state, const Stop& event, Effects& effects);
void apply(State& state, const Ask& event, Effects& effects);
void apply(State& state, const Compiled& event, Effects& effects);
void apply(State& state, const Iterated& event, Effects& effects);
void apply(State& state, const Done& event, Effects& effects);
void apply(State& state, const Reached& event, Effects& effects);
void apply(State& state, const Sampled& event, Effects& effects);
void apply(State& state, const Answered& event, Effects& effects);
void apply(State& state, const Acknowledged& event, Effects& effects);
void apply(State& state, const Refused& event, Effects& effects);
void stop_run(State& state, Effects& effects);

// update_drag.cpp.
void apply(State& state, const Steer& event, Effects& effects);
void apply(State& state, const Steered& event, Effects& effects);
void advance_drag(State& state, Effects& effects);
void leave_drag(State& state, Effects& effects);  // without a trace; the optimizer then stands nowhere

// update_view.cpp: how it is looked at.
void apply(State& state, const DropGhost& event, Effects& effects);
void apply(State& state, const Play& event, Effects& effects);
void apply(State& state, const SetPlayback& event, Effects& effects);
void apply(State& state, const Select& event, Effects& effects);
void apply(State& state, const Pin& event, Effects& effects);
void apply(State& state, const ShowSpan& event, Effects& effects);
void apply(State& state, const SetPace& event, Effects& effects);
void apply(State& state, const Remark& event, Effects& effects);
void apply(State& state, const SetPose& event, Effects& effects);
void apply(State& state, const CopyPose& event, Effects& effects);
void apply(State& state, const PastePose& event, Effects& effects);
void apply(State& state, const KeyPose& event, Effects& effects);
void apply(State& state, const Draft& event, Effects& effects);
void apply(State& state, const SetTheme& event, Effects& effects);
void apply(State& state, const Dismiss& event, Effects& effects);
void apply(State& state, const Tick& event, Effects& effects);
void apply(State& state, const DaemonIs& event, Effects& effects);

// update.cpp: what they share.
int ask(State& state, Effects& effects, Request request, Wanted wanted);
void ask_compile(State& state, Effects& effects, std::string text, Wanted wanted);
// `pace`: of a run, in iterations a second; 0: as fast as it can.
int ask_action(State& state, Effects& effects, const std::string& action, Wanted wanted, double pace = 0);
void ask_motion(State& state, Effects& effects, Wanted wanted);    // with its checkpoint where that is wanted
void forget(State& state, Wanted::Kind kind);                      // answers of this kind are nobody's any more
std::string member(std::string_view name, std::string_view text);  // "name":"text", as JSON
void notify(State& state, Notice notice);
constexpr double remark_seconds = 6;                 // a remark stays so long
void remark(State& state, const std::string& text);  // quietly, in the status line, for a few seconds
Entry* entry_of(State& state, int number);           // null where it is cut away
bool ready(const State& state);                      // there is a problem to act on

// The log.
std::string ready_for_more(std::string text);  // with a line's end, unless a statement can follow where it ends
std::shared_ptr<const Scene> appended(const Scene& base, const std::string& added,
                                      const std::vector<Statement>& statements, std::shared_ptr<const Problem> problem);
Statement iterating_statement(const std::string& line);
void cut_redo(State& state);
// Appends (or merges into the last) and asks for its checkpoint; it becomes the present one where `seen`.
void append(State& state, Entry entry, bool merge, bool seen, Effects& effects);
void show(State& state, const Entry& entry);  // its motion, at once
std::shared_ptr<const Curves> curves_of(const Motion& motion);
void keep_ghost(State& state, std::shared_ptr<const Curves> curves);  // the motion of the present entry

}  // namespace spacetime::gui
