// The names of what is drawn, each with a sample of it.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <vector>

#include "gui/views/theme.h"

namespace spacetime::gui {

struct Sample {
  enum class Kind {
    none,
    line,   // pen.h's styles
    point,  // likewise
    mark,   // of a constraint: Mark::Kind (picture.h)
    ghost,  // a pale limb
    arrow,
  } kind = Kind::none;
  int style = 0;
  float opacity = 1;
};

struct Name {
  std::string text;
  ImVec4 colour;  // of the sample; of the text where there is none
  Sample sample{};
};

// Names in rows, as many as find room in the width and so many rows; of the rest how many they are.
struct Legend {
  struct Place {
    ImVec2 corner, size;
  };
  std::vector<Place> places;  // of the first names; where some found none, the last place is that of their number
  std::size_t left_out = 0;
  float width = 0, height = 0;
  int at(const ImVec2& mouse) const;  // the place that the mouse is over; -1: none
};
Legend arrange(std::span<const Name> names, const ImVec2& corner, float width, int rows, float gap);
// `ground`: behind the names, so that what runs there does not spoil them.
void draw(ImDrawList& list, const Legend& legend, std::span<const Name> names, const Colours& colours, bool ground);

}  // namespace spacetime::gui
