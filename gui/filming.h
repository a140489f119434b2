// Pictures and films of a motion, made by this program's `render` in a process of its own while the window goes on.
#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "gui/effect.h"
#include "gui/event.h"

namespace spacetime::gui {

class Filming {
 public:
  // `post` is called in another thread.
  explicit Filming(std::function<void(Event)> post) : post_(std::move(post)) {}
  ~Filming();  // what is being made is given up, and waited for
  Filming(const Filming&) = delete;
  Filming& operator=(const Filming&) = delete;

  // Both return at once.
  void perform(const MakeFilm& effect);  // ends what is being made
  void stop();

 private:
  // One that is being made, or was.
  struct Making {
    std::mutex mutex;
    bool stopped = false;  // nothing is told of it any more
    int process = 0;       // 0: not yet, or it has been waited for
    std::atomic<bool> over = false;
    std::thread thread;
  };
  // `beside`: what the names of files for the maker begin with.
  void make(Making& making, const MakeFilm& effect, const std::string& beside);
  void tell(Making& making, Filmed event);

  const std::function<void(Event)> post_;
  std::list<Making> makings_;
  int made_ = 0;
};

}  // namespace spacetime::gui
