// The scale of time, with what stands on it: pinned ghosts, and keys that can be moved.
#pragma once

#include "gui/views/time_axis.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_ruler(Ui& ui, const TimeAxis& axis);

// Shows this time, standing still.
void move_to(Ui& ui, double time);

// Dragged times snap to hundredths of a second, unless Alt is held.
double snapped(double t);

}  // namespace spacetime::gui
