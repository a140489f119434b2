// A number that the motion follows while it changes: a constant, a weight.
#pragma once

#include <functional>
#include <string>

#include "gui/views/ui.h"

namespace spacetime::gui {

struct SteeredNumber {
  std::string name;  // of the control
  std::string help;  // of what it is
  double value = 0;  // as it is now, which may be held by the mouse
  double least = 0;  // that dragging leads to; no bound where it is not below `most`
  double most = 0;   // likewise
  double speed = 0;  // a pixel's worth
};

// Drags it, or writes it after a click; `as` says what a value means.  Esc goes back to the value before.
void draw_steered(Ui& ui, const SteeredNumber& number, const std::function<Steering(double)>& as);

}  // namespace spacetime::gui
