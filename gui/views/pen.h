// Lines in dashes and points in shapes: what is told apart where colours repeat.
#pragma once

#include <imgui.h>

#include <span>

namespace spacetime::gui {

// Of a line: whole, long dashes, dots, both by turns.  Of a point: disc, ring, square, diamond.
inline constexpr int styles = 4;
inline constexpr int faded = styles;  // short dashes, of a line that was

// Through all points, in pixels; `scale` as of the screen.
void draw_line(ImDrawList& list, std::span<const ImVec2> points, int style, ImU32 colour, float width, float scale);

void draw_point(ImDrawList& list, const ImVec2& at, int style, ImU32 colour, float radius);

}  // namespace spacetime::gui
