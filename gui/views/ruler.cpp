#include "gui/views/ruler.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gui/views/plot_frame.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr auto place = Notice::Place::timeline;

void draw_scale(Ui& ui, const TimeAxis& axis, float top, float height) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const double step = round_step(axis.to - axis.from, (axis.right - axis.left) / ui.scaled(70));
  for (auto k = static_cast<long>(std::ceil(axis.from / step * 5 - 1e-6));
       axis.shows(static_cast<double>(k) * step / 5); ++k) {
    const double t = static_cast<double>(k) * step / 5;
    const bool named = k % 5 == 0;
    const float x = axis.x(t);
    list.AddLine({x, top + (named ? 12.0F : 17.0F) * ui.memory.scale}, {x, top + height}, packed(ui.colours().line));
    if (!named) continue;
    const std::string text = fmt::format("{:g}", std::round(t * 1e6) / 1e6);
    list.AddText({x - ImGui::CalcTextSize(text.c_str()).x / 2, top - 3}, packed(ui.colours().faint), text.c_str());
  }
}

// A pale figure of a head and shoulders.
void draw_pins(Ui& ui, const TimeAxis& axis, float y) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float r = ui.scaled(4);
  for (const double pin : ui.state.pins) {
    if (!axis.shows(pin)) continue;
    const float x = axis.x(pin);
    const std::string name = fmt::format("pin {:g}", pin);
    ImGui::SetCursorScreenPos({x - 1.5F * r, y - 1.5F * r});
    if (ImGui::InvisibleButton(name.c_str(), {3 * r, 3 * r})) ui.emit(Pin{pin, false});
    ui.control(name, fmt::format("The pose at {} s is shown, pale. Click to take the ghost away.", shown(pin)));
    const ImU32 colour = packed(ImGui::IsItemHovered() ? ui.colours().text : ui.colours().faint);
    list.AddCircleFilled({x, y - r * 0.6F}, r * 0.7F, colour);
    list.AddRectFilled({x - r, y + r * 0.2F}, {x + r, y + r * 1.2F}, colour, r * 0.7F, ImDrawFlags_RoundCornersTop);
  }
}

std::string told(const KeyMark& mark) {
  std::string text = fmt::format("{} at {} s", mark.sketched ? "The sketch" : "A key", shown(mark.time));
  for (const auto& [dof, value] : mark.held) text += fmt::format("\n{} = {}", dof, shown(value));
  text += "\n\nA starting guess: Run may move the motion away from it. Only constraints are kept.";
  if (mark.sketched) return text + "\n\nIt belongs to the scene's text. Click to go to its time.";
  if (mark.added.empty())
    return text +
           "\n\nThe motion was shaped anew since, and keeps of this key what suits it. Drag it: the motion is pulled "
           "through this pose at the other time, and solved again.";
  return text + "\n\nDrag it to another time: the motion follows. Right button to take it away.";
}

void draw_key_menu(Ui& ui, const KeyMark& mark, const Motion& motion, const std::string& name) {
  if (!ImGui::BeginPopupContextItem(("menu " + name).c_str(), ImGuiPopupFlags_MouseButtonRight)) return;
  const auto back = without(mark, motion);
  if (ImGui::MenuItem("Take it away", nullptr, false, !back.empty())) ui.act(key_words(mark.time, back).line, place);
  ui.control("take key away",
             back.empty() ? "The motion was shaped anew since: nothing of it can be taken away. Undo leads before it."
                          : "The motion goes back to where it would be without this key.");
  ImGui::EndPopup();
}

void take_drag(Ui& ui, const TimeAxis& axis, const KeyMark& mark, const Motion& motion, int index) {
  KeyMemory& m = ui.memory.key;
  if (ImGui::IsItemActivated()) m = {index, mark.time, false};
  if (m.dragged != index) return;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 2) && !mark.sketched && !ui.memory.drag_dropped) {
    const double time = axis.time(ImGui::GetIO().MousePos.x);
    const double to = std::clamp(snapped(time), ui.memory.span.start, ui.memory.span.end);
    if (to != m.time || !m.moved) {
      m.time = to;
      m.moved = true;
      ui.emit(Steer{moved(mark, motion, to)});
    }
  }
  if (!ImGui::IsItemDeactivated()) return;
  if (!m.moved)
    move_to(ui, mark.time);
  else if (!ui.memory.drag_dropped)
    ui.emit(Steered{m.time != mark.time});
  m.dragged = -1;
}

void draw_keys(Ui& ui, const TimeAxis& axis, float y) {
  const auto& marks = ui.question().keys;
  const State& s = ui.state;
  if (s.present < 0 || s.log.empty()) return;
  const auto& motion = s.log[static_cast<std::size_t>(s.present)].motion;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const KeyMark& mark = marks[i];
    const bool dragged = ui.memory.key.dragged == static_cast<int>(i) && !ui.memory.drag_dropped;
    if (!axis.shows(mark.time) && !dragged) continue;
    const float x = axis.x(dragged ? ui.memory.key.time : mark.time), r = ui.scaled(4);
    const std::string name = fmt::format("{} {:g}", mark.sketched ? "sketch" : "key", mark.time);
    ImGui::PushID(static_cast<int>(i));
    ImGui::SetCursorScreenPos({axis.x(mark.time) - 1.5F * r, y - 1.5F * r});
    ImGui::InvisibleButton(name.c_str(), {3 * r, 3 * r});
    ui.control(name, told(mark));
    const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
    if (hot && !mark.sketched) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (motion) take_drag(ui, axis, mark, *motion, static_cast<int>(i));
    if (motion && !mark.sketched) draw_key_menu(ui, mark, *motion, name);
    ImGui::PopID();
    const ImU32 colour = packed(hot ? ui.colours().text : ui.colours().curves[1]);
    if (mark.added.empty() && !mark.sketched)
      list.AddQuad({x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}, colour, ui.scaled(1.5F));
    else
      list.AddQuadFilled({x - r, y}, {x, y - r}, {x + r, y}, {x, y + r}, colour);
  }
}

}  // namespace

void move_to(Ui& ui, double time) {
  Playback playback = ui.state.playback;
  playback.time = time;
  playback.playing = false;
  ui.emit(SetPlayback{playback});
}

double snapped(double t) { return ImGui::GetIO().KeyAlt ? t : std::round(t * 100) / 100; }

void draw_ruler(Ui& ui, const TimeAxis& axis) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ui.scaled(30);
  draw_scale(ui, axis, at.y, height);
  // Marks are met by the mouse before the ruler behind them.
  draw_keys(ui, axis, at.y + height - ui.scaled(5));
  draw_pins(ui, axis, at.y + ui.scaled(16));
  ImGui::SetCursorScreenPos({axis.left - 6, at.y});
  ImGui::InvisibleButton("ruler", {axis.right - axis.left + 12, height});
  ui.control("ruler", "Click or drag to move through time. The wheel zooms, dragging with the right button moves.");
  if (ImGui::IsItemActive()) move_to(ui, axis.time(ImGui::GetIO().MousePos.x));
  ImGui::SetCursorScreenPos({at.x, at.y + height});
}

}  // namespace spacetime::gui
