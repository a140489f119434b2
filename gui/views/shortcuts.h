// The keyboard.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

// Not while a text is being typed or a dialog is open.
void take_keys(Ui& ui);

}  // namespace spacetime::gui
