#include "gui/views/pen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace spacetime::gui {
namespace {

constexpr std::array<std::array<float, 4>, styles + 1> dashes{{
    // pixels at scale 1: drawn, left out, drawn, left out
    {},
    {9, 4, 9, 4},
    {2, 4, 2, 4},
    {9, 4, 2, 4},
    {4, 5, 4, 5},
}};
constexpr float longest = 1e4F;  // pixels, of a segment in dashes

}  // namespace

void draw_line(ImDrawList& list, std::span<const ImVec2> points, int style, ImU32 colour, float width, float scale) {
  if (points.size() < 2) return;
  if (style == 0) {
    list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, width);
    return;
  }
  const ImVec2 low = list.GetClipRectMin(), high = list.GetClipRectMax();
  const auto& pattern = dashes[static_cast<std::size_t>(style)];
  std::size_t part = 0;
  float left = pattern[0] * scale;  // of this part
  std::vector<ImVec2> dash{points.front()};
  const auto stroke = [&] {
    if (part % 2 == 0 && dash.size() > 1)
      list.AddPolyline(dash.data(), static_cast<int>(dash.size()), colour, 0, width);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ImVec2 from = points[i - 1], to = points[i];
    const float length = std::hypot(to.x - from.x, to.y - from.y);
    // What is not seen is not walked dash by dash.
    const bool seen = std::max(from.x, to.x) >= low.x && std::min(from.x, to.x) <= high.x &&
                      std::max(from.y, to.y) >= low.y && std::min(from.y, to.y) <= high.y;
    if (!seen || !(length < longest)) {
      stroke();
      dash.assign(1, to);
      continue;
    }
    float done = 0;
    for (; length - done > left; left = pattern[part] * scale) {
      done += left;
      const float share = done / length;
      dash.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
      stroke();
      dash.assign(1, dash.back());
      part = (part + 1) % pattern.size();
    }
    left -= length - done;
    dash.push_back(to);
  }
  stroke();
}

void draw_point(ImDrawList& list, const ImVec2& at, int style, ImU32 colour, float r) {
  if (style == 0) list.AddCircleFilled(at, r, colour);
  if (style == 1) list.AddCircle(at, r, colour, 12, 1.5F);
  if (style == 2) list.AddRect({at.x - r, at.y - r}, {at.x + r, at.y + r}, colour, 0, 0, 1.5F);
  if (style == 3) list.AddQuad({at.x - r, at.y}, {at.x, at.y - r}, {at.x + r, at.y}, {at.x, at.y + r}, colour, 1.5F);
}

}  // namespace spacetime::gui
