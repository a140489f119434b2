// Draws a picture with OpenGL 3.3.
#pragma once

#include <memory>

#include "gui/render/camera.h"
#include "gui/render/picture.h"

namespace spacetime::gui {

enum class Quality {
  fast,  // hard shadows: for a window on a machine without a graphics card
  fine,  // soft ones
};

// Needs a current OpenGL 3.3 context as long as it lives.
class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Fills the bound framebuffer (which has a depth buffer) from its lower left corner, width x height pixels.  Leaves
  // the framebuffer bound, and no other state that it promises.
  void draw(const Picture& picture, const Camera& camera, int width, int height, Quality quality = Quality::fine);

 private:
  struct Resources;
  std::unique_ptr<Resources> resources_;
};

}  // namespace spacetime::gui
