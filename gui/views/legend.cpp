#include "gui/views/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "gui/render/picture.h"
#include "gui/views/pen.h"

namespace spacetime::gui {
namespace {

// Of a sample with the room behind it; measured by the letters, as everything here.
float sample_width(const Name& name) {
  return name.sample.kind == Sample::Kind::none ? 0 : 1.5F * ImGui::GetFontSize();
}

void draw_mark(ImDrawList& list, const ImVec2& at, Mark::Kind kind, ImU32 colour, float r) {
  if (kind == Mark::Kind::met) {
    list.AddCircleFilled(at, r, colour);
    return;
  }
  list.AddCircle(at, r, colour, 16, 1.5F);
  if (kind != Mark::Kind::violated) return;
  const float c = 0.6F * r;
  list.AddLine({at.x - c, at.y - c}, {at.x + c, at.y + c}, colour, 1.5F);
  list.AddLine({at.x - c, at.y + c}, {at.x + c, at.y - c}, colour, 1.5F);
}

void draw_sample(ImDrawList& list, const Name& name, const ImVec2& corner, float height) {
  const float font = ImGui::GetFontSize(), scale = font / 15, wide = 1.15F * font, y = corner.y + height / 2;
  const ImVec2 left{corner.x, y}, right{corner.x + wide, y}, middle{corner.x + wide / 2, y};
  const ImU32 colour = packed(name.colour, name.sample.opacity);
  switch (name.sample.kind) {
    case Sample::Kind::none:
      break;
    case Sample::Kind::line:
      draw_line(list, std::array{left, right}, name.sample.style, colour, 2 * scale, scale);
      break;
    case Sample::Kind::point:
      draw_point(list, middle, name.sample.style, colour, 3 * scale);
      break;
    case Sample::Kind::mark:
      draw_mark(list, middle, static_cast<Mark::Kind>(name.sample.style), colour, 4 * scale);
      break;
    case Sample::Kind::ghost:
      list.AddRectFilled({left.x, y - 3 * scale}, {right.x, y + 3 * scale}, colour, 3 * scale);
      break;
    case Sample::Kind::arrow:
      list.AddLine(left, {right.x - 4 * scale, y}, colour, 2 * scale);
      list.AddTriangleFilled({right.x - 6 * scale, y - 3.5F * scale}, {right.x - 6 * scale, y + 3.5F * scale}, right,
                             colour);
      break;
  }
}

}  // namespace

int Legend::at(const ImVec2& mouse) const {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [corner, size] = places[i];
    if (mouse.x >= corner.x && mouse.x <= corner.x + size.x && mouse.y >= corner.y && mouse.y <= corner.y + size.y)
      return static_cast<int>(i);
  }
  return -1;
}

Legend arrange(std::span<const Name> names, const ImVec2& corner, float width, int rows, float gap) {
  Legend legend;
  const float line = ImGui::GetFontSize() + 2;
  const float number = ImGui::CalcTextSize(fmt::format("+{}", names.size()).c_str()).x;
  float x = 0;
  int row = 0;
  const auto put = [&](float wide) {
    legend.places.push_back({{corner.x + x, corner.y + static_cast<float>(row) * line}, {wide, line}});
    legend.width = std::max(legend.width, x + wide);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const float wide = sample_width(names[i]) + ImGui::CalcTextSize(names[i].text.c_str()).x;
    // In the last row there has to be room for the number of those behind, too.
    const auto needed = [&] { return row + 1 < rows || i + 1 == names.size() ? wide : wide + gap + number; };
    if (x > 0 && x + needed() > width && row + 1 < rows) x = 0, ++row;
    if (x + needed() > width && (x > 0 || rows > 1 || i > 0)) {
      legend.left_out = names.size() - i;
      put(number);
      break;
    }
    put(wide);
    x += wide + gap;
  }
  legend.height = names.empty() ? 0 : static_cast<float>(row + 1) * line;
  return legend;
}

void draw(ImDrawList& list, const Legend& legend, std::span<const Name> names, const Colours& colours, bool ground) {
  if (ground && !legend.places.empty()) {
    const ImVec2 corner = legend.places.front().corner;
    list.AddRectFilled({corner.x - 5, corner.y - 1}, {corner.x + legend.width + 5, corner.y + legend.height + 1},
                       packed(colours.panel), 4);
  }
  for (std::size_t i = 0; i < legend.places.size(); ++i) {
    const auto& [corner, size] = legend.places[i];
    const bool number = legend.left_out > 0 && i + 1 == legend.places.size();
    const bool sampled = !number && names[i].sample.kind != Sample::Kind::none;
    if (sampled) draw_sample(list, names[i], corner, size.y);
    const ImVec4& colour = number || sampled ? colours.faint : names[i].colour;
    const float right = number ? 0 : sample_width(names[i]);
    list.AddText({corner.x + right, corner.y}, packed(colour),
                 (number ? fmt::format("+{}", legend.left_out) : names[i].text).c_str());
  }
}

}  // namespace spacetime::gui
