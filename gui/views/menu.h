// The menu bar, the tool bar, the status line and the keyboard.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_menu(Ui& ui);
void draw_toolbar(Ui& ui);
void draw_status(Ui& ui);

// Shortcuts; not while a text is being typed.
void take_keys(Ui& ui);

// What fills the window with `ui.view`'s new camera.
void turn(Ui& ui, View view);

}  // namespace spacetime::gui
