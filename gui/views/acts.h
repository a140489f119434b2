// What menus, buttons and keys do alike.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

// Into its file, or asks for a name.
void save(Ui& ui);

// What the file still asks for, or after that what the panel says.
void run(Ui& ui);
bool can_run(const Ui& ui);

// Whether a ghost stands at the time shown.
bool is_pinned(const State& s);

// Those along the motion; where nothing changes in the picture it is said why.
void show_ghosts(Ui& ui, bool on);

// Fills the window from there.
void turn(Ui& ui, View view);

}  // namespace spacetime::gui
