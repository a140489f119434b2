#include "gui/views/equations.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/views/steered.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr Notice::Place place = Notice::Place::equations;

const Violation* violation_of(const State& state, const std::string& name) {
  if (!state.motion) return nullptr;
  const auto found = std::ranges::find(state.motion->violations, name, &Violation::name);
  return found == state.motion->violations.end() ? nullptr : &*found;
}

// What a statement says, without its first word and name: those have a column of their own.
std::string body_of(const Equation& equation) {
  const std::size_t colon = equation.text.find(':');
  const std::size_t first = equation.text.find(' ');
  const std::size_t from = equation.named && colon != std::string::npos ? colon + 1 : first;
  if (from == std::string::npos) return equation.text;
  const std::size_t text = equation.text.find_first_not_of(' ', from);
  return text == std::string::npos ? "" : equation.text.substr(text);
}

void draw_draft(Ui& ui, const std::string& about, const std::string& prefix, const char* hint) {
  std::string text = ui.state.drafts.at(about);
  ImGui::PushFont(ui.memory.fonts.code);
  ImGui::SetNextItemWidth(-1);
  if (!ui.memory.focused_drafts.contains(about)) {
    // What is scrolled away takes no keyboard.
    if (ImGui::IsRectVisible({1, ImGui::GetFrameHeight()})) ui.memory.focused_drafts.insert(about);
    ImGui::SetKeyboardFocusHere();
    ImGui::SetScrollHereY(0.7F);
  }
  const bool entered =
      ImGui::InputTextWithHint(("##draft " + about).c_str(), hint, &text, ImGuiInputTextFlags_EnterReturnsTrue);
  ui.control("draft " + about,
             "As in the scene's text, without its first word. Enter applies it; a mistake is told below.");
  ImGui::PopFont();
  if (text != ui.state.drafts.at(about)) ui.emit(Draft{about, text});
  if (entered) ui.memory.focused_drafts.erase(about);  // stays where it was typed, in case of a mistake
  const bool told = ui.notices(place, about);
  const bool applied = ImGui::SmallButton(("Apply##" + about).c_str());
  if ((entered || applied) && !text.empty()) ui.emit(Act{prefix + text, place, about, text});
  ui.control("apply " + about, "Make this a line of the scene (Enter).");
  ImGui::SameLine();
  if (ImGui::SmallButton(("Cancel##" + about).c_str())) ui.emit(Draft{about, std::nullopt});
  ui.control("cancel " + about, "Forget what was written here.");
  if (told) ImGui::SetScrollHereY(1);
}

void draw_marks(Ui& ui, const Equation& equation) {
  const Colours& colours = ui.colours();
  if (equation.objective) {
    const auto& terms = ui.state.motion ? ui.state.motion->terms : std::vector<std::pair<std::string, double>>{};
    const auto term = std::ranges::find(terms, equation.name, &std::pair<std::string, double>::first);
    if (term != terms.end()) ImGui::TextUnformatted(shown(term->second).c_str());
    ui.help("What it adds to the objective.");
    return;
  }
  const Violation* violation = violation_of(ui.state, equation.name);
  if (!violation) return;
  const bool holds = violation->max <= met;
  ImGui::TextColored(holds ? colours.good : colours.bad, "%s", holds ? "met" : shown(violation->max).c_str());
  if (ImGui::IsItemHovered()) {
    std::string text = fmt::format("Off by {} at most", shown(violation->max));
    if (violation->time) text += fmt::format(", at {} s", shown(*violation->time));
    if (violation->multiplier)
      text += fmt::format(
          ".\nMultiplier {}: the objective falls by so much for each unit by which the right side is raised.",
          shown(violation->multiplier->value));
    ui.help(text.c_str());
  }
}

void draw_menu(Ui& ui, const Equation& equation) {
  const std::string& name = equation.name;
  if (!ImGui::BeginPopupContextItem(("menu " + name).c_str(), ImGuiPopupFlags_MouseButtonRight)) return;
  if (!equation.named) {
    ImGui::TextDisabled("Give it a name in the scene to edit it here:");
    ImGui::TextDisabled("constrain NAME: ...");
  }
  const auto entry = [&](const char* label, bool possible, const char* help) {
    const bool chosen = ImGui::MenuItem(label, nullptr, false, possible);
    ui.control(std::string("equation menu ") + label, help);
    return chosen;
  };
  if (entry("Edit", equation.named, "Write it anew, in place.")) ui.emit(Draft{name, body_of(equation)});
  if (entry(equation.enabled ? "Disable" : "Enable", equation.named, "Whether it counts."))
    ui.act((equation.enabled ? disable_words(name) : enable_words(name)).line, place, name);
  if (entry("Make hard", equation.named && equation.weight && !equation.objective, "It must hold."))
    ui.act(weight_words(name, std::numeric_limits<double>::infinity()).line, place, name);
  if (entry("Make soft, weight 1", equation.named && !equation.weight, "It may be violated, at a price."))
    ui.act(weight_words(name, 1).line, place, name);
  if (entry("Delete", equation.named, "Take it out of the scene; undo brings it back."))
    ui.act(delete_words(name).line, place, name);
  if (entry("Show in the scene's text", true, "Where it is written.")) {
    ui.memory.scroll_to_line = equation.line;
    ui.memory.tab_right = scene_tab;
  }
  ImGui::EndPopup();
}

