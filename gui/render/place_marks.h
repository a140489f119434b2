// Constants that are places, drawn over a picture as the window shows them: a ring with four ticks, and the name.
#pragma once

#include <string>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"
#include "gui/render/camera.h"
#include "gui/render/image.h"

namespace spacetime::gui {

struct NamedPlace {
  std::string name;
  glm::vec3 at{0};
};

// Where the problem's places are in a motion of it.
std::vector<NamedPlace> places_in(const Problem& problem, const Motion& motion);

// Those in front of the eye.  Throws InputError where the font of the names is missing.
void mark(Image& image, const std::vector<NamedPlace>& places, const Camera& camera, Theme theme);

}  // namespace spacetime::gui
