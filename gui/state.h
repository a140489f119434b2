// What the person sees and does, as one value: the session, what the daemons said, and how it is looked at.  Only
// `update` (update.h) changes it; views read it; nothing here knows of windows, sockets or files.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/diagnostic.h"
#include "common/motion.h"
#include "common/problem.h"
#include "gui/notice.h"
#include "gui/work.h"

namespace spacetime::gui {

// Where a statement stands in the scene, as the symbolic daemon tells it.
struct Statement {
  std::string word;  // constrain, minimize, constant, let, solve, ...
  std::string name;  // what it declares; of unnamed constraints and objectives "constraint 3", "objective 1"
  std::string text;  // as written
  int line = 0;      // of its first character, from 1
  int column = 0;    // likewise
  bool action = false;
  std::size_t begin = 0, end = 0;  // bytes of the scene's text
  bool operator==(const Statement&) const = default;
};

// A scene text with what came of compiling it.
struct Scene {
  std::string text;
  std::shared_ptr<const Problem> problem;  // null where there are mistakes
  std::vector<Diagnostic> diagnostics;
  std::vector<Statement> outline;
};

// A motion as it is just now: the curves of the newest iterate, with the constants and parameters they go with.
struct Curves {
  std::vector<Trajectory> dofs;
  std::vector<std::pair<std::string, double>> constants;
  std::vector<std::pair<std::string, double>> parameters;
  bool operator==(const Curves&) const = default;
};

// The iterations of a run, for plots; of several where one went on from where the other ended.
struct Record {
  std::vector<IterationRecord> iterations;  // the first is where it began
  std::vector<int> edits;                   // numbers of iterations after which something was edited while it ran
  int run = 0;                              // which one of the session, from 1; 0: none

  int began() const { return iterations.empty() ? 0 : iterations.front().iteration; }
  int made() const { return iterations.empty() ? 0 : iterations.back().iteration - began(); }  // iterations
};

// One line of the log: something that was done, in the scene language, and where it led.
struct Entry {
  std::string text;                               // of the line or lines; of the first entry the scene as it was opened
  std::vector<std::string> actions;               // what the optimizer was asked, as JSON; not those that iterate
  std::shared_ptr<const Scene> scene;             // with this line and all before it
  std::shared_ptr<const Motion> motion;           // where it led; null until it is known
  std::shared_ptr<const std::string> checkpoint;  // the motion document to come back to; null where there is none
  bool iterated = false;                          // a `solve` or an `iterate` is in it
  Record record;                                  // of the run that led to it, where one did
  int number = 0;                                 // its own in this session, whatever its place in the log
};

struct Daemon {
  enum class Condition { starting, ready, lost } condition = Condition::starting;
  std::string why;   // it is not ready
  int restarts = 0;  // that were needed
  bool met = false;  // it has been ready before
};

// A constant, weight, key, slider or control point that is being dragged: the motion follows, and one line is left of
// it.
struct Steering {
  std::string line;                  // that would be written now: set BasketX = 2.71; set BasketY = 0.5
  std::vector<std::string> actions;  // the same, each as JSON
  std::vector<std::pair<std::string, double>> constants{};  // that it sets
  std::vector<std::pair<std::string, double>> weights{};    // likewise, of equations
  bool afresh = false;  // each value from the motion before the drag, not from where the one before it led
  bool solves = true;   // false: what it leads to is the edit alone, which solving would take back
};

struct ConsoleLine {
  std::string asked;
  std::string answer;
  bool wrong = false;
  bool waiting = true;
  int number = 0;  // of the request
};

// A session that ended without being saved: `Open{journal}` brings it back.
struct LeftBehind {
  std::string journal;  // the file it is kept in
  std::string file;     // the scene it began with; empty where that had none
  bool operator==(const LeftBehind&) const = default;
};

// How it is looked at.
struct Playback {
  double time = 0;  // s, shown in the scene view
  bool playing = false;
  bool loop = true;
  double speed = 1;  // times the clock
  double rate = 30;  // frames a second that steps and exports go by
};

// What may be selected, by name; views colour it alike everywhere.
struct Selection {
  std::vector<std::string> dofs;
  std::vector<std::string> expressions;  // plots shown beside the degrees of freedom
  std::string constraint;
  std::string constant;
  std::string body;
};

// A pose that is being made, before `K` keys it: values of degrees of freedom at Playback::time that the figure shows
// instead of the motion's.
struct Pose {
  std::map<std::string, double> values;
};

// A run that was paused: the line that goes on with it where the log still ends with what it reached.
struct Paused {
  int entry = 0;  // its number
  std::string line;
  bool scripting = false;  // the rest of the script follows
};

struct State {
  // The session.
  std::string file;                    // empty where it was never saved
  std::string saved;                   // the text that the file holds
  std::string saving;                  // the file that is being written; empty: none
  std::vector<Entry> log;              // the first is the scene as it was opened
  int present = -1;                    // index of the entry that is shown; those behind it can be redone
  std::vector<std::string> script;     // actions that the file brought and that were not performed yet, line by line
  std::shared_ptr<const Scene> scene;  // of the present entry, or the opened text with its mistakes

