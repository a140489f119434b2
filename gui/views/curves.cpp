#include "gui/views/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/bspline.h"
#include "gui/views/curve_values.h"
#include "gui/views/freedoms.h"
#include "gui/views/pen.h"
#include "gui/views/plot_frame.h"
#include "gui/views/selection_tools.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr int legend_rows = 2;

// So that all is seen at the times shown, below `head` pixels for the names.
void fit(PlotFrame& frame, const std::vector<Plotted>& curves, float head) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Plotted& curve : curves) {
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
  const double share = head / std::max(2 * head, frame.size.y);
  frame.top += share / (1 - share) * (frame.top - frame.bottom);
}

constexpr std::size_t few = 3;  // points: so lonely that they are drawn larger, with their values

void draw_points(Ui& ui, ImDrawList& list, const PlotFrame& frame, const Plotted& curve) {
  const bool lonely = curve.times.size() <= few;
  const float radius = ui.scaled(lonely ? 4 : 2.5F);
  for (std::size_t i = 0; i < curve.times.size(); ++i) {
    if (!std::isfinite(curve.values[i])) continue;
    const ImVec2 at{frame.x(curve.times[i]), frame.y(curve.values[i])};
    draw_point(list, at, curve.style, packed(curve.colour), radius);
  }
}

void draw(Ui& ui, ImDrawList& list, const PlotFrame& frame, const Plotted& curve) {
  if (curve.points) return draw_points(ui, list, frame, curve);
  const float width = ui.scaled(curve.derivative == 0 ? 2.0F : 1.2F);
  // What is beside the plot is left out but for the neighbours of what is in it.
  const auto& times = curve.times;
  const auto first = std::ranges::lower_bound(times, frame.left) - times.begin();
  const auto last = std::ranges::upper_bound(times, frame.right) - times.begin();
  const auto begin = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - 1));
  const auto end = std::min(times.size(), static_cast<std::size_t>(last) + 1);
  std::vector<ImVec2> points;
  const auto stroke = [&] {
    draw_line(list, points, curve.style, packed(curve.colour), width, ui.memory.scale);
    points.clear();
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (std::isfinite(curve.values[i]))
      points.push_back({frame.x(times[i]), frame.y(curve.values[i])});
    else
      stroke();
  }
  stroke();
}

// Where there are so few points in all that their values find room.
void draw_values(Ui& ui, ImDrawList& list, const PlotFrame& frame, const std::vector<Plotted>& curves) {
  std::size_t count = 0;
  for (const Plotted& curve : curves) count += curve.times.size();
  if (count > few) return;
  for (const Plotted& curve : curves) {
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
      const std::string text = shown(curve.values[i]) + " at " + shown(curve.times[i]) + " s";
      const ImVec2 size = ImGui::CalcTextSize(text.c_str());
      const float x = frame.x(curve.times[i]), right = frame.corner.x + frame.size.x, gap = ui.scaled(9);
      const float left = x + gap + size.x < right ? x + gap : x - gap - size.x;
      list.AddText({left, frame.y(curve.values[i]) - size.y / 2}, packed(ui.colours().faint), text.c_str());
    }
  }
}

// A point of a curve near the mouse.
struct Near {
  const Plotted* curve = nullptr;
  double time = 0, value = 0;
};

std::optional<Near> nearest(const PlotFrame& frame, const std::vector<Plotted>& curves, const ImVec2& mouse,
                            float reach) {
  std::optional<Near> best;
  for (const Plotted& curve : curves) {
    const auto seen = [&](std::size_t i) { return ImVec2{frame.x(curve.times[i]), frame.y(curve.values[i])}; };
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
      const std::size_t next = curve.points || i + 1 == curve.times.size() ? i : i + 1;
      const ImVec2 a = seen(i), b = seen(next);
      if (b.x < mouse.x - reach || a.x > mouse.x + reach) continue;
      const float dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
      const float along =
          square > 0 ? std::clamp(((mouse.x - a.x) * dx + (mouse.y - a.y) * dy) / square, 0.0F, 1.0F) : 0.0F;
      const float away = std::hypot(a.x + along * dx - mouse.x, a.y + along * dy - mouse.y);
      if (!(away < reach)) continue;
      reach = away;
      best = Near{&curve, std::lerp(curve.times[i], curve.times[next], static_cast<double>(along)),
                  std::lerp(curve.values[i], curve.values[next], static_cast<double>(along))};
    }
  }
  return best;
}

