// The ground that curves are drawn on: a rectangle with a scale on both sides, and the names of what is drawn.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

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
void draw_scales(ImDrawList& list, const PlotFrame& frame, const Colours& colours, bool powers_of_ten = false);

struct Name {
  std::string text;
  ImVec4 colour;
};

// Names in rows, as many as find room in the width and so many rows; of the rest how many they are.
struct Legend {
  struct Place {
    ImVec2 corner, size;
  };
  std::vector<Place> places;  // of the first names; where some found none, the last place is that of their number
  std::size_t left_out = 0;
  float height = 0;
  int at(const ImVec2& mouse) const;  // the place that the mouse is over; -1: none
};
Legend arrange(std::span<const Name> names, const ImVec2& corner, float width, int rows, float gap);
// `ground`: behind the names, so that curves do not spoil them.
void draw(ImDrawList& list, const Legend& legend, std::span<const Name> names, const Colours& colours, bool ground);

}  // namespace spacetime::gui
