#include "gui/views/ui.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace spacetime::gui {
namespace {

constexpr double help_delay = 0.6;  // s

// Below what it is of, or above where there is no room: never over it.  Beside a menu, whose next entries are below;
// near the mouse where the control is too large to stand beside.
Rect place_of_help(const ImVec2& low, const ImVec2& high, const char* text, float wrap) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 extent = ImGui::CalcTextSize(text, nullptr, false, wrap), room = ImGui::GetIO().DisplaySize;
  const float width = extent.x + 2 * style.WindowPadding.x, height = extent.y + 2 * style.WindowPadding.y;
  const float gap = 0.4F * ImGui::GetFontSize();
  ImVec2 at{low.x, high.y + gap};
  float top = low.y;  // of what is not to be covered
  const ImGuiWindow& window = *ImGui::GetCurrentWindow();
  if ((window.Flags & ImGuiWindowFlags_Popup) != 0 && (window.Flags & ImGuiWindowFlags_Modal) == 0) {
    at = {window.Pos.x + window.Size.x + gap, low.y};
    if (at.x + width > room.x) at.x = window.Pos.x - gap - width;
  } else if (high.y - low.y > 8 * ImGui::GetFontSize()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    at = {mouse.x + gap, mouse.y + 1.2F * ImGui::GetFontSize()};
    top = mouse.y;
  }
  if (at.y + height > room.y) at.y = top - gap - height;
  return {std::clamp(at.x, 0.0F, std::max(0.0F, room.x - width)), std::max(0.0F, at.y), width, height};
}

Asked asked_of(const State& s) {
  Asked asked;
  asked.scene = s.scene;
  asked.present = s.present;
  asked.acts = s.log.size();
  if (s.present < 0 || s.log.empty()) return asked;
  const Entry& entry = s.log[static_cast<std::size_t>(s.present)];
  asked.number = entry.number;
  asked.actions = entry.actions.size();
  asked.motion = entry.motion;
  return asked;
}

// A constraint that was selected may be deleted since, or its act undone.  Bounds are selected by their degree of
// freedom.
void drop_selected(Ui& ui) {
  const std::string& selected = ui.state.selection.constraint;
  if (selected.empty() || !ui.state.scene || !ui.state.scene->problem) return;
  const Question& question = ui.question();
  if (std::ranges::count(question.equations, selected, &Equation::name) > 0) return;
  if (std::ranges::count(question.dofs, selected, &Freedom::name) > 0) return;
  Selection selection = ui.state.selection;
  selection.constraint.clear();
  ui.emit(Select{selection});
}

}  // namespace

void refresh(Ui& ui) {
  Memory& m = ui.memory;
  const State& s = ui.state;
  if (Asked asked = asked_of(s); m.asked != asked) {
    m.asked = std::move(asked);
    m.question = question_of(s);
    m.measured = -1;
  }
  drop_selected(ui);
  std::erase_if(m.told, [&](const std::string& text) { return !std::ranges::count(s.notices, text, &Notice::text); });
  // What the optimizer has is newer than what the text says, and what is being dragged newer still.
  if (s.curves)
    for (const auto& [name, value] : s.curves->constants) m.question.constants[name] = value;
  if (s.steering)
    for (const auto& [name, value] : s.steering->constants) m.question.constants[name] = value;
}

void end_lost_drags(Ui& ui) {
  const bool up = !ImGui::IsAnyMouseDown();
  if (up || !ImGui::IsAnyItemActive()) {
    ui.memory.key.dragged = -1;
    ui.memory.bar.dragged.clear();
  }
  if (up && ui.state.steering) ui.emit(Steered{true});
}

const Residuals& Ui::residuals() const {
  if (memory.measured != state.revision || memory.residuals.size() != memory.question.equations.size()) {
    memory.measured = state.revision;
    memory.residuals.assign(memory.question.equations.size(), {});
    if (state.scene && state.scene->problem && state.curves)
      memory.residuals = residuals_of(memory.question, *state.scene->problem, *state.curves);
  }
  return memory.residuals;
}

const ImVec4& Ui::colour(Severity severity) const {
  return severity == Severity::error     ? colours().bad
         : severity == Severity::warning ? colours().warning
                                         : colours().faint;
}

void Ui::control(const std::string& name, const std::string& text) {
  here(name);
  memory.helped.insert(name);
  help(text.c_str());
}

void Ui::here(const std::string& name) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  memory.places[name] = {low.x, low.y, high.x - low.x, high.y - low.y};
}

void Ui::help(const char* text) const {
  // A disabled control needs its help most.
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  // One at a time: where marks stand on something, theirs.
  if (memory.helping) return;
  memory.helping = true;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  HelpMemory& m = memory.help;
  const int frame = ImGui::GetFrameCount();
  const bool stays = frame <= m.frame + 1 && low.x == m.corner.x && low.y == m.corner.y;
  if (!stays) m = {.corner = low, .since = ImGui::GetTime()};
  m.frame = frame;
  m.used = m.used || ImGui::IsAnyMouseDown();
  if (m.used || ImGui::GetTime() - m.since < help_delay) return;
  const Rect place = place_of_help(low, high, text, scaled(340));
  ImGui::SetNextWindowPos({place.x, place.y});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + scaled(340));
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
  memory.places["help"] = place;
}

bool Ui::notices(Notice::Place place, const std::string& about) {
  bool fresh = false;
  for (std::size_t i = 0; i < state.notices.size(); ++i) {
    const Notice& notice = state.notices[i];
    if (notice.place != place || notice.about != about) continue;
    // How the last run ended stands in the panel already.
    if (place == Notice::Place::optimisation && state.motion && notice.text == state.motion->message) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, colour(notice.severity));
    ImGui::TextWrapped("%s", notice.text.c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemClicked()) emit(Dismiss{static_cast<int>(i)});
    control("told " + about, "Click to put this message away.");
    fresh |= memory.told.insert(notice.text).second;
  }
  return fresh;
}

bool has_problem(const Ui& ui) {
  const auto& scene = ui.state.scene;
  if (scene && scene->problem) return true;
  ImGui::TextWrapped("%s", !scene                       ? "No scene is open."
                           : scene->diagnostics.empty() ? "The scene is being compiled."
                                                        : "The scene has mistakes: its text says where.");
  return false;
}

std::string shown(double number) {
  if (!std::isfinite(number)) return "no number";
  return fmt::format("{:.4g}", number);
}

}  // namespace spacetime::gui