// Which curve it is, when, and how much, beside the point.
void draw_reading(Ui& ui, ImDrawList& list, const PlotFrame& frame, const Near& near) {
  CurvesMemory& m = ui.memory.curves;
  m.reading = fmt::format("{}  {:.4g} s  {}", near.curve->whole, near.time, shown(near.value));
  const ImVec2 at{frame.x(near.time), frame.y(near.value)}, size = ImGui::CalcTextSize(m.reading.c_str());
  const float gap = ui.scaled(10), right = frame.corner.x + frame.size.x, bottom = frame.corner.y + frame.size.y;
  const float x = at.x + gap + size.x + 6 < right ? at.x + gap : at.x - gap - size.x;
  const float y = std::clamp(at.y - gap - size.y, frame.corner.y + 4, bottom - size.y - 4);
  list.AddCircleFilled(at, ui.scaled(3.5F), packed(near.curve->colour));
  list.AddRectFilled({x - 5, y - 2}, {x + size.x + 5, y + size.y + 2}, packed(ui.colours().raised, 0.95F), 4);
  list.AddText({x, y}, packed(ui.colours().text), m.reading.c_str());
}

Steering moving(const std::string& dof, int index, double value) {
  const Words words = control_words(dof, index, value);
  return {.line = words.line, .actions = {words.action}, .solves = false};
}

void leave_control(CurvesMemory& m) {
  if (m.held) m.low = m.high = 0;
  m.held = false;
  m.dragged.clear();
  m.dragged_index = -1;
}

// A curve that was undone, refined or left meanwhile has other control points, or none.
void keep_control(Ui& ui) {
  CurvesMemory& m = ui.memory.curves;
  if (m.dragged.empty()) return;
  const auto same = [&](const Trajectory& dof) {
    return dof.name == m.dragged && dof.coefficients.size() == m.dragged_of;
  };
  if (!ui.state.curves || std::ranges::none_of(ui.state.curves->dofs, same)) leave_control(m);
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
  leave_control(m);
}

void take_control(Ui& ui, const PlotFrame& frame, const Trajectory& dof, std::size_t i) {
  CurvesMemory& m = ui.memory.curves;
  m.dragged = dof.name;
  m.dragged_index = static_cast<int>(i);
  m.dragged_of = dof.coefficients.size();
  m.dragged_value = dof.coefficients[i];
  m.held = m.high <= m.low;
  m.low = frame.bottom;
  m.high = frame.top;
}

// Whether the window leaves the optimiser, and the hand, anything of this curve.
bool is_in_window(const Question& question, const Trajectory& dof) {
  const auto freedom = std::ranges::find(question.dofs, dof.name, &Freedom::name);
  return freedom == question.dofs.end() || freedom->in_window;
}

// ... this coefficient of it: its whole support has to be inside.
bool is_free(const Question& question, const Trajectory& dof, std::size_t i) {
  if (!question.window) return true;
  const auto& knots = dof.basis.knots;
  return knots[i] >= question.window->first && knots[i + 4] <= question.window->second;
}

// Knots and handles that lie closer to the last that was drawn are left out: zooming in shows them.
constexpr float apart = 4;  // pixels at scale 1

