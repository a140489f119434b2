#include "gui/views/optimisation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gui/views/plot_frame.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

constexpr std::array<const char*, 4> methods{"Newton (ours)", "SQP (1992)", "SQP, linear CG (1992)", "BFGS (1994)"};

void draw_choices(Ui& ui) {
  Memory& m = ui.memory;
  if (!ImGui::BeginTable("choices", 2)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, ui.scaled(84));
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
  const auto row = [&](const char* name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
  };
  row("Method");
  ImGui::Combo("##method", &m.method, methods.data(), static_cast<int>(methods.size()));
  ui.control("method",
             "How an iteration is made. Newton converges in the fewest; the papers' own methods are there to compare.");
  row("Tolerance");
  ImGui::InputDouble("##tolerance", &m.tolerance, 0, 0, "%.0e");
  m.tolerance = std::clamp(m.tolerance, 1e-15, 1.0);
  ui.control("tolerance",
             "Converged: every hard constraint holds to this much in its own units, and the gradient of the Lagrangian "
             "vanishes to it.");
  row("Starts");
  ImGui::InputInt("##starts", &m.starts, 0);
  m.starts = std::clamp(m.starts, 1, 1000);
  ui.control("starts", "Solve from so many shaken starts and keep the best motion.");
  ImGui::EndTable();
}

void draw_convergence(Ui& ui) {
  const auto& record = ui.state.record;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.scaled(120);
  const float margin = ui.scaled(44), below = ImGui::GetFontSize() + 6;
  ImGui::Dummy({width, height});
  ui.control("convergence", "The largest violation of a constraint and the gradient of the Lagrangian, by iteration.");
  PlotFrame frame{{at.x + margin, at.y + 4}, {width - margin - 6, height - below - 4}, 0, 10, -9, 1};
  if (!record.empty()) {
    frame.left = record.front().iteration;
    frame.right = std::max(frame.left + 10.0, static_cast<double>(record.back().iteration));
    double highest = -8;
    for (const auto& r : record)
      for (const double v : {r.violation, r.stationarity})
        if (v > 0 && std::isfinite(v)) highest = std::max(highest, std::log10(v));
    frame.top = std::ceil(highest + 0.1);
  }
  draw_scales(list, frame, ui.colours(), true);
  ImGui::PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  const auto curve = [&](double IterationRecord::*measure, const ImVec4& colour) {
    list.PathClear();
    for (const auto& r : record) {
      const double v = r.*measure;
      if (!std::isfinite(v)) continue;
      list.PathLineTo({frame.x(r.iteration), frame.y(std::log10(std::max(v, 1e-20)))});
    }
    list.PathStroke(packed(colour), 0, ui.scaled(1.6F));
  };
  curve(&IterationRecord::stationarity, ui.colours().curves[1]);
  curve(&IterationRecord::violation, ui.colours().curves[0]);
  ImGui::PopClipRect();
  ImGui::TextColored(ui.colours().curves[0], "violation");
  ImGui::SameLine();
  ImGui::TextColored(ui.colours().curves[1], "gradient");
}

void draw_terms(Ui& ui) {
  const auto& motion = ui.state.motion;
  if (!motion) return;
  if (!ImGui::BeginTable("terms", 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("term", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, ui.scaled(84));
  const auto row = [&](const std::string& name, double value, bool strong) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (strong) ImGui::PushFont(ui.memory.fonts.strong);
    ImGui::TextUnformatted(name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(shown(value).c_str());
    if (strong) ImGui::PopFont();
  };
  row("Objective", motion->objective, true);
  for (const auto& [name, value] : motion->terms) row("  " + name, value, false);
  row("Largest violation", motion->violation, true);
  ImGui::EndTable();
}

}  // namespace

std::string solve_line(const Memory& m) {
  Solve solve;
  solve.method = m.method == 0 ? Solve::Method::newton : m.method == 3 ? Solve::Method::bfgs : Solve::Method::sqp92;
  solve.linear_cg = m.method == 2;
  solve.tolerance = m.tolerance;
  solve.starts = m.starts;
  return solve_words(solve).line;
}

void draw_optimisation(Ui& ui) {
  const State& s = ui.state;
  draw_choices(ui);
  ui.notices(Notice::Place::optimisation);
  if (s.steering) {
    ImGui::TextColored(ui.colours().accent, "Following the drag");
  } else if (s.running) {
    ImGui::TextColored(ui.colours().accent, s.stopping ? "Stopping" : "Solving");
    if (!s.record.empty()) {
      ImGui::SameLine();
      ImGui::TextDisabled("iteration %d, objective %s", s.record.back().iteration,
                          shown(s.record.back().objective).c_str());
    }
  } else if (s.motion && s.motion->iterations > 0) {
    const Status status = s.motion->status;
    const ImVec4& colour = status == Status::converged ? ui.colours().good
                           : status == Status::stopped ? ui.colours().warning
                                                       : ui.colours().bad;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s after %d iterations", std::string(name_of(status)).c_str(), s.motion->iterations);
    ImGui::PopStyleColor();
    ImGui::TextWrapped("%s", s.motion->message.c_str());
    ui.here("outcome");
  } else {
    ImGui::TextDisabled("Not solved yet: press Run.");
  }
  draw_convergence(ui);
  draw_terms(ui);
}

}  // namespace spacetime::gui
