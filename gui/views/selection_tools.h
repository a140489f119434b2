// What is done to the degrees of freedom that are selected, in one place: smoothing and shaking them.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

// Two buttons in a row, each of which opens what it needs to know.
void draw_selection_tools(Ui& ui);

// A click on the name of a degree of freedom selects it alone; with Ctrl it joins those selected, or leaves them.
void select_dof(Ui& ui, const std::string& name);

}  // namespace spacetime::gui
