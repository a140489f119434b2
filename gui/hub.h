// The session without a window: it owns the state, talks to the daemons and to the disk, and never waits.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gui/disk.h"
#include "gui/effect.h"
#include "gui/event.h"
#include "gui/filming.h"
#include "gui/state.h"
#include "protocol/client.h"

namespace spacetime::gui {

struct HubOptions {
  protocol::Target symbolic, optimizer;
  std::string folder;          // of journals and settings; empty: nothing is kept
  std::function<void()> wake;  // called from other threads when there is something to take
};

// `spacetime-NAME serve`, of the folder this program is in, or else of the PATH.
protocol::Target daemon_beside(const std::string& name);

class Hub {
 public:
  explicit Hub(HubOptions options);
  ~Hub();  // as after a crash: an unfinished session stays in its journal
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  void post(Event event);  // from any thread
  // Takes what has arrived, and lets `seconds` pass.  True where more than the clock may have changed.  Returns at
  // once.
  bool step(double seconds);
  const State& state() const { return state_; }
  // The window closes: what is being saved is waited for, some seconds at most, and the journal goes, unless something
  // is unsaved or under way and not to be thrown away.
  void close(bool discard = false);

  // Everything so far stands in the journal: from here on a crash loses nothing of it.
  bool written() const { return disk_->idle(); }

  int symbolic_process() const { return symbolic_->process(); }  // 0 where there is none
  int optimizer_process() const { return optimizer_->process(); }

 private:
  void apply(const Event& event);
  void perform(const Request& request);
  void perform(const Cancel& cancel);

  const std::function<void()> wake_;
  State state_;
  std::map<int, int> runs_;  // clients' ids of the last requests that iterate

  std::mutex mutex_;  // of the queue
  std::vector<Event> queue_;

  // Last, so that they end first: their threads fill the queue.
  std::unique_ptr<Filming> filming_;
  std::unique_ptr<Disk> disk_;
  std::unique_ptr<protocol::Client> symbolic_, optimizer_;
};

}  // namespace spacetime::gui
