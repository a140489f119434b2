// Pictures and films of a motion, made by this program's `render` in a process of its own while the window goes on.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "gui/effect.h"
#include "gui/event.h"

namespace spacetime::gui {

class Filming {
 public:
  // `post` is called in another thread.
  explicit Filming(std::function<void(Event)> post) : post_(std::move(post)) {}
  ~Filming();  // what is being made is given up
  Filming(const Filming&) = delete;
  Filming& operator=(const Filming&) = delete;

  void perform(const MakeFilm& effect);  // ends what is being made
  void stop();

 private:
  void watch(int output, int process, const std::string& motion_file, const std::string& file);

  const std::function<void(Event)> post_;
  std::atomic<int> process_ = 0;  // 0: none, or it has been waited for
  std::thread thread_;
};

}  // namespace spacetime::gui
