// Curves over time: degrees of freedom with their derivatives, knots and control points, expressions, residuals.
#pragma once

#include "gui/views/time_axis.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

// In line with the timeline, whose axis it is.
void draw_curves(Ui& ui, const TimeAxis& axis);

}  // namespace spacetime::gui
