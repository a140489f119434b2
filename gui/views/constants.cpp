#include "gui/views/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gui/views/steered.h"
#include "gui/words.h"

namespace spacetime::gui {

Steering setting(const std::vector<std::pair<std::string, double>>& constants) {
  Steering out;
  out.constants = constants;
  for (const auto& [name, value] : constants) {
    if (!out.line.empty()) out.line += "; ";
    const Words words = set_words(name, value);
    out.line += words.line;
    out.actions.push_back(words.action);
  }
  return out;
}

void draw_constants(Ui& ui) {
  const State& s = ui.state;
  if (!has_problem(ui)) return;
  if (s.scene->problem->constants.empty())
    ImGui::TextWrapped(
        "The scene has no constants. Write 'constant basket = 2.5' in it, and use the name in constraints: "
        "its value can then be dragged here while the motion follows.");
  ImGui::TextDisabled("Drag a value: the motion follows. Click to type.");
  if (ImGui::BeginTable("constants", 2, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, ui.scaled(130));
    for (const Constant& constant : s.scene->problem->constants) {
      const auto& values = ui.question().constants;
      const auto found = values.find(constant.name);
      const double value = found == values.end() ? 0 : found->second;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::AlignTextToFramePadding();
      ImGui::TextUnformatted(constant.name.c_str());
      if (!constant.value.program.empty()) {
        ImGui::SameLine();
        ImGui::TextDisabled("follows");
        ui.help("It follows from other constants until it is set itself.");
      }
      ImGui::TableNextColumn();
      if (constant.frozen) {
        ImGui::TextDisabled("%s  (fixed)", shown(value).c_str());
        ui.help(fmt::format("It shapes the motion's time, curves or joints in line {} and cannot be changed without "
                            "compiling the scene anew.",
                            constant.frozen->line)
                    .c_str());
      } else {
        SteeredNumber number{.name = "constant " + constant.name, .help = "A constant of the scene.", .value = value};
        number.speed = std::max(std::abs(value), 0.1) * 0.005;
        draw_steered(ui, number, [&](double to) { return setting({{constant.name, to}}); });
      }
      ui.notices(Notice::Place::constants, constant.name);
    }
    ImGui::EndTable();
  }
  ui.notices(Notice::Place::constants);
}

}  // namespace spacetime::gui
