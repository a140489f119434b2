// What `update` remembers between events: what was asked and not answered, and what is still to be done.
//
// Daemons are led through one job at a time, a few requests each; a run is no job, so that acts go on beside it.  What
// the optimizer holds is named by the log's entry it stands at; where that is not the present one, it is led there
// before anything else is done.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gui/notice.h"

namespace spacetime {
struct Problem;
}

namespace spacetime::gui {

struct Scene;
struct Statement;
struct Curves;

// An act that waits for its turn, or has it.
struct Task {
  std::string line;
  Notice::Place place = Notice::Place::status;
  std::string about{};
  std::optional<std::string> draft{};  // the text that it was written as, in the draft of the name `about`
  bool scripted = false;               // taken from State::script
  bool merge = false;                  // its entry becomes part of the one before it
  bool iterates = false;               // known once it was compiled: has to wait for the end of a run
};

// What a request was for.
struct Wanted {
  enum class Kind {
    open_whole,   // compile: the file's text
    open_head,    // ... up to its first action
    load,         // of the problem of `entry`, whose motion is not known yet
    base,         // compile: the present entry's text, where its problem is not known to the line
    act_compile,  // ... with the act's
    act_do,       // problem/update and the act's actions
    run,
    checkpoint,  // of `entry`
    look,        // motion/get without one
    go_compile,  // compile: the text of an entry of a restored session
    go,          // problem/load, edits and motion/set
    steer,       // edits of a drag
    steer_run,
    sample,
    console,
  } kind = Kind::look;
  int entry = 0;  // number of an entry, where the kind has one
};

struct Work {
  int last = 0;     // number of the last request
  int entries = 0;  // of the last entry
  std::map<int, Wanted> wanted;

  // Opening.
  std::optional<std::string> opening;  // the text; acts wait until it is open
  std::string head;
  std::vector<std::string> script;
  bool again = false;  // the same file was read once more: it is looked at as before

  // Acting.
  std::deque<Task> tasks;
  struct Job {
    std::optional<Task> task;                 // the one that has its turn
    std::shared_ptr<const Scene> base;        // the present scene when it was its turn, to which it was compiled
    std::vector<Statement> added;             // its statements, with their places in its own text
    std::shared_ptr<const Problem> declared;  // with it, where it changes the problem itself
    std::vector<std::string> asked;           // its actions, as JSON
    std::vector<std::string> prelude;         // lines that iterate, which came before it
    int unanswered = 0;                       // of its requests
    std::string refusal;                      // of one of them
    bool changed = false;                     // one of them has been answered, or changes the problem
  } job;
  bool scripting = false;  // the script goes on when there is nothing else to do
  bool inexact = false;    // the present scene's problem has places of a slightly different text

  // A run.
  int run = 0;             // its request; 0: none
  std::string action;      // as asked, and
  std::string line;        // as written
  bool merge = false;      // its entry becomes part of the one it began from
  int began = 0;           // number of that entry
  bool scripted = false;   // taken from State::script
  bool whole = false;      // of many starts: stopped before its end, it leaves nothing
  bool pausing = false;    // it was stopped to go on with it
  bool unseen = false;     // the person has gone elsewhere meanwhile
  bool discarded = false;  // nothing is to be left of it
  int recorded = 0;        // number of the entry that the run of State::record ended in
  int ghosted = 0;         // ... of the entry that State::ghost is the motion before: a run that begins there leaves it

  // Where the optimizer stands: number of an entry; 0: unknown.
  int at = 0;
  int going = 0;          // where it is being led
  int steps = 0;          // on the way there that are not answered yet
  int failed = 0;         // where it could not be led
  std::string unloaded;   // why it takes no problem yet: the scene is still being written
  bool restored = false;  // the present entry's text is still to be compiled

  // A drag.
  struct Drag {
    std::string line;
    std::vector<std::string> actions;
    bool afresh = false;
    bool solves = true;  // each value is followed by a few iterations, the last by a solve
    bool fresh = true;   // not sent yet
    bool moved = false;  // the round that is under way has iterated
    int unanswered = 0;
    int run = 0;
    bool begun = false;  // anything was sent
  };
  std::optional<Drag> drag;

  int saving = 0;         // number of the last WriteFile that is not answered; 0: none
  std::string overwrite;  // the file that others changed, of which was told: saving again replaces it

  // Samples.
  int sample = 0;                                // the request; 0: none
  long sampled = -1;                             // State::revision of the last asked for, and
  std::pair<double, double> sampled_span{0, 0};  // State::span
  double next_time = 0;                          // State::clock from which the next may be asked for
};

}  // namespace spacetime::gui
