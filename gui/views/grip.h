// The mouse in the scene: what is under it, and what is dragged.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "gui/places.h"
#include "gui/render/figures.h"
#include "gui/render/picture.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

// What is being dragged with the left button.
struct Pull {
  enum class What { nothing, camera, body, place } what = What::nothing;
  int body = -1;        // of the problem
  glm::dvec3 point{0};  // body: where it was taken hold of, in its own axes
  struct Carried {
    int body = -1, by = -1;
    glm::dvec3 place{0};  // of its origin in the axes of the body that holds it
  };
  std::vector<Carried> carried{};
  PlaceHandle place;
  glm::vec3 start{0};  // of the point in the world: the drag stays in the plane through it that faces the camera
};

// The picture is the last item and has these measures, in pixels; `hot` is the place that the mouse is at.  What is
// under the pointer is told beside it before it is pressed.
void take_mouse(Ui& ui, Pull& pull, const Picture& picture, const Figures& figures,
                const std::optional<PlaceHandle>& hot, const ImVec2& corner, const glm::vec2& size);

}  // namespace spacetime::gui
