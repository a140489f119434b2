#include "gui/views/selection_tools.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "gui/views/files.h"
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

// What is asked of the person before the selected degrees of freedom are changed.
struct Tool {
  const char* name;   // of its popup, and of the button in it
  const char* label;  // of that button
  const char* what;   // it does
  const char* open;   // help of the button that opens it
  const char* done;   // ... of the one that does it
  const char *number, *number_name, *number_help;
};
constexpr Tool smooth{"filter",
                      "Filter",
                      "Smooths",
                      "Smooths the degrees of freedom that are selected, here or in the Freedom table.",
                      "Smooths them, as a line of the log.",
                      "Strength, s",
                      "filter strength",
                      "Wiggles of this period are halved, faster ones damped more and slower ones less."};
constexpr Tool disturb{"shake",
                       "Shake",
                       "Disturbs",
                       "Disturbs the degrees of freedom that are selected, to leave a local minimum.",
                       "Disturbs them, as a line of the log.",
                       "Amplitude",
                       "shake amplitude",
                       "A smooth random curve is added that nowhere exceeds this, in each one's own units."};

// A button and its popup, which stands beside the tools so that it covers none of them; `more` draws what else is
// asked.  Whether it is to be done.
template <class More>
bool draw_tool(Ui& ui, const Tool& tool, const DofNames& names, double& number, const More& more) {
  if (names.empty()) ImGui::BeginDisabled();
  if (ImGui::SmallButton((std::string(tool.label) + "...").c_str())) ImGui::OpenPopup(tool.name);
  ui.control(std::string("open ") + tool.name, tool.open);
  if (names.empty()) ImGui::EndDisabled();
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  ImGui::SetNextWindowPos({corner.x + size.x + ui.scaled(6), corner.y + size.y}, ImGuiCond_Always, {0, 1});
  if (!ImGui::BeginPopup(tool.name)) return false;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(8), ui.scaled(4)});  // the tools' own are tighter
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.scaled(8), ui.scaled(6)});
  say_what(ui, tool.what, names);
  ImGui::SetNextItemWidth(ui.scaled(90));
  ImGui::InputDouble(tool.number, &number, 0, 0, "%.4g");
  ui.control(tool.number_name, tool.number_help);
  more();
  const bool possible = std::isfinite(number) && number > 0 && !names.empty();
  const bool done = ImGui::Button(tool.label) && possible;
  ui.control(tool.name, tool.done);
  if (done || escaped()) ImGui::CloseCurrentPopup();
  ImGui::PopStyleVar(2);
  ImGui::EndPopup();
  return done;
}

}  // namespace

void draw_selection_tools(Ui& ui) {
  const DofNames names = selected(ui);
  SelectionToolsMemory& m = ui.memory.selection_tools;
  if (draw_tool(ui, smooth, names, m.strength, [] {}))
    ui.act(filter_words(m.strength, named(ui, names)).line, Notice::Place::timeline);
  ImGui::SameLine();
  const auto ask_seed = [&] {
    ImGui::SetNextItemWidth(ui.scaled(90));
    ImGui::InputInt("Seed", &m.seed, 0);
    ui.control("shake seed", "The same seed is the same disturbance. Each Shake counts it up.");
    m.seed = std::clamp(m.seed, 1, 1'000'000);
  };
  if (draw_tool(ui, disturb, names, m.amplitude, ask_seed))
    ui.act(shake_words(m.amplitude, m.seed++, named(ui, names)).line, Notice::Place::timeline);
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
