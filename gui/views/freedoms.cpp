#include "gui/views/freedoms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "gui/views/selection_tools.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

void toggle(std::vector<std::string>& names, const std::string& name) {
  if (const auto found = std::ranges::find(names, name); found != names.end())
    names.erase(found);
  else
    names.push_back(name);
}

// Bounds are typed as two numbers; both are needed, since the language has no half-open bound.
void draw_bounds(Ui& ui, const Freedom& dof) {
  double* ends = ui.memory.bounds;
  if (ImGui::IsWindowAppearing()) {
    ends[0] = dof.lower.value_or(-1);
    ends[1] = dof.upper.value_or(1);
  }
  ImGui::SetNextItemWidth(ui.scaled(120));
  ImGui::InputScalarN("##ends", ImGuiDataType_Double, ends, 2, nullptr, nullptr, "%.4g");
  ui.control("bounds", "The least and the most that it may be, at every time.");
  ImGui::SameLine();
  const bool pressed = ImGui::Button("Bound");
  ui.control("bound", "Keep it between these two.");
  if (pressed && std::isfinite(ends[0]) && std::isfinite(ends[1])) {
    ui.act(bound_words(dof.name, ends[0], ends[1]).line);
    ImGui::CloseCurrentPopup();
  }
}

void draw_menu(Ui& ui, const Freedom& dof) {
  if (!ImGui::BeginPopupContextItem(("menu " + dof.name).c_str())) return;
  ImGui::TextDisabled("%s", dof.name.c_str());
  if (ImGui::MenuItem("Refine", "refine")) {
    const Problem& problem = *ui.state.scene->problem;
    ui.act(refine_words(problem.start, problem.end, {dof.name}, 1).line);
  }
  ui.control("refine dof", "Halves its knot spans: finer detail becomes possible; the motion stays as it is.");
  if (ImGui::MenuItem("Damp to 0.1 an iteration", "damp")) ui.act(damp_words(0.1, {dof.name}).line);
  ui.control("damp dof", "An iteration may change its coefficients by no more than this.");
  ImGui::Separator();
  draw_bounds(ui, dof);
  ImGui::EndPopup();
}

// A name with the colour of its curve before it, where that is shown.
bool draw_shown(Ui& ui, const std::string& name, const std::string& label, bool selected) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float size = ui.scaled(9), middle = at.y + ImGui::GetTextLineHeight() / 2;
  const ImU32 colour = packed(colour_of(ui, name));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low{at.x, middle - size / 2}, high{at.x + size, middle + size / 2};
  if (selected)
    list.AddRectFilled(low, high, colour, 2);
  else
    list.AddRect(low, high, packed(ui.colours().line), 2);
  ImGui::SetCursorScreenPos({at.x + size + ui.scaled(6), at.y});
  return ImGui::Selectable((label + "##" + name).c_str(), false);
}

// By creature; what belongs to none stands first.
void draw_expressions(Ui& ui, const Problem& problem) {
  std::string creature;
  bool open = true;
  for (const Plot& plot : problem.plots) {
    const std::size_t dot = plot.name.find('.');
    const std::string of = dot == std::string::npos ? "" : creature_of(plot.name);
    if (of != creature) {
      if (!creature.empty() && open) ImGui::TreePop();
      open = of.empty() || ImGui::TreeNode(of.c_str());
      if (!of.empty()) ui.control("expressions " + of, "What can be shown of it as curves.");
      creature = of;
    }
    if (!open) continue;
    const std::string label = dot == std::string::npos ? plot.name : plot.name.substr(dot + 1);
    if (draw_shown(ui, plot.name, label, is_among(ui.state.selection.expressions, plot.name))) {
      Selection selection = ui.state.selection;
      toggle(selection.expressions, plot.name);
      ui.emit(Select{selection});
    }
    ui.control("expression " + plot.name, "Click to show its curve; of a point, its way as well.");
  }
  if (!creature.empty() && open) ImGui::TreePop();
}

}  // namespace

