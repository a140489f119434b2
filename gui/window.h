// The program's window.
#pragma once

#include <string>

#include "gui/hub.h"

namespace spacetime::gui {

// Shows the session until it is closed; the program's exit code.  Throws InputError where no window or no OpenGL is to
// be had, with what to do about it.
int run_window(Hub& hub, float scale);

}  // namespace spacetime::gui
