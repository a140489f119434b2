// The figure in space: seen, turned about, and pulled at.
#pragma once

#include <memory>

#include "gui/views/ui.h"

namespace spacetime::gui {

// Needs a current OpenGL context as long as it lives.
class SceneView {
 public:
  SceneView();
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  void draw(Ui& ui);

 private:
  struct Resources;
  std::unique_ptr<Resources> resources_;
};

}  // namespace spacetime::gui
