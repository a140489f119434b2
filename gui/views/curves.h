// Curves over time: degrees of freedom with their derivatives, knots and control points, expressions, residuals.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

// `left` and `right` are where the timeline's time axis begins and ends, in pixels, so that both stand in line.
void draw_curves(Ui& ui, float left, float right);

}  // namespace spacetime::gui
