#include "gui/views/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/bspline.h"
#include "gui/views/freedoms.h"
#include "gui/views/plot_frame.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

struct Curve {
  std::string name;
  ImVec4 colour;
  std::vector<double> times, values;
  int derivative = 0;
  bool dotted = false;
  bool points = false;  // only at these times, nothing between them
};

constexpr int samples_drawn = 400;

void add_dof(const Ui& ui, const Trajectory& dof, bool ghost, std::vector<Curve>& out) {
  const double start = std::max(ui.memory.span.from, dof.basis.knots.front());
  const double end = std::min(ui.memory.span.to, dof.basis.knots.back());
  for (int d = 0; d <= max_derivative; ++d) {
    if (!ui.memory.curves.derivative[d]) continue;
    Curve curve{dof.name, colour_of(ui, dof.name), {}, {}, d, ghost, false};
    if (ghost) curve.colour.w = 0.45F;
    std::vector<double> coefficients = dof.coefficients;
    const CurvesMemory& m = ui.memory.curves;
    if (!ghost && m.dragged == dof.name && m.dragged_index >= 0)
      coefficients[static_cast<std::size_t>(m.dragged_index)] = m.dragged_value;
    for (int k = 0; k <= samples_drawn; ++k) {
      const double t = start + (end - start) * k / samples_drawn;
      curve.times.push_back(t);
      curve.values.push_back(value(dof.basis, coefficients, t, d));
    }
    out.push_back(std::move(curve));
  }
}

// Differences of samples: what has been sampled is all that is known of an expression here.
std::vector<double> slopes(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> out(values.size());
  const std::size_t last = values.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = i == last ? last : i + 1;
    out[i] = (values[b] - values[a]) / (times[b] - times[a]);
  }
  return out;
}

void add_expression(const Ui& ui, const std::string& name, std::vector<Curve>& out) {
  const auto& samples = ui.state.samples;
  if (!samples) return;
  const auto found = samples->values.find(name);
  if (found == samples->values.end() || samples->times.size() < 3) return;
  const std::size_t components = found->second.empty() ? 0 : found->second.front().size();
  for (std::size_t c = 0; c < components; ++c) {
    Curve curve{name, colour_of(ui, name), samples->times, {}, 0, c > 0, false};
    if (components > 1) curve.name += fmt::format("[{}]", c + 1);
    for (const auto& row : found->second) curve.values.push_back(row[c]);
    for (int d = 0; d <= max_derivative; ++d) {
      if (d > 0) curve.values = slopes(curve.times, curve.values);
      curve.derivative = d;
      if (ui.memory.curves.derivative[d]) out.push_back(curve);
    }
  }
}

std::vector<Curve> curves_of(const Ui& ui) {
  const State& s = ui.state;
  std::vector<Curve> out;
  if (ui.memory.curves.show == CurvesMemory::Show::residuals) {
    for (std::size_t e = 0; e < ui.residuals().size(); ++e) {
      const Equation& equation = ui.question().equations[e];
      if (!s.selection.constraint.empty() && s.selection.constraint != equation.name) continue;
      Curve curve{equation.name, ui.colours().curves[out.size() % 8], {}, {}, 0, false, true};
      for (const Residual& r : ui.residuals()[e]) {
        curve.times.push_back(r.time);
        curve.values.push_back(r.value);
      }
      if (!curve.times.empty()) out.push_back(std::move(curve));
    }
    return out;
  }
  if (!s.curves) return out;
  for (const Trajectory& dof : s.curves->dofs) {
    if (!is_among(s.selection.dofs, dof.name)) continue;
    add_dof(ui, dof, false, out);
    if (!s.ghost) continue;
    const auto before = std::ranges::find(s.ghost->dofs, dof.name, &Trajectory::name);
    if (before != s.ghost->dofs.end()) add_dof(ui, *before, true, out);
  }
  for (const std::string& name : s.selection.expressions) add_expression(ui, name, out);
  return out;
}

void fit(PlotFrame& frame, const std::vector<Curve>& curves) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves) {
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const double v = curve.values[i];
      if (!std::isfinite(v) || curve.times[i] < frame.left || curve.times[i] > frame.right) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(low <= high)) low = -1, high = 1;
  const double room = std::max(1e-9, 0.08 * (high - low));
  frame.bottom = low - room;
  frame.top = high + room;
  if (high - low < 1e-9) frame.bottom = low - 1, frame.top = high + 1;
}

