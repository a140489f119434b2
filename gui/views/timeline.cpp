#include "gui/views/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/bspline.h"
#include "gui/views/curves.h"
#include "gui/views/freedoms.h"
#include "gui/views/ruler.h"
#include "gui/views/time_axis.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

enum class Icon { first, back, play, pause, forward, last };

// A button with a drawn sign: fonts do not agree on these.
bool draw_icon(Ui& ui, Icon icon, const char* name, const char* help) {
  const bool pressed = ImGui::Button((std::string("##") + name).c_str(), {ui.scaled(32), 0});
  ui.control(name, help);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 c{(low.x + high.x) / 2, (low.y + high.y) / 2};
  const float r = ui.scaled(5), w = ui.scaled(2.5F);
  const ImU32 colour = packed(ui.colours().text);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto triangle = [&](float x, float direction) {
    list.AddTriangleFilled({x - direction * r * 0.8F, c.y - r}, {x - direction * r * 0.8F, c.y + r},
                           {x + direction * r, c.y}, colour);
  };
  const auto bar = [&](float x) { list.AddRectFilled({x - w / 2, c.y - r}, {x + w / 2, c.y + r}, colour); };
  if (icon == Icon::first) triangle(c.x + 1, -1), bar(c.x - r);
  if (icon == Icon::last) triangle(c.x - 1, 1), bar(c.x + r);
  if (icon == Icon::back) triangle(c.x - r / 2, -1), bar(c.x + r);
  if (icon == Icon::forward) triangle(c.x + r / 2, 1), bar(c.x - r);
  if (icon == Icon::play) triangle(c.x, 1);
  if (icon == Icon::pause) bar(c.x - r / 2), bar(c.x + r / 2);
  ImGui::SameLine(0, ui.scaled(4));
  return pressed;
}

void draw_transport(Ui& ui, double start, double end) {
  const Playback& p = ui.state.playback;
  const double frame = 1 / p.rate;
  if (draw_icon(ui, Icon::first, "to start", "To the start (Home)")) move_to(ui, start);
  if (draw_icon(ui, Icon::back, "frame back", "One frame back (Left)")) move_to(ui, std::max(start, p.time - frame));
  if (draw_icon(ui, p.playing ? Icon::pause : Icon::play, "play", "Play or pause (Space)")) ui.emit(Play{!p.playing});
  if (draw_icon(ui, Icon::forward, "frame forward", "One frame forward (Right)"))
    move_to(ui, std::min(end, p.time + frame));
  if (draw_icon(ui, Icon::last, "to end", "To the end (End)")) move_to(ui, end);
  Playback changed = p;
  if (ImGui::Checkbox("Loop", &changed.loop)) ui.emit(SetPlayback{changed});
  ui.control("loop", "Begin again at the end.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ui.scaled(76));
  const char* speeds[] = {"1/8 x", "1/4 x", "1/2 x", "1 x", "2 x"};
  int which = std::clamp(static_cast<int>(std::lround(std::log2(p.speed))) + 3, 0, 4);
  if (ImGui::Combo("##speed", &which, speeds, 5)) {
    changed.speed = std::exp2(which - 3);
    ui.emit(SetPlayback{changed});
  }
  ui.control("speed", "How fast it plays.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ui.scaled(64));
  int rate = static_cast<int>(p.rate);
  if (ImGui::InputInt("frames/s", &rate, 0) && rate >= 1 && rate <= 1000) {
    changed.rate = rate;
    ui.emit(SetPlayback{changed});
  }
  ui.control("rate", "Frames a second: what the arrow keys step by, and a film is made with.");
  ImGui::SameLine(0, ui.scaled(20));
  ImGui::PushFont(ui.memory.fonts.strong);
  ImGui::Text("%.3f s", p.time);
  ImGui::PopFont();
  ui.here("time");
  ui.notices(Notice::Place::timeline);
}

void label_of(const Ui& ui, ImDrawList& list, const TimeAxis& axis, float y, const std::string& text,
              const ImVec4& colour) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float left = axis.left - 8 - std::min(size.x, ui.scaled(156));
  list.PushClipRect({axis.left - ui.scaled(164), y - size.y}, {axis.left - 6, y + size.y}, true);
  list.AddText({left, y - size.y / 2}, packed(colour), text.c_str());
  list.PopClipRect();
}

// A bar from `from` to `to` whose ends can be dragged; the new ends when they are let go.
std::optional<std::pair<double, double>> draw_bar(Ui& ui, const TimeAxis& axis, const std::string& name, double from,
                                                  double to, const ImVec4& colour, bool editable) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ui.scaled(12);
  auto& [dragged, ends] = ui.memory.bar;
  if (dragged == name) {
    from = ends[0];
    to = ends[1];
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float a = axis.x(from), b = std::max(axis.x(to), a + 3);
  const float first = std::max(a, axis.left), last = std::min(b, std::max(axis.right, a + 3));
  if (first < last) list.AddRectFilled({first, at.y + 2}, {last, at.y + height}, packed(colour, 0.55F), 3);
  std::optional<std::pair<double, double>> result;
  if (!editable) return result;
  for (const int end : {0, 1}) {
    if (!axis.shows(end == 0 ? from : to) && dragged != name) continue;
    const float x = end == 0 ? a : b;
    ImGui::SetCursorScreenPos({x - 5, at.y});
    ImGui::PushID(end);
    ImGui::InvisibleButton(name.c_str(), {10, height + 2});
    ImGui::PopID();
    ui.control(name + (end == 0 ? " from" : " to"), "Drag this end; Alt drags between hundredths of a second.");
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    list.AddRectFilled({x - 2, at.y + 1}, {x + 2, at.y + height + 1}, packed(hot ? ui.colours().text : colour), 2);
    if (ImGui::IsItemActivated()) {
      dragged = name;
      ends[0] = from;
      ends[1] = to;
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 1)) {
      ends[end] = snapped(axis.time(ImGui::GetIO().MousePos.x));
      if (end == 0) ends[0] = std::min(ends[0], ends[1]);
      if (end == 1) ends[1] = std::max(ends[0], ends[1]);
    }
    if (ImGui::IsItemDeactivated()) {
      if (dragged == name && ImGui::GetIO().MouseDragMaxDistanceSqr[0] > 1) result = {ends[0], ends[1]};
      dragged.clear();
    }
  }
  return result;
}

