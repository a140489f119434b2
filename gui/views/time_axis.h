// The span of time that is shown: the ruler, the bars below it and the curves stand in line because all of them draw
// with one axis.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

struct TimeAxis {
  double from = 0, to = 1;    // s, shown
  float left = 0, right = 1;  // pixels, where these stand

  float x(double t) const { return left + static_cast<float>((t - from) / (to - from)) * (right - left); }
  double time(float pixel) const;      // within what is shown
  double seconds(float pixels) const;  // that so many pixels stand for
  bool shows(double t) const;          // within half a pixel
};

// Between these pixels, of a scene that lasts from `start` to `end`: the span that was chosen, or all of it.  While it
// plays the span turns to the page that the time is on.
TimeAxis time_axis(Ui& ui, double start, double end, float left, float right);

// The mouse over what is drawn with the axis, from `top` down to `bottom`: the wheel zooms above `scale_bottom` and
// with Shift everywhere, dragging with the right button moves.
void move_time(Ui& ui, const TimeAxis& axis, float top, float scale_bottom, float bottom);

// Where in time the figure is shown, as a line from `top` down to `bottom`.
void draw_cursor(Ui& ui, const TimeAxis& axis, float top, float bottom);

// All of the time.
void fit_time(Ui& ui);

}  // namespace spacetime::gui
