#include "gui/views/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spacetime::gui {
namespace {

std::string label(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  if (std::abs(value) >= 1e5 || step < 1e-4) return fmt::format("{:.3g}", value);
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return fmt::format("{:.{}f}", value, digits);
}

}  // namespace

double round_step(double span, double parts) {
  if (!(span > 0) || !std::isfinite(span)) return 1;
  const double raw = span / parts, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10 * power;
}

void draw_scales(ImDrawList& list, const PlotFrame& f, const Colours& colours, bool powers_of_ten, bool counted) {
  const ImU32 line = packed(colours.line, 0.6F), strong = packed(colours.line), text = packed(colours.faint);
  const float height = ImGui::GetFontSize();
  double across = round_step(f.right - f.left, std::max(2.0F, f.size.x / (6 * height)));
  if (counted) across = std::max(1.0, std::ceil(across));
  for (double v = std::ceil(f.left / across) * across; v <= f.right + 1e-9 * across; v += across) {
    const float x = f.x(v);
    list.AddLine({x, f.corner.y}, {x, f.corner.y + f.size.y}, line);
    const std::string name = label(v, across);
    const float width = ImGui::CalcTextSize(name.c_str()).x;
    list.AddText({x - width / 2, f.corner.y + f.size.y + 3}, text, name.c_str());
  }
  double up = round_step(f.top - f.bottom, std::max(2.0F, f.size.y / (2.4F * height)));
  if (powers_of_ten) up = std::max(1.0, std::ceil(up));
  for (double v = std::ceil(f.bottom / up) * up; v <= f.top + 1e-9 * up; v += up) {
    const float y = f.y(v);
    list.AddLine({f.corner.x, y}, {f.corner.x + f.size.x, y},
                 std::abs(v) < 1e-9 * up && !powers_of_ten ? strong : line);
    const std::string name = powers_of_ten ? fmt::format("1e{}", static_cast<int>(std::lround(v))) : label(v, up);
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    list.AddText({f.corner.x - size.x - 6, y - size.y / 2}, text, name.c_str());
  }
  list.AddRect(f.corner, {f.corner.x + f.size.x, f.corner.y + f.size.y}, strong);
}

}  // namespace spacetime::gui
