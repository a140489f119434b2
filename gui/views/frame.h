// One frame of the views: the same in a window and in an image without one.
#pragma once

#include <vector>

#include "gui/views/scene_view.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

// Between the input's NewFrame and `paint`: all views, in the state's theme; what the person did.
std::vector<Event> draw_frame(const State& state, Memory& memory, SceneView& scene);

// Into the bound framebuffer, width x height pixels.
void paint(const Memory& memory, int width, int height);

}  // namespace spacetime::gui
