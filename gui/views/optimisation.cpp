#include "gui/views/optimisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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

// A measure by iteration.
struct Course {
  Name name;
  float width = 1.6F;
  std::vector<double> values{};  // one a record; no number where it is not known
};

std::vector<Course> convergence(const Ui& ui, const std::vector<IterationRecord>& record) {
  Course violation{{"violation", ui.colours().curves[0]}}, gradient{{"gradient", ui.colours().curves[1]}};
  for (const IterationRecord& r : record) {
    violation.values.push_back(r.violation);
    gradient.values.push_back(r.stationarity);
  }
  return {gradient, violation};
}

// Terms that have come or gone meanwhile are drawn as far as there are any.
std::vector<Course> objective(const Ui& ui, const std::vector<IterationRecord>& record) {
  std::vector<Course> out{{{"objective", ui.colours().text}, 2.2F}};
  for (const auto& [name, value] : record.back().terms)
    out.push_back({{name, ui.colours().curves[(out.size() - 1) % ui.colours().curves.size()]}});
  if (out.size() == 2) out.pop_back();  // the objective itself
  for (const IterationRecord& r : record) {
    out.front().values.push_back(r.objective);
    for (std::size_t k = 1; k < out.size(); ++k) {
      const auto term = std::ranges::find(r.terms, out[k].name.text, &std::pair<std::string, double>::first);
      out[k].values.push_back(term == r.terms.end() ? std::nan("") : term->second);
    }
  }
  return out;
}

constexpr double powers_worth = 30;  // numbers that lie further apart than this are drawn by their powers of ten
constexpr double most_powers = 9;

// What the vertical scale has to span; whether by powers of ten.
bool fit(PlotFrame& frame, const std::vector<Course>& courses, bool powers) {
  double low = std::numeric_limits<double>::infinity(), high = -low, least = low;
  for (const Course& course : courses) {
    for (const double v : course.values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
      if (v > 0) least = std::min(least, v);
    }
  }
  if (!(low <= high)) return powers;
  powers = powers || (low >= 0 && high > powers_worth * least);
  if (powers) {
    frame.top = high > 0 ? std::ceil(std::log10(high) + 0.1) : 1;
    frame.bottom = std::min(frame.top - 1, std::max(frame.top - most_powers, std::floor(std::log10(least) - 0.1)));
    return true;
  }
  const double room = std::max(0.08 * (high - low), 1e-9 * std::max(1.0, std::abs(high)));
  frame.bottom = low - room;
  frame.top = high + room;
  return false;
}

void draw(ImDrawList& list, const PlotFrame& frame, const Course& course, const std::vector<IterationRecord>& record,
          bool powers, float scale) {
  list.PathClear();
  for (std::size_t i = 0; i < record.size(); ++i) {
    const double v = course.values[i];
    if (!std::isfinite(v)) continue;
    list.PathLineTo({frame.x(record[i].iteration), frame.y(powers ? std::log10(std::max(v, 1e-20)) : v)});
  }
  list.PathStroke(packed(course.name.colour), 0, course.width * scale);
}

void draw_by_iteration(Ui& ui) {
  const auto& record = ui.state.record.iterations;
  bool& by_objective = ui.memory.objective_by_iteration;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(2), 0});
  if (ImGui::RadioButton("Convergence", !by_objective)) by_objective = false;
  ui.control("by convergence",
             "The largest violation of a constraint and the gradient of the Lagrangian, by iteration.");
  ImGui::SameLine();
  if (ImGui::RadioButton("Objective", by_objective)) by_objective = true;
  ui.control("by objective", "What is minimised and the terms that it is the sum of, by iteration.");
  ImGui::PopStyleVar();

  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.scaled(120);
  const float margin = ui.scaled(44), below = ImGui::GetFontSize() + 6;
  ImGui::Dummy({width, height});
  ui.control("by iteration",
             "A solve begins anew, unless it goes on where the last one ended. Thin lines: edits while it ran.");
  PlotFrame frame{
      {at.x + margin, at.y + 4}, {width - margin - 6, height - below - 4}, 0, 10, by_objective ? 0.0 : -9, 1};
  if (!record.empty()) {
    frame.left = record.front().iteration;
    frame.right = std::max(frame.left + 10.0, static_cast<double>(record.back().iteration));
  }
  std::vector<Course> courses;
  if (!record.empty()) courses = by_objective ? objective(ui, record) : convergence(ui, record);
  const bool powers = fit(frame, courses, !by_objective);
  draw_scales(list, frame, ui.colours(), powers);
  ImGui::PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  for (const int edit : ui.state.record.edits)
    list.AddLine({frame.x(edit), frame.corner.y}, {frame.x(edit), frame.corner.y + frame.size.y},
                 packed(ui.colours().accent, 0.6F), 1);
  for (std::size_t i = courses.size(); i-- > 0;) draw(list, frame, courses[i], record, powers, ui.memory.scale);
  ImGui::PopClipRect();
  std::vector<Name> names;
  for (const Course& course : courses) names.push_back(course.name);
  const Legend legend = arrange(names, ImGui::GetCursorScreenPos(), width, 2, ui.scaled(14));
  draw(list, legend, names, ui.colours(), false);
  ImGui::Dummy({width, std::max(legend.height, ImGui::GetFontSize())});
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
    if (!s.record.iterations.empty()) {
      const IterationRecord& newest = s.record.iterations.back();
      ImGui::SameLine();
      ImGui::TextDisabled("iteration %d, objective %s", newest.iteration, shown(newest.objective).c_str());
      ui.here("iterations");
    }
  } else if (s.motion && s.motion->iterations > 0) {
    const Status status = s.motion->status;
    const ImVec4& colour = status == Status::converged ? ui.colours().good
                           : status == Status::stopped ? ui.colours().warning
                                                       : ui.colours().bad;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s after %d iteration%s", std::string(name_of(status)).c_str(), s.motion->iterations,
                       s.motion->iterations == 1 ? "" : "s");
    ImGui::PopStyleColor();
    ImGui::TextWrapped("%s", s.motion->message.c_str());
    ui.here("outcome");
  } else {
    ImGui::TextDisabled("Not solved yet: press Run.");
  }
  draw_by_iteration(ui);
  draw_terms(ui);
}

}  // namespace spacetime::gui