// Knots as ticks, and control points as handles; whether the mouse is at one.
bool draw_controls(Ui& ui, ImDrawList& list, const PlotFrame& frame, bool hovered) {
  CurvesMemory& m = ui.memory.curves;
  bool at_one = false;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (const Trajectory& dof : ui.state.curves->dofs) {
    if (!is_among(ui.state.selection.dofs, dof.name)) continue;
    const ImU32 colour = packed(colour_of(ui, dof.name), 0.8F);
    if (m.knots) {
      const float y = frame.corner.y + frame.size.y;
      float last = -std::numeric_limits<float>::infinity();
      for (const double t : breakpoints(dof.basis)) {
        const float x = frame.x(t);
        if (x - last < ui.scaled(apart)) continue;
        list.AddLine({x, y - 5}, {x, y}, colour);
        last = x;
      }
    }
    if (!m.controls || !m.derivative[0]) continue;
    const auto times = greville(dof.basis);
    const bool in_window = is_in_window(ui.question(), dof);
    const float far = std::numeric_limits<float>::infinity();
    ImVec2 last{-far, -far};
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (!frame.shows(times[i])) continue;
      const bool mine = m.dragged == dof.name && m.dragged_index == static_cast<int>(i);
      const ImVec2 at{frame.x(times[i]), frame.y(mine ? m.dragged_value : dof.coefficients[i])};
      if (!mine && std::hypot(at.x - last.x, at.y - last.y) < ui.scaled(apart)) continue;
      last = at;
      const bool free = in_window && is_free(ui.question(), dof, i);
      const float away = std::hypot(mouse.x - at.x, mouse.y - at.y);
      const bool hot = mine || (hovered && m.dragged.empty() && away < 7 * ui.memory.scale);
      const float r = (hot && free ? 5.0F : 3.0F) * ui.memory.scale;
      list.AddCircleFilled(at, r, packed(hot && free ? ui.colours().text : ui.colours().panel), 12);
      list.AddCircle(at, r, free ? colour : packed(ui.colours().line), 12, 1.5F);
      ui.memory.places[fmt::format("control {} {}", dof.name, i)] = {at.x - 3, at.y - 3, 6, 6};
      at_one |= hot;
      if (!hot || !m.dragged.empty()) continue;
      ui.help(fmt::format("{} [{}] = {}\n{}", dof.name, i, shown(dof.coefficients[i]),
                          free ? "Drag to move this control point: the figure follows. Solving moves it again."
                               : "The window leaves this control point where it is.")
                  .c_str());
      if (free && ImGui::IsMouseClicked(0)) take_control(ui, frame, dof, i);
    }
  }
  if (!m.dragged.empty()) drag_control(ui, frame);
  return at_one;
}

void fit(Ui& ui) {
  ui.memory.curves.low = ui.memory.curves.high = 0;
  fit_time(ui);
}

void draw_fit(Ui& ui) {
  if (ImGui::SmallButton("Fit")) fit(ui);
  ui.control("fit",
             "Shows all of the selected curves at all times. The mouse wheel zooms in values, with Shift in time, and "
             "dragging "
             "with the right button moves.");
}

void draw_tools(Ui& ui) {
  CurvesMemory& m = ui.memory.curves;
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.scaled(5), ui.scaled(2)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {ui.scaled(3), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(2), 0});
  using Show = CurvesMemory::Show;
  const auto choice = [&](const char* name, Show show, const char* help) {
    if (ImGui::RadioButton(name, m.show == show)) {
      m.show = show;
      m.low = m.high = 0;  // other units
    }
    ui.control(std::string("show ") + name, help);
  };
  choice("curves", Show::curves, "Degrees of freedom and expressions, with their derivatives.");
  choice("residuals", Show::residuals,
         "By how much each constraint is off, at each of its instances. Select one in the equations to see it alone.");
  choice("multipliers", Show::multipliers,
         "What each instance of each constraint costs: the objective falls by so much for each unit by which the "
         "relation's right side is raised. Of the last whole motion. Select one in the equations to see it alone.");
  if (m.show == CurvesMemory::Show::curves) {
    const auto toggle = [&](const char* label, bool& on, const char* name, const char* help) {
      ImGui::Checkbox(label, &on);
      ui.control(name, help);
    };
    toggle("q", m.derivative[0], "value", "The values themselves.");
    ImGui::SameLine();
    toggle("q'", m.derivative[1], "first derivative", "Velocities.");
    ImGui::SameLine();
    toggle("q''", m.derivative[2], "second derivative", "Accelerations.");
    toggle("controls", m.controls, "controls", "Control points of degrees of freedom, to be dragged.");
    ImGui::SameLine();
    draw_fit(ui);
    draw_selection_tools(ui);
  } else {
    draw_fit(ui);
  }
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

// The names of curves in the upper rows of the plot.
struct Names {
  std::vector<Name> all;
  std::vector<const Plotted*> of;
  Legend legend;
};

