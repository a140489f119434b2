#include "gui/views/time_axis.h"

#include <algorithm>
#include <cmath>

namespace spacetime::gui {
namespace {

constexpr double least_share = 1e-3;  // of the scene's time that can be shown
constexpr double zoom_of_a_notch = 0.85;

// Moved back into the scene's time.
void show(SpanMemory& m, double from, double to) {
  const double span = std::clamp(to - from, least_share * (m.end - m.start), m.end - m.start);
  m.from = std::clamp(from, m.start, m.end - span);
  m.to = m.from + span;
}

}  // namespace

double TimeAxis::time(float pixel) const { return std::clamp(from + seconds(pixel - left), from, to); }

double TimeAxis::seconds(float pixels) const { return pixels / (right - left) * (to - from); }

bool TimeAxis::shows(double t) const {
  const double half = seconds(0.5F);
  return t >= from - half && t <= to + half;
}

TimeAxis time_axis(Ui& ui, double start, double end, float left, float right) {
  SpanMemory& m = ui.memory.span;
  if (m.start != start || m.end != end) m = {start, end, start, end};
  const Playback& p = ui.state.playback;
  const bool away = p.time < m.from || p.time > m.to;
  if (p.playing && away && !ImGui::IsMouseDown(1)) show(m, p.time, p.time + (m.to - m.from));
  // Samples are made fine there.
  if (ui.state.span != std::pair{m.from, m.to}) ui.emit(ShowSpan{m.from, m.to});
  return {m.from, m.to, left, right};
}

void move_time(Ui& ui, const TimeAxis& axis, float top, float scale_bottom, float bottom) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto inside = [&](const ImVec2& at) {
    return at.x >= axis.left && at.x <= axis.right && at.y >= top && at.y <= bottom;
  };
  if (!inside(io.MousePos) || !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows)) return;
  SpanMemory& m = ui.memory.span;
  if (io.MouseWheel != 0 && (io.KeyShift || io.MousePos.y < scale_bottom)) {
    const double by = std::pow(zoom_of_a_notch, io.MouseWheel), at = axis.time(io.MousePos.x);
    const double span = std::clamp(by * (axis.to - axis.from), least_share * (m.end - m.start), m.end - m.start);
    const double from = at - (at - axis.from) / (axis.to - axis.from) * span;
    show(m, from, from + span);
  }
  if (ImGui::IsMouseDragging(1, 1) && inside(io.MouseClickedPos[1])) {
    const double by = axis.seconds(io.MouseDelta.x);
    show(m, axis.from - by, axis.to - by);
  }
}

void draw_cursor(Ui& ui, const TimeAxis& axis, float top, float bottom) {
  const double time = ui.state.playback.time;
  if (!axis.shows(time)) return;
  const float x = axis.x(time);
  ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom}, packed(ui.colours().bad, 0.9F), 1.5F);
}

void fit_time(Ui& ui) {
  SpanMemory& m = ui.memory.span;
  m.from = m.start;
  m.to = m.end;
}

}  // namespace spacetime::gui