void draw(ImDrawList& list, const PlotFrame& frame, const Curve& curve, float scale) {
  const float width = scale * (curve.derivative == 0 ? 2.0F : 1.2F);
  if (curve.points) {
    for (std::size_t i = 0; i < curve.times.size(); ++i)
      list.AddCircleFilled({frame.x(curve.times[i]), frame.y(curve.values[i])}, 2.5F * scale, packed(curve.colour));
    return;
  }
  std::vector<ImVec2> points;
  const auto stroke = [&] {
    if (curve.dotted) {
      for (std::size_t i = 0; i + 1 < points.size(); i += 6)
        list.AddPolyline(&points[i], static_cast<int>(std::min<std::size_t>(4, points.size() - i)),
                         packed(curve.colour), 0, width);
    } else if (!points.empty()) {
      list.AddPolyline(points.data(), static_cast<int>(points.size()), packed(curve.colour), 0, width);
    }
    points.clear();
  };
  for (std::size_t i = 0; i < curve.times.size(); ++i) {
    if (std::isfinite(curve.values[i]))
      points.push_back({frame.x(curve.times[i]), frame.y(curve.values[i])});
    else
      stroke();
  }
  stroke();
}

Steering moving(const std::string& dof, int index, double value) {
  const Words words = control_words(dof, index, value);
  return {.line = words.line, .actions = {words.action}, .solves = false};
}

// A control point is taken hold of, moved, let go.
void drag_control(Ui& ui, const PlotFrame& frame) {
  CurvesMemory& m = ui.memory.curves;
  const ImGuiIO& io = ImGui::GetIO();
  const bool moved = io.MouseDragMaxDistanceSqr[0] > 4;
  const bool dropped = ui.memory.drag_dropped;
  if (!dropped && moved && ImGui::IsMouseDown(0) && io.MouseDelta.y != 0) {
    m.dragged_value = frame.value_at(io.MousePos.y);
    ui.emit(Steer{moving(m.dragged, m.dragged_index, m.dragged_value)});
  }
  if (ImGui::IsMouseDown(0) && !dropped) return;
  if (moved && !dropped) ui.emit(Steered{true});
  if (m.held) m.low = m.high = 0;
  m.held = false;
  m.dragged.clear();
  m.dragged_index = -1;
}

void take_control(Ui& ui, const PlotFrame& frame, const Trajectory& dof, std::size_t i) {
  CurvesMemory& m = ui.memory.curves;
  m.dragged = dof.name;
  m.dragged_index = static_cast<int>(i);
  m.dragged_value = dof.coefficients[i];
  m.held = m.high <= m.low;
  m.low = frame.bottom;
  m.high = frame.top;
}

// Whether the window leaves the optimiser, and the hand, this coefficient: its whole support has to be inside.
bool is_free(const Question& question, const Trajectory& dof, std::size_t i) {
  const auto freedom = std::ranges::find(question.dofs, dof.name, &Freedom::name);
  if (freedom != question.dofs.end() && !freedom->in_window) return false;
  if (!question.window) return true;
  const auto& knots = dof.basis.knots;
  return knots[i] >= question.window->first && knots[i + 4] <= question.window->second;
}

// Knots as ticks, and control points as handles.
void draw_controls(Ui& ui, ImDrawList& list, const PlotFrame& frame) {
  CurvesMemory& m = ui.memory.curves;
  const bool hovered = ImGui::IsItemHovered();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (const Trajectory& dof : ui.state.curves->dofs) {
    if (!is_among(ui.state.selection.dofs, dof.name)) continue;
    const ImU32 colour = packed(colour_of(ui, dof.name), 0.8F);
    if (m.knots) {
      const float y = frame.corner.y + frame.size.y;
      for (const double t : breakpoints(dof.basis)) list.AddLine({frame.x(t), y - 5}, {frame.x(t), y}, colour);
    }
    if (!m.controls || !m.derivative[0]) continue;
    const auto times = greville(dof.basis);
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!frame.shows(times[i])) continue;
      const bool mine = m.dragged == dof.name && m.dragged_index == static_cast<int>(i);
      const bool free = is_free(ui.question(), dof, i);
      const ImVec2 at{frame.x(times[i]), frame.y(mine ? m.dragged_value : dof.coefficients[i])};
      const float away = std::hypot(mouse.x - at.x, mouse.y - at.y);
      const bool hot = mine || (hovered && m.dragged.empty() && away < 7 * ui.memory.scale);
      const float r = (hot && free ? 5.0F : 3.0F) * ui.memory.scale;
      list.AddCircleFilled(at, r, packed(hot && free ? ui.colours().text : ui.colours().panel), 12);
      list.AddCircle(at, r, free ? colour : packed(ui.colours().line), 12, 1.5F);
      ui.memory.places[fmt::format("control {} {}", dof.name, i)] = {at.x - 3, at.y - 3, 6, 6};
      if (!hot || !m.dragged.empty()) continue;
      ui.help(fmt::format("{} [{}] = {}\n{}", dof.name, i, shown(dof.coefficients[i]),
                          free ? "Drag to move this control point: the figure follows. Solving moves it again."
                               : "The window leaves this control point where it is.")
                  .c_str());
      if (free && ImGui::IsMouseClicked(0)) take_control(ui, frame, dof, i);
    }
  }
  if (!m.dragged.empty()) drag_control(ui, frame);
}

