// The menu bar.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_menu(Ui& ui);

}  // namespace spacetime::gui
