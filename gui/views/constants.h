// The constants of the scene as numbers that can be dragged.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_constants(Ui& ui);

// What is written and sent when a constant is dragged to a value.
Steering setting(const std::vector<std::pair<std::string, double>>& constants);

}  // namespace spacetime::gui
