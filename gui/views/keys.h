// ImGui's keys, as GLFW numbers them: the views ask for those numbers, with a window or without.
#pragma once

#include <imgui.h>

namespace spacetime::gui {

void map_keys(ImGuiIO& io);

}  // namespace spacetime::gui
