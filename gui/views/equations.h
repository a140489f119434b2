// The table of constraints and objective terms, with their edits.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_equations(Ui& ui);

}  // namespace spacetime::gui
