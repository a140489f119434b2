// Pictures of a motion at a time, or of all of it.
#pragma once

#include <string>
#include <vector>

#include "gui/render/camera.h"
#include "gui/render/figures.h"

namespace spacetime::gui {

struct Look {
  Theme theme = Theme::light;
  std::vector<std::string> trails{};  // of Figures::points
};

// The figure at a time, with its trails so far.
Picture moment(const Figures& figures, const Motion& motion, double time, const Look& look);

// `poses` of the figure, evenly spaced in time and paler the earlier they are, with their whole trails.
Picture strip(const Figures& figures, const Motion& motion, int poses, const Look& look);

// The same poses side by side along x, each where it is in height and depth: for figures that stay in their place,
// whose poses would hide one another.
Picture apart(const Figures& figures, const Motion& motion, int poses, const Look& look);

Box bounds(const Picture& picture);  // of its solids

// From where all of a motion can be seen: the whole time fits.
Camera overview(const Box& bounds, View view, const glm::vec2& size);

}  // namespace spacetime::gui
