// The tool bar and the status line.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_toolbar(Ui& ui);
void draw_status(Ui& ui);

}  // namespace spacetime::gui
