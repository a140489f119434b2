// What is written: the scene's text with its mistakes, the log, and the console.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_text(Ui& ui);
void draw_log(Ui& ui);
void draw_console(Ui& ui);

}  // namespace spacetime::gui
