// A window that is not there: the views drawn into an image, with input from a program.  It is how tests drive the
// window, frame by frame, on machines without a display.
#pragma once

#include <string>
#include <vector>

#include "gui/render/image.h"
#include "gui/render/offscreen.h"
#include "gui/render/target.h"
#include "gui/views/frame.h"
#include "gui/views/input.h"

namespace spacetime::gui {

class Screen {
 public:
  // Pixels; `scale` as of a screen with so many times the usual dots.
  Screen(int width, int height, float scale = 1);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  // Input for the next frames.
  void move(float x, float y);
  void button(int which, bool down);
  void wheel(float by);
  void key(int glfw_key, bool down);
  void type(const std::string& text);

  // Draws one frame that lasts `seconds`; what the person did in it.
  std::vector<Event> frame(const State& state, double seconds = 1.0 / 60);

  Memory& memory() { return memory_; }
  Image image() { return target_.read(); }
  void finish();  // waits until all is drawn, which OpenGL does in its own time

 private:
  Offscreen offscreen_;
  Target target_;
  Memory memory_;
  Input input_;
  ImVec2 mouse_{-1, -1};
  std::unique_ptr<SceneView> scene_;
};

}  // namespace spacetime::gui