void draw_window_row(Ui& ui, const TimeAxis& axis, const Problem& problem) {
  const Question& question = ui.question();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  label_of(ui, *ImGui::GetWindowDrawList(), axis, at.y + ui.scaled(7), "window", ui.colours().text);
  const auto shown_window = question.window.value_or(std::pair{problem.start, problem.end});
  if (const auto ends =
          draw_bar(ui, axis, "window", shown_window.first, shown_window.second, ui.colours().accent, true);
      ends && ends->second > ends->first) {
    std::vector<std::string> names;
    for (const Freedom& dof : question.dofs)
      if (dof.in_window) names.push_back(dof.name);
    ui.act(window_line(question, problem, *ends, names), Notice::Place::timeline);
  }
  ImGui::SetCursorScreenPos({at.x, at.y + ui.scaled(16)});
}

void draw_scopes(Ui& ui, const TimeAxis& axis, const Problem& problem) {
  const Question& question = ui.question();
  static const std::vector<Trajectory> none;
  const std::vector<Trajectory>& dofs = ui.state.curves ? ui.state.curves->dofs : none;
  for (const Equation& equation : question.equations) {
    if (equation.objective || equation.scope.kind == Scope::Kind::once) continue;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float y = at.y + ui.scaled(7);
    const bool selected = ui.state.selection.constraint == equation.name;
    const ImVec4 colour = !equation.enabled ? ui.colours().line
                          : selected        ? ui.colours().accent
                                            : ui.colours().curves[2];
    label_of(ui, list, axis, y, equation.name, selected ? ui.colours().accent : ui.colours().faint);
    const std::vector<double> times = times_of(equation.scope, problem, question.constants, dofs);
    const bool interval = equation.scope.kind == Scope::Kind::every || equation.scope.kind == Scope::Kind::count ||
                          equation.scope.kind == Scope::Kind::knots || equation.scope.kind == Scope::Kind::whole;
    if (interval && !times.empty()) {
      const bool editable = equation.named && equation.scope.kind != Scope::Kind::whole;
      const double from = times.front(), to = times.back();
      if (const auto ends = draw_bar(ui, axis, "scope " + equation.name, from, to, colour, editable);
          ends && ends->second >= ends->first) {
        // Only the end that was moved becomes a number.
        const auto moved = [](double now, double before) { return now == before ? std::nullopt : std::optional(now); };
        const std::string scope =
            scope_text(equation, problem, question.constants, moved(ends->first, from), moved(ends->second, to));
        ui.act(scope_line(equation.name, scope), Notice::Place::timeline);
      }
    }
    for (const double t : times)
      if (axis.shows(t)) list.AddCircleFilled({axis.x(t), y}, ui.scaled(interval ? 1.5F : 4), packed(colour), 10);
    ImGui::SetCursorScreenPos({at.x, at.y + ui.scaled(16)});
  }
}

}  // namespace

void draw_timeline(Ui& ui) {
  const State& s = ui.state;
  const bool there = s.scene && s.scene->problem;
  const double start = there ? s.scene->problem->start : 0, end = there ? s.scene->problem->end : 1;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  draw_transport(ui, start, end);
  if (!there) {
    ImGui::TextDisabled(s.work.opening ? "The scene is being compiled."
                        : s.scene      ? "There is no motion: the scene has mistakes. Mend them in the tab Scene."
                                       : "No scene is open.");
    return;
  }
  const TimeAxis axis = time_axis(ui, start, end, at.x + ui.scaled(166), at.x + width - ui.scaled(18));
  const float top = ImGui::GetCursorScreenPos().y;
  draw_ruler(ui, axis);
  const float below = ImGui::GetCursorScreenPos().y;
  draw_window_row(ui, axis, *s.scene->problem);
  const float rows_top = ImGui::GetCursorScreenPos().y;
  // Scopes take what they need, up to a third of the panel; the rest scrolls.
  const auto rows = std::ranges::count_if(
      ui.question().equations, [](const Equation& e) { return !e.objective && e.scope.kind != Scope::Kind::once; });
  const float most = ImGui::GetContentRegionAvail().y * 0.36F;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::BeginChild("scopes", {0, std::min(most, ui.scaled(16) * static_cast<float>(rows) + 2)});
  draw_scopes(ui, axis, *s.scene->problem);
  ImGui::EndChild();
  ImGui::PopStyleVar();
  draw_cursor(ui, axis, below - ui.scaled(10), ImGui::GetCursorScreenPos().y);
  draw_curves(ui, axis);
  const float bottom = at.y + ImGui::GetWindowHeight();
  move_time(ui, axis, top, rows_top, bottom);
}

}  // namespace spacetime::gui
