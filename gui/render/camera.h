// The camera as a value: it looks at a target from a distance and turns about it.  Pixels count from the left and the
// top of a picture.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "gui/render/picture.h"

namespace spacetime::gui {

struct Camera {
  glm::vec3 target{0, 0, 0};
  float distance = 5;         // m, from target to eye
  float yaw = 0;              // radians about y; 0 looks along -z
  float pitch = 0;            // radians; positive looks down
  float fov = 0.6F;           // radians, vertical
  bool orthographic = false;  // then the height seen is that at the target's distance
  bool operator==(const Camera&) const = default;
};

enum class View {
  front,  // along -z at the x-y plane, in which many scenes move
  side,   // along -x
  top,    // down
  free,   // from the front, the right and above
};

// As text: "X,Y,Z,YAW,PITCH,DISTANCE", metres and degrees, with ",orthographic" where it is.  `read_camera` throws
// InputError for what is none, or not in front of anything.
std::string camera_text(const Camera& camera);
Camera read_camera(const std::string& text);

Camera looking(View view, Camera camera = {});  // turned so, everything else as it was

// Turned about the target; pitch stays within a quarter turn.
Camera orbit(Camera camera, float yaw, float pitch);

// Moved so that what is at the target's depth follows the mouse by `pixels`.
Camera pan(Camera camera, const glm::vec2& pixels, const glm::vec2& size);

// Closer by `factor` (2: half the distance); what is at the target's depth under the pixel stays there.
Camera zoom(Camera camera, float factor, const glm::vec2& pixel, const glm::vec2& size);

// Moved so that the box fills the picture but for a margin (share of the picture on each side).
Camera frame(Camera camera, const Box& box, const glm::vec2& size, float margin = 0.08F);

glm::vec3 eye(const Camera& camera);
glm::mat4 view_matrix(const Camera& camera);
glm::mat4 projection_matrix(const Camera& camera, const glm::vec2& size);

// Where a point is seen; nothing where it is behind the eye.
std::optional<glm::vec2> project(const Camera& camera, const glm::vec2& size, const glm::vec3& point);

// From the eye (or the picture's plane) through a pixel, of unit direction.
Ray ray_through(const Camera& camera, const glm::vec2& size, const glm::vec2& pixel);

}  // namespace spacetime::gui
