// The table of degrees of freedom: in the window or not, bounds, damping, and which are shown as curves.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_freedoms(Ui& ui);

// The window with these ends and degrees of freedom, as the language says it most shortly.
std::string window_line(const Question& question, const Problem& problem, std::pair<double, double> interval,
                        std::vector<std::string> dofs);

// In which colour a degree of freedom or an expression is drawn, everywhere.
ImVec4 colour_of(const Ui& ui, const std::string& name);

}  // namespace spacetime::gui