Names names_of(Ui& ui, const PlotFrame& frame, const std::vector<Plotted>& curves) {
  Names names;
  for (const Plotted& curve : curves) {
    if (curve.before || std::ranges::find(names.all, curve.name, &Name::text) != names.all.end()) continue;
    names.all.push_back(
        {curve.name, curve.colour, {curve.points ? Sample::Kind::point : Sample::Kind::line, curve.style}});
    names.of.push_back(&curve);
  }
  const auto before = std::ranges::find(curves, true, &Plotted::before);
  if (before != curves.end()) {
    names.all.push_back({"before", ui.colours().faint, {Sample::Kind::line, before->style}});
    names.of.push_back(nullptr);
  }
  const ImVec2 corner{frame.corner.x + 8, frame.corner.y + 3};
  names.legend = arrange(names.all, corner, frame.size.x - 16, legend_rows, ui.scaled(14));
  for (std::size_t i = 0; i < names.legend.places.size(); ++i) {
    const auto& [low, size] = names.legend.places[i];
    const bool number = names.legend.left_out > 0 && i + 1 == names.legend.places.size();
    ui.memory.places[number ? "legend more" : "legend " + names.all[i].text] = {low.x, low.y, size.x, size.y};
  }
  return names;
}

// A click selects what is named there; whether the mouse is over a name.
bool take_names(Ui& ui, const Names& names) {
  const int at = ui.memory.curves.dragged.empty() ? names.legend.at(ImGui::GetIO().MousePos) : -1;
  if (at < 0) return false;
  const auto index = static_cast<std::size_t>(at);
  if (names.legend.left_out > 0 && index + 1 == names.legend.places.size()) {
    std::string rest;
    for (std::size_t i = index; i < names.all.size(); ++i) rest += (rest.empty() ? "" : "\n") + names.all[i].text;
    ui.help(rest.c_str());
    return true;
  }
  if (!names.of[index]) {
    ui.help("Pale and dashed: before the last edit or run, as the ghost. Keep puts it away.");
    return true;
  }
  const Plotted& curve = *names.of[index];
  const bool constraint = ui.memory.curves.show != CurvesMemory::Show::curves;
  const bool dof = !constraint && is_among(ui.state.selection.dofs, curve.of);
  if (dof) ui.help("Click to select it alone; Ctrl+click to leave it out.");
  if (constraint) ui.help("Click to see this constraint alone, and again to see all.");
  if (!ImGui::IsMouseClicked(0)) return true;
  if (dof) select_dof(ui, curve.of);
  if (constraint) {
    Selection selection = ui.state.selection;
    selection.constraint = selection.constraint == curve.of ? "" : curve.of;
    ui.emit(Select{selection});
  }
  return true;
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
  keep_control(ui);
  const auto curves = curves_shown(ui);
  const State& s = ui.state;
  PlotFrame frame{{axis.left, at.y + 4}, {axis.right - axis.left, height - below - 6}, axis.from, axis.to, 0, 1};
  const Names names = names_of(ui, frame, curves);
  fit(frame, curves, names.legend.height);
  CurvesMemory& m = ui.memory.curves;
  if (m.high > m.low) frame.bottom = m.low, frame.top = m.high;
  const bool hovered = ImGui::IsItemHovered();
  if (hovered) zoom(ui, frame);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_scales(list, frame, ui.colours());
  list.PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  for (const Plotted& curve : curves) draw(ui, list, frame, curve);
  draw_values(ui, list, frame, curves);
  list.PopClipRect();
  draw_cursor(ui, axis, at.y, at.y + height);
  list.PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  const bool over_names = hovered && take_names(ui, names);
  bool busy = over_names;
  if (s.curves && m.show == CurvesMemory::Show::curves) busy |= draw_controls(ui, list, frame, hovered && !over_names);
  draw(list, names.legend, names.all, ui.colours(), true);
  m.reading.clear();
  if (hovered && !busy) {
    if (const auto near = nearest(frame, curves, ImGui::GetIO().MousePos, ui.scaled(9)))
      draw_reading(ui, list, frame, *near);
  }
  m.lacking = what_lacks(ui);
  const float low = curves.empty() ? 6 : frame.size.y - ImGui::GetFontSize() - 4;
  list.AddText({frame.corner.x + 8, frame.corner.y + low}, packed(ui.colours().faint), m.lacking.c_str());
  list.PopClipRect();
}

}  // namespace spacetime::gui
