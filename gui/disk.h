// Everything that touches files, in a thread of its own and in the order it was asked for: nobody waits for a disk.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "gui/effect.h"
#include "gui/event.h"

namespace spacetime::gui {

// $XDG_STATE_HOME/spacetime, or ~/.local/state/spacetime.
std::string state_folder();

// Journals end so.
inline constexpr std::string_view journal_extension = ".journal";

class Disk {
 public:
  // Tells first of the settings, and of sessions that ended without being saved.  `post` is called in the thread.  An
  // empty folder: nothing is kept.
  Disk(std::string folder, std::function<void(Event)> post);
  ~Disk();  // what was asked for is done first; a journal that was not ended stays
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  void perform(Effect effect);                // one about files or journals; returns at once
  bool idle();                                // all that was asked for is done
  bool wait(std::chrono::milliseconds most);  // until it is idle; false where it is not by then

 private:
  void run();
  void begin();
  void look_at_watched();
  void know(const std::string& file);  // as it is now
  void lose_journal();                 // it cannot be written any more
  void act(const ReadFile& effect);
  void act(const WriteFile& effect);
  void act(const WatchFile& effect);
  void act(const JournalBegin& effect);
  void act(const JournalLine& effect);
  void act(const JournalEnd& effect);
  void act(const JournalDrop& effect);
  void act(const KeepSettings& effect);
  void act(const Request&) {}
  void act(const Cancel&) {}
  void act(const MakeFilm&) {}
  void act(const StopFilm&) {}

  const std::string folder_;
  const std::function<void(Event)> post_;
  std::mutex mutex_;  // of the queue
  std::condition_variable arrived_, done_;
  std::deque<Effect> queue_;
  bool ending_ = false, busy_ = false;

  // The thread's own.
  int journal_ = -1;  // locked while it is open
  std::string journal_file_;
  int journals_ = 0;
  std::string watched_;
  using Stamp = std::optional<std::pair<long, long>>;  // when a file was changed: s, ns
  Stamp known_, told_;                                 // of the watched file: as read or written, and as last told of
  std::string read_;                                   // the file that was read last, and
  Stamp read_stamp_;                                   // as it was then
  std::thread thread_;
};

}  // namespace spacetime::gui
