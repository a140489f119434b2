// The table of degrees of freedom: in the window or not, bounds, damping, and which are shown as curves.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_freedoms(Ui& ui);

// `window [a, b] of x, y`, or `window all`.
std::string window_line(const std::optional<std::pair<double, double>>& interval, const std::vector<std::string>& dofs);

// " of x, y", or nothing where the list is empty.
std::string of_names(const std::vector<std::string>& dofs);

// In which colour a degree of freedom or an expression is drawn, everywhere.
ImVec4 colour_of(const Ui& ui, const std::string& name);

}  // namespace spacetime::gui
