// A framebuffer of our own: to draw into, then to show as a texture or to read as an image.
#pragma once

#include "gui/render/image.h"

namespace spacetime::gui {

// Needs a current OpenGL context as long as it lives.
class Target {
 public:
  // `samples` a pixel, as many of them as the machine has.  Throws InputError for a size it has not.
  Target(int width, int height, int samples);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }
  void bind() const;   // what is drawn goes here
  unsigned texture();  // what was drawn; its first row is the lowest
  Image read();        // what was drawn

 private:
  void resolve();

  int width_, height_;
  unsigned drawn_ = 0, colour_ = 0, depth_ = 0;  // multisampled
  unsigned resolved_ = 0, texture_ = 0;
};

}  // namespace spacetime::gui
