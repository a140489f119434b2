// The ground that curves are drawn on: a rectangle with a scale on both sides.
#pragma once

#include <imgui.h>

#include "gui/views/legend.h"
#include "gui/views/theme.h"

namespace spacetime::gui {

struct PlotFrame {
  ImVec2 corner, size;  // of the drawing area, pixels
  double left, right;   // what its sides stand for
  double bottom, top;

  float x(double value) const { return corner.x + static_cast<float>((value - left) / (right - left)) * size.x; }
  float y(double value) const { return corner.y + static_cast<float>((top - value) / (top - bottom)) * size.y; }
  bool shows(double value) const { return value >= left && value <= right; }
  double value_at(float pixel) const { return top - (pixel - corner.y) / size.y * (top - bottom); }
};

// A step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`.
double round_step(double span, double parts);

// Lines and numbers of both scales.  The numbers of the vertical one stand left of the area, of the other one below it.
// `counted`: the horizontal one has whole numbers alone.
void draw_scales(ImDrawList& list, const PlotFrame& frame, const Colours& colours, bool powers_of_ten = false,
                 bool counted = false);

}  // namespace spacetime::gui