  // The motion.
  std::shared_ptr<const Curves> curves;  // newest; null before there is a problem
  std::shared_ptr<const Curves> ghost;   // the motion before the last edit, while it is shown
  int ghost_entry = 0;                   // number of the entry that it is of
  std::shared_ptr<const Motion> motion;  // the last whole motion: status, terms, violations, multipliers
  // Of all plots, of `curves` or shortly before: evenly over the time, and finer over the span that is shown.
  std::shared_ptr<const Samples> samples;
  Record record;      // of the run that goes on, or of the last one
  int opened = 1;     // counts scenes; one that is read again from its file is the same
  long revision = 0;  // counts every change of `curves`

  // What goes on.
  bool running = false;   // a solve or iterate
  bool stopping = false;  // it was asked to end
  std::optional<Paused> paused;
  int waiting = 0;  // acts that are not answered yet
  std::optional<Steering> steering;
  std::optional<Pose> pose;
  std::optional<Pose> copied;
  Daemon symbolic, optimizer;
  std::vector<Notice> notices;
  std::vector<ConsoleLine> console;
  std::vector<std::string> recent;                          // files, newest first
  std::vector<LeftBehind> left;                             // sessions that ended without being saved
  std::optional<std::pair<std::string, std::string>> film;  // that is being made: its file, and how far it is
  double clock = 0;                                         // s since the start; moved by events alone

  // How it is looked at.
  Playback playback;
  double pace = 0;                       // iterations a second that runs are held to; 0: none
  std::vector<double> pins;              // s, rising: ghosts of the figure at these times
  std::pair<double, double> span{0, 0};  // s, of the time that curves are shown of; as long as it is empty, all of it
  Selection selection;
  bool dark = true;
  std::map<std::string, std::string> drafts;  // texts that are being edited in place, by equation or "new constraint"

  // What is under way (work.h); no business of views.
  Work work;
};

constexpr double same_time = 1e-6;  // s: pins and keys so near are one

// The text is not what the file holds.
bool unsaved(const State& state);
bool is_typing(const State& state);  // a line in place
// Something goes on, waits or is half typed, of which the text does not know yet.
bool under_way(const State& state);
// Leaving the scene now would lose something.
bool would_lose(const State& state);
bool can_undo(const State& state);
bool can_redo(const State& state);
// The run can be paused: not one of many starts, of which nothing is left before its end.
bool can_pause(const State& state);
// A run was paused, and it can go on from where the session is.
bool can_continue(const State& state);
// Index of the entry whose motion the ghost is, where it can be gone back to.
std::optional<int> entry_of_ghost(const State& state);
// The scene text of the present entry, or the one with mistakes.
std::string text_of(const State& state);
// What a file would hold: the text, and behind it what the script still has to do.
std::string text_to_save(const State& state);

}  // namespace spacetime::gui
