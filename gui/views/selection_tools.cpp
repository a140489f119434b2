#include "gui/views/selection_tools.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "gui/words.h"

namespace spacetime::gui {
namespace {

// In the problem's order.
DofNames selected(const Ui& ui) {
  DofNames names;
  for (const Freedom& dof : ui.question().dofs)
    if (is_among(ui.state.selection.dofs, dof.name)) names.push_back(dof.name);
  return names;
}

// For the line: where all are meant none has to be named.
DofNames named(const Ui& ui, const DofNames& names) {
  return names.size() == ui.question().dofs.size() ? DofNames{} : names;
}

void say_what(Ui& ui, const char* verb, const DofNames& names) {
  const bool all = names.size() == ui.question().dofs.size();
  ImGui::PushTextWrapPos(ui.scaled(230));
  ImGui::TextUnformatted(
      fmt::format("{} {}", verb, all ? "every degree of freedom" : fmt::format("{}", fmt::join(names, ", "))).c_str());
  ImGui::PopTextWrapPos();
}

void draw_number(Ui& ui, const char* label, const char* name, double& value, const char* help) {
  ImGui::SetNextItemWidth(ui.scaled(90));
  ImGui::InputDouble(label, &value, 0, 0, "%.4g");
  ui.control(name, help);
}

void draw_filter(Ui& ui, const DofNames& names) {
  if (!ImGui::BeginPopup("filter")) return;
  SelectionToolsMemory& m = ui.memory.selection_tools;
  say_what(ui, "Smooths", names);
  draw_number(ui, "Strength, s", "filter strength", m.strength,
              "Wiggles of this period are halved, faster ones damped more and slower ones less.");
  const bool possible = std::isfinite(m.strength) && m.strength > 0 && !names.empty();
  if (ImGui::Button("Filter") && possible) {
    ui.act(filter_words(m.strength, named(ui, names)).line, Notice::Place::timeline);
    ImGui::CloseCurrentPopup();
  }
  ui.control("filter", "Smooths them, as a line of the log.");
  ImGui::EndPopup();
}

void draw_shake(Ui& ui, const DofNames& names) {
  if (!ImGui::BeginPopup("shake")) return;
  SelectionToolsMemory& m = ui.memory.selection_tools;
  say_what(ui, "Disturbs", names);
  draw_number(ui, "Amplitude", "shake amplitude", m.amplitude,
              "A smooth random curve is added that nowhere exceeds this, in each one's own units.");
  ImGui::SetNextItemWidth(ui.scaled(90));
  ImGui::InputInt("Seed", &m.seed, 0);
  ui.control("shake seed", "The same seed is the same disturbance. Each Shake counts it up.");
  m.seed = std::clamp(m.seed, 1, 1'000'000);
  const bool possible = std::isfinite(m.amplitude) && m.amplitude > 0 && !names.empty();
  if (ImGui::Button("Shake") && possible) {
    ui.act(shake_words(m.amplitude, m.seed++, named(ui, names)).line, Notice::Place::timeline);
    ImGui::CloseCurrentPopup();
  }
  ui.control("shake", "Disturbs them, as a line of the log.");
  ImGui::EndPopup();
}

}  // namespace

void draw_selection_tools(Ui& ui) {
  const DofNames names = selected(ui);
  if (names.empty()) ImGui::BeginDisabled();
  if (ImGui::SmallButton("Filter...")) ImGui::OpenPopup("filter");
  ui.control("open filter", "Smooths the degrees of freedom that are selected, here or in the Freedom table.");
  ImGui::SameLine();
  if (ImGui::SmallButton("Shake...")) ImGui::OpenPopup("shake");
  ui.control("open shake", "Disturbs the degrees of freedom that are selected, to leave a local minimum.");
  if (names.empty()) ImGui::EndDisabled();
  draw_filter(ui, names);
  draw_shake(ui, names);
}

void select_dof(Ui& ui, const std::string& name) {
  Selection selection = ui.state.selection;
  if (!ImGui::GetIO().KeyCtrl)
    selection.dofs = {name};
  else if (is_among(selection.dofs, name))
    std::erase(selection.dofs, name);
  else
    selection.dofs.push_back(name);
  ui.emit(Select{selection});
}

}  // namespace spacetime::gui