void fit(Ui& ui) {
  ui.memory.curves.low = ui.memory.curves.high = 0;
  fit_time(ui);
}

void draw_tools(Ui& ui) {
  CurvesMemory& m = ui.memory.curves;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.scaled(5), ui.scaled(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {ui.scaled(3), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(2), 0});
  if (ImGui::RadioButton("curves", m.show == CurvesMemory::Show::curves)) m.show = CurvesMemory::Show::curves;
  ui.control("show curves", "Degrees of freedom and expressions over time.");
  if (ImGui::RadioButton("residuals", m.show == CurvesMemory::Show::residuals)) m.show = CurvesMemory::Show::residuals;
  ui.control(
      "residuals",
      "By how much each constraint is off, at each of its instances. Select one in the equations to see it alone.");
  if (m.show == CurvesMemory::Show::curves) {
    ImGui::Checkbox("q", &m.derivative[0]);
    ui.control("values", "The curves themselves.");
    ImGui::SameLine();
    ImGui::Checkbox("q'", &m.derivative[1]);
    ui.control("first derivative", "Their velocities.");
    ImGui::SameLine();
    ImGui::Checkbox("q''", &m.derivative[2]);
    ui.control("second derivative", "Their accelerations.");
    ImGui::Checkbox("controls", &m.controls);
    ui.control("controls", "Coefficients, which can be dragged.");
  }
  if (ImGui::SmallButton("Fit")) fit(ui);
  ui.control("fit",
             "Shows all of the selected curves at all times. The mouse wheel zooms in values, with Shift in time, and "
             "dragging "
             "with the right button moves.");
  ImGui::PopStyleVar(3);
}

// In values; move_time moves in time.
void zoom(Ui& ui, const PlotFrame& frame) {
  CurvesMemory& m = ui.memory.curves;
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseWheel != 0 && !io.KeyShift) {
    const double by = std::pow(0.85, io.MouseWheel), at = frame.value_at(io.MousePos.y);
    m.low = at + (frame.bottom - at) * by;
    m.high = at + (frame.top - at) * by;
  }
  if (ImGui::IsMouseDragging(1, 1) && io.MouseDelta.y != 0) {
    const double by = io.MouseDelta.y / frame.size.y * (frame.top - frame.bottom);
    m.low = frame.bottom + by;
    m.high = frame.top + by;
  }
  if (ImGui::IsMouseDoubleClicked(0)) fit(ui);
}

}  // namespace

void draw_curves(Ui& ui, const TimeAxis& axis) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float below = ImGui::GetFontSize() + 6, height = ImGui::GetContentRegionAvail().y;
  if (height < ui.scaled(60)) return;
  ImGui::BeginChild("curve tools", {ui.scaled(122), height});
  draw_tools(ui);
  ImGui::EndChild();
  ImGui::SetCursorScreenPos({axis.left, at.y + 4});
  ImGui::InvisibleButton("curves", {axis.right - axis.left, height - below - 6});
  ui.here("curves");
  const auto curves = curves_of(ui);
  const State& s = ui.state;
  PlotFrame frame{{axis.left, at.y + 4}, {axis.right - axis.left, height - below - 6}, axis.from, axis.to, 0, 1};
  fit(frame, curves);
  CurvesMemory& m = ui.memory.curves;
  if (m.high > m.low) frame.bottom = m.low, frame.top = m.high;
  if (ImGui::IsItemHovered()) zoom(ui, frame);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_scales(list, frame, ui.colours());
  list.PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  for (const Curve& curve : curves) draw(list, frame, curve, ui.memory.scale);
  if (s.curves && m.show == CurvesMemory::Show::curves) draw_controls(ui, list, frame);
  list.PopClipRect();
  float x = frame.corner.x + 8;
  std::string named;
  for (const Curve& curve : curves) {
    if (curve.name == named) continue;
    named = curve.name;
    list.AddText({x, frame.corner.y + 3}, packed(curve.colour), named.c_str());
    x += ImGui::CalcTextSize(named.c_str()).x + 12;
  }
  if (curves.empty())
    list.AddText({x, frame.corner.y + 6}, packed(ui.colours().faint),
                 m.show == CurvesMemory::Show::curves ? "Select degrees of freedom or expressions to see their curves."
                                                      : "No constraint has instances in time.");
}

}  // namespace spacetime::gui