Steering weighing(const std::string& name, double weight) {
  const Words words = weight_words(name, weight);
  Steering out{.line = words.line, .actions = {words.action}};
  out.weights = {{name, weight}};
  return out;
}

void draw_weight(Ui& ui, const Equation& equation) {
  if (!equation.weight) {
    ImGui::TextDisabled("hard");
    ui.help("It must hold. Give it a weight from its menu (right button) to make it soft.");
    return;
  }
  SteeredNumber number{.name = "weight " + equation.name, .help = "How much it counts in the objective."};
  number.value = *equation.weight;
  if (ui.state.steering)
    for (const auto& [name, weight] : ui.state.steering->weights)
      if (name == equation.name) number.value = weight;
  number.most = std::numeric_limits<double>::max();
  number.speed = 0.01 * (number.value > 0 ? number.value : 0.1);
  if (!equation.named) ImGui::BeginDisabled();
  draw_steered(ui, number, [&](double to) { return weighing(equation.name, to); });
  if (!equation.named) ImGui::EndDisabled();
}

void draw_row(Ui& ui, const Equation& equation) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  bool enabled = equation.enabled;
  if (!equation.named) ImGui::BeginDisabled();
  if (ImGui::Checkbox(("##on " + equation.name).c_str(), &enabled))
    ui.act((enabled ? enable_words(equation.name) : disable_words(equation.name)).line, place, equation.name);
  ui.control("enable " + equation.name,
             equation.named ? "Whether it counts."
                            : "Only what has a name in the scene can be edited here: constrain NAME: ...");
  if (!equation.named) ImGui::EndDisabled();
  ImGui::TableNextColumn();
  const bool selected = ui.state.selection.constraint == equation.name;
  if (!equation.enabled) ImGui::PushStyleColor(ImGuiCol_Text, ui.colours().faint);
  if (ImGui::Selectable(equation.name.c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick)) {
    Selection selection = ui.state.selection;
    selection.constraint = selected ? "" : equation.name;
    ui.emit(Select{selection});
    if (ImGui::IsMouseDoubleClicked(0) && equation.named) ui.emit(Draft{equation.name, body_of(equation)});
  }
  ui.control("equation " + equation.name, equation.text + "\n\nDouble click to edit, right button for more.");
  if (!equation.enabled) ImGui::PopStyleColor();
  draw_menu(ui, equation);
  ImGui::TableNextColumn();
  draw_weight(ui, equation);
  ImGui::TableNextColumn();
  if (equation.enabled) {
    draw_marks(ui, equation);
  } else {
    ImGui::TextDisabled("off");
  }
}

}  // namespace

void draw_equations(Ui& ui) {
  const State& s = ui.state;
  std::erase_if(ui.memory.focused_drafts, [&](const std::string& about) { return !s.drafts.contains(about); });
  if (!has_problem(ui)) return;
  const Question& question = ui.question();
  for (const bool objective : {false, true}) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(10), ui.scaled(2)});
    ImGui::AlignTextToFramePadding();
    ImGui::PushFont(ui.memory.fonts.strong);
    ImGui::TextUnformatted(objective ? "What is best" : "What must hold");
    ImGui::PopFont();
    const std::string fresh = objective ? "new objective" : "new constraint";
    const float room = ImGui::CalcTextSize("+ Add").x + 2 * ImGui::GetStyle().FramePadding.x;
    ImGui::SameLine(ImGui::GetContentRegionMax().x - room);
    if (ImGui::Button(("+ Add##" + fresh).c_str())) ui.emit(Draft{fresh, std::string()});
    ImGui::PopStyleVar();
    ui.control("add " + fresh, objective ? "Add a term of the objective." : "Add a constraint.");
    if (ImGui::BeginTable(objective ? "objective" : "constraints", 4, ImGuiTableFlags_RowBg)) {
      ImGui::TableSetupColumn("on", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
      ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
      ImGui::TableSetupColumn("weight", ImGuiTableColumnFlags_WidthFixed, ui.scaled(62));
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, ui.scaled(66));
      for (const Equation& equation : question.equations)
        if (equation.objective == objective) draw_row(ui, equation);
      ImGui::EndTable();
    }
    // Drafts stand under the table, at its full width, with their mistake under them.
    for (const Equation& equation : question.equations) {
      if (equation.objective != objective) continue;
      if (s.drafts.contains(equation.name)) {
        ImGui::TextDisabled("%s:", equation.name.c_str());
        draw_draft(ui, equation.name, replace_line(equation.name, ""), "");
      } else {
        if (ui.notices(place, equation.name)) ImGui::SetScrollHereY(1);
      }
    }
    if (s.drafts.contains(fresh))
      draw_draft(ui, fresh, objective ? "minimize " : "constrain ",
                 objective ? "calm: integral(x''^2) weight 1e-3" : "name: left = right  at 1");
    ImGui::Spacing();
  }
  if (ui.notices(place)) ImGui::SetScrollHereY(1);
}

}  // namespace spacetime::gui
