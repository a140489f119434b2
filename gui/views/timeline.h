// Playing the motion, the cursor, and what holds when: the window and the scopes of constraints as bars.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_timeline(Ui& ui);

}  // namespace spacetime::gui
