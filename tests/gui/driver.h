// The whole window driven from a program: a hub with real daemons, a screen without a display, and input by the names
// of controls.
#pragma once

#include <functional>
#include <string>

#include "gui/hub.h"
#include "gui/screen.h"

namespace spacetime::test {

class Driver {
 public:
  explicit Driver(gui::HubOptions options, int width = 1280, int height = 800, float scale = 1);

  void frame(int count = 1);  // each a sixtieth of a second, whatever the clock says
  // Frames until the condition holds; throws, which ends the test, after twenty seconds without.
  void until(const std::function<bool(const gui::State&)>& holds, const std::string& what);
  void settle();                               // until nothing is under way
  void open(const std::string& text);          // a scene, until all of it is there
  void open_example(const std::string& name);  // likewise

  bool has(const std::string& name);
  gui::Rect place(const std::string& name);  // of a control; a test failure where it is not there
  void click(const std::string& name, int button = 0);
  // From the middle of a control by so many pixels, in `steps` frames, with button 0 (left) or 1 (right); `let_go`
  // false keeps the button down.
  void drag(const std::string& name, float dx, float dy, int steps = 8, bool let_go = true, int button = 0);
  void let_go(int button = 0);
  void wheel(const std::string& name, float by, bool shift = false);
  void key(int glfw_key, bool control = false, bool shift = false);
  void type(const std::string& text);
  void write_into(const std::string& name, const std::string& text);  // a text field; Enter at the end
  void save_picture(const std::string& file);                         // into $SPACETIME_SCREENSHOTS, where that is set

  gui::Hub& hub() { return hub_; }
  gui::Screen& screen() { return screen_; }
  const gui::State& state() const { return hub_.state(); }

 private:
  gui::Hub hub_;
  gui::Screen screen_;
};

}  // namespace spacetime::test
