// Everything that can happen to the session: what the person does, what the daemons answer, and the clock.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "gui/state.h"

namespace spacetime::gui {

// --- What the person does.

struct Open {  // a scene file, or a session's journal
  std::string file;
  bool discard = false;  // what is not saved of the session that is left is not wanted any more
};
struct OpenText {  // an example or an empty scene: it has no file yet
  std::string text;
  bool discard = false;
};
struct Save {
  std::string file;  // empty: where it was opened from
};
// Any line of the scene language, an action or a declaration: appended to the scene.  `place` and `about` tell where a
// mistake in it is to be shown.  One that was written in a draft brings the draft's text: when it is accepted the draft
// of the name `about` goes, unless more was written in it meanwhile.
struct Act {
  std::string line;
  Notice::Place place = Notice::Place::status;
  std::string about{};
  std::optional<std::string> draft{};
};
struct DropSession {  // one that ended without being saved: it is not wanted any more
  std::string journal;
};
struct RunScript {};  // what the file still has to do; `solve` where there is nothing
struct Stop {};       // ends what iterates; what it reached is kept
struct Pause {};      // likewise, to go on with it
struct Continue {};   // with what was paused, where it stood
struct Undo {};
struct Redo {};
struct GoTo {  // an entry of the log
  int entry = 0;
};
// Dragging: `Steer` as often as the value changes, `Steered` when it is let go, with `keep` false to go back.
struct Steer {
  Steering steering;
};
struct Steered {
  bool keep = true;
};
struct DropGhost {};
struct Ask {  // the console: an expression to print, differentiate `by`, evaluate and count
  std::string text, by{};
};

// Of the present motion, into pictures, a film or (where `strip` is above 0) one picture of many poses.  What is left
// out is as `render` has it, and the rate as the playback's.
struct Film {
  std::string file;
  int strip = 0;
  std::string camera{};                             // as `render --camera` takes it; empty: where all can be seen
  int width = 0, height = 0;                        // pixels
  double rate = 0;                                  // pictures a second
  std::optional<std::pair<double, double>> span{};  // s
};
struct DropFilm {};  // stops making it

// --- How it is looked at.

struct Play {
  bool on = true;
};
struct SetPlayback {
  Playback playback;
};
struct Select {
  Selection selection;
};
struct Pin {  // the pose at a time is shown, pale, whatever the time
  double time = 0;
  bool on = true;
};
struct ShowSpan {  // of time, in which curves are looked at: samples are to be fine there
  double from = 0, to = 0;
};
struct SetPace {  // of the runs that follow, in iterations a second; 0: as fast as they can
  double pace = 0;
};
struct Remark {  // of a view, to be told quietly
  std::string text;
};
struct SetPose {  // absent: none
  std::optional<Pose> pose;
};
struct CopyPose {};
struct PastePose {
  bool mirrored = false;
};
struct KeyPose {};  // keys the pose at the time shown
struct Draft {      // absent text: the draft is dropped
  std::string about;
  std::optional<std::string> text;
};
struct SetTheme {
  bool dark = true;
};
struct Dismiss {  // a notice
  int index = 0;
};
struct Tick {
  double seconds = 0;  // since the last
};

// --- What the daemons say.  `number` is the request's (effect.h); answers to requests nobody waits for any more are
// dropped.

struct DaemonIs {
  bool symbolic = true;  // or the optimizer
  Daemon::Condition condition = Daemon::Condition::starting;
  std::string why;
};
struct Compiled {
  int number = 0;
  std::shared_ptr<const Scene> scene;
};
struct Logged {        // one action of an answer's log
  std::string action;  // as JSON
  std::string line;    // in the language, where it iterates; empty for an edit
};
struct Iterated {  // progress of a run
  int number = 0;
  std::vector<IterationRecord> records;  // more than one where nobody looked meanwhile
  std::vector<Trajectory> changed;       // curves that differ; without knots where those are as before
  std::vector<std::pair<std::string, double>> parameters;
};
struct Done {  // an action was performed
  int number = 0;
  std::vector<Logged> log;
  bool run = false;
  Status status = Status::stopped;
  std::string message;
};
struct Reached {  // the answer to `motion/get`
  int number = 0;
  std::shared_ptr<const Motion> motion;
  std::shared_ptr<const std::string> checkpoint;
  std::vector<Logged> log;  // iterations of the run that goes on, up to the checkpoint
};
struct Sampled {
  int number = 0;
  std::shared_ptr<const Samples> samples;
};
struct Answered {  // the console's
  int number = 0;
  std::string text;
  bool wrong = false;
};
struct Acknowledged {  // whatever has no more to say than that it was done
  int number = 0;
};
struct Refused {  // an error
  int number = 0;
  std::string message;
};
struct Filmed {
  enum class What { progress, done, failed };
  std::string file, text;
  What what = What::progress;
};
struct FileRead {
  std::string file, text;
  bool discard = false;
};
struct FileFailed {
  std::string file, message;
  int number = 0;  // of the WriteFile; 0: of none
};
struct FileWritten {
  std::string file, text;
  int number = 0;
};
struct FileChanged {  // by somebody else
  std::string file;
  bool refused = false;  // it was to be written, and was not for that
  int number = 0;
};

// What was kept on disk: settings at the start, sessions that ended without being saved, and one that is opened again.
struct SettingsRead {
  bool dark = true;
  std::vector<std::string> recent;
};
struct SessionsFound {
  std::vector<LeftBehind> left;
};
struct Restored {  // entries with their texts alone in `scene`
  std::string journal;
  std::string file, saved;
  std::vector<Entry> log;
  int present = 0;
  std::vector<std::string> script;
  std::vector<double> pins{};  // s, rising
  bool discard = false;
};

using Event = std::variant<Open, OpenText, Save, Act, DropSession, RunScript, Stop, Pause, Continue, Undo, Redo, GoTo,
                           Steer, Steered, DropGhost, Ask, Play, SetPlayback, Select, Pin, ShowSpan, SetPace, Remark,
                           SetPose, CopyPose, PastePose, KeyPose, Draft, SetTheme, Dismiss, Tick, DaemonIs, Compiled,
                           Iterated, Done, Reached, Sampled, Answered, Acknowledged, Refused, FileRead, FileFailed,
                           FileWritten, FileChanged, SettingsRead, SessionsFound, Restored, Film, DropFilm, Filmed>;

}  // namespace spacetime::gui
