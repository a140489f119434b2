// The program's window.
#pragma once

#include <string>

#include "gui/hub.h"

namespace spacetime::gui {

// To be called from any thread when there is something to show.
void wake_window();

// Shows the session until it is closed; the program's exit code.  `scale`: how many times larger everything is drawn
// than on a screen of 100 dots an inch; the screen's own where 0.  `welcome`: begins with the examples.  Throws
// InputError where no window or no OpenGL is to be had, with what to do about it.
int run_window(Hub& hub, float scale, bool welcome);

}  // namespace spacetime::gui
