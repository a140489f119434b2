// What an update asks for: values that the hub performs.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "common/problem.h"
#include "gui/event.h"

namespace spacetime::gui {

// A request to a daemon; `answer` tells which event its answer becomes.  An error becomes Refused.
struct Request {
  enum class Answer {
    scene,  // Compiled
    done,   // Done
    run,    // Done, and Iterated before it
    reached,
    checkpoint,  // Reached, with one
    sampled,
    answered,
    acknowledged,
  };
  int number = 0;
  bool symbolic = false;  // or the optimizer
  std::string method;
  std::string params;                      // JSON text of the members, without braces
  std::shared_ptr<const Problem> problem;  // one more member, where there is one
  Answer answer = Answer::acknowledged;
  std::string text;  // of the scene that is compiled
};
struct Cancel {  // of the optimizer
  int number = 0;
};
struct ReadFile {
  std::string file;
  bool discard = false;  // as Open has it
};
struct WriteFile {
  std::string file, text;
  bool overwrite = false;  // even what others wrote since it was read
  int number = 0;          // which its answer has as well
};
struct WatchFile {  // tells of changes by somebody else; empty: none
  std::string file;
};
struct JournalBegin {};
struct JournalLine {
  std::string json;
};
struct JournalEnd {
  bool keep = false;  // what was not saved can be brought back
};
struct JournalDrop {  // of a session that ended
  std::string journal;
  bool continued = false;  // only where what it held stands in this session's journal now
};
struct MakeFilm {
  Film film;                                  // its rate is given
  std::shared_ptr<const std::string> motion;  // a document
  std::shared_ptr<const Problem> problem;     // the motion's; null where it is not known
  bool dark = false;
};
struct StopFilm {};
struct KeepSettings {
  bool dark = true;
  std::vector<std::string> recent;
};

using Effect = std::variant<Request, Cancel, ReadFile, WriteFile, WatchFile, JournalBegin, JournalLine, JournalEnd,
                            JournalDrop, KeepSettings, MakeFilm, StopFilm>;
using Effects = std::vector<Effect>;

}  // namespace spacetime::gui
