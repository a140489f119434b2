// Where each view is in the window.
#pragma once

#include "gui/views/scene_view.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

// All of one frame, between ImGui's NewFrame and Render.
void draw_window(Ui& ui, SceneView& scene);

}  // namespace spacetime::gui
