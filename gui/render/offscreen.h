// OpenGL without a window or a screen.
#pragma once

namespace spacetime::gui {

// Makes an OpenGL 3.3 context current to this thread for as long as it lives: through EGL, on a graphics card or on the
// processor.  Throws InputError, which says what to install, where there is none.
class Offscreen {
 public:
  Offscreen();
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace spacetime::gui
