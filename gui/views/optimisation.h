// The panel from which the optimiser is run and watched.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_optimisation(Ui& ui);

// `solve` or `iterate n` with what is chosen in the panel.
std::string solve_line(const Memory& memory);

}  // namespace spacetime::gui