std::string window_line(const Question& question, const Problem& problem, std::pair<double, double> interval,
                        std::vector<std::string> dofs) {
  if (dofs.size() == question.dofs.size()) dofs.clear();
  const bool always = interval.first <= problem.start && interval.second >= problem.end;
  return (dofs.empty() && always ? window_all_words() : window_words(interval.first, interval.second, dofs)).line;
}

ImVec4 colour_of(const Ui& ui, const std::string& name) {
  std::size_t index = 0;
  if (ui.state.scene && ui.state.scene->problem) {
    const Problem& problem = *ui.state.scene->problem;
    const auto dof = std::ranges::find(problem.dofs, name, &Dof::name);
    index = static_cast<std::size_t>(dof - problem.dofs.begin());
    if (dof == problem.dofs.end())
      index += static_cast<std::size_t>(std::ranges::find(problem.plots, name, &Plot::name) - problem.plots.begin());
  }
  return ui.colours().curves[index % ui.colours().curves.size()];
}

void draw_freedoms(Ui& ui) {
  const State& s = ui.state;
  if (!has_problem(ui)) return;
  const Problem& problem = *s.scene->problem;
  const Question& question = ui.question();
  const bool narrowed =
      question.window || std::ranges::any_of(question.dofs, [](const Freedom& f) { return !f.in_window; });
  if (!narrowed) ImGui::BeginDisabled();
  if (ImGui::SmallButton("Free all")) ui.act(window_all_words().line);
  ui.control("free all", "Opens the window: everything moves again at all times.");
  if (!narrowed) ImGui::EndDisabled();
  if (ImGui::BeginTable("freedoms", 4, ImGuiTableFlags_RowBg)) {
    ImGui::TableSetupColumn("free", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFrameHeight());
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("now", ImGuiTableColumnFlags_WidthFixed, ui.scaled(62));
    ImGui::TableSetupColumn("limits", ImGuiTableColumnFlags_WidthFixed, ui.scaled(88));
    for (const Freedom& dof : question.dofs) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      bool in = dof.in_window;
      if (ImGui::Checkbox(("##in " + dof.name).c_str(), &in)) {
        std::vector<std::string> names;
        for (const Freedom& other : question.dofs)
          if (other.name == dof.name ? in : other.in_window) names.push_back(other.name);
        const auto interval = question.window.value_or(std::pair{problem.start, problem.end});
        // A window has to free something: taking the last one out is not possible.
        if (!names.empty()) ui.act(window_line(question, problem, interval, names));
      }
      ui.control("free " + dof.name, "In the window: the optimiser may change it.");
      ImGui::TableNextColumn();
      if (draw_shown(ui, dof.name, dof.name, is_among(s.selection.dofs, dof.name))) {
        select_dof(ui, dof.name);
      }
      ui.control(
          "dof " + dof.name,
          "Click to select it and show its curve, with Ctrl beside others; right button to refine, damp or bound it. "
          "What is selected is smoothed and shaken beside the curves.");
      draw_menu(ui, dof);
      ImGui::TableNextColumn();
      if (s.curves) {
        const auto curve = std::ranges::find(s.curves->dofs, dof.name, &Trajectory::name);
        if (curve != s.curves->dofs.end())
          ImGui::TextUnformatted(shown(value(curve->basis, curve->coefficients, s.playback.time)).c_str());
      }
      ImGui::TableNextColumn();
      std::string limits;
      const auto end = [](const std::optional<double>& limit) {
        return limit ? fmt::format("{:.3g}", *limit) : "free";
      };
      if (dof.lower || dof.upper) limits = fmt::format("[{}, {}]", end(dof.lower), end(dof.upper));
      if (dof.damping) limits += fmt::format(" d {:.2g}", *dof.damping);
      ImGui::TextDisabled("%s", limits.c_str());
    }
    ImGui::EndTable();
  }
  if (!problem.plots.empty()) {
    ImGui::Spacing();
    ImGui::PushFont(ui.memory.fonts.strong);
    ImGui::TextUnformatted("Expressions");
    ImGui::PopFont();
    draw_expressions(ui, problem);
  }
}

}  // namespace spacetime::gui
