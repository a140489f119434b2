#include "gui/views/optimisation.h"

#include <fmt/format.h>

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
  const auto beside = [&](const char* name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", name);
  };
  const auto row = [&](const char* name) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    beside(name);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1);
  };
  row("Method");
  ImGui::Combo("##method", &m.method, methods.data(), static_cast<int>(methods.size()));
  ui.control("method",
             "How an iteration is made. Newton converges in the fewest; the papers' own methods are there to compare.");
  row("Tolerance");
  ImGui::SetNextItemWidth(ui.scaled(78));
  ImGui::InputDouble("##tolerance", &m.tolerance, 0, 0, "%.0e");
  m.tolerance = std::clamp(m.tolerance, 1e-15, 1.0);
  ui.control("tolerance",
             "Converged: every hard constraint holds to this much in its own units, and the gradient of the Lagrangian "
             "vanishes to it.");
  ImGui::SameLine();
  beside("Starts");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
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

constexpr float least_chart = 70, most_chart = 220;  // pixels at scale 1
constexpr double powers_worth = 30;  // numbers that lie further apart than this are drawn by their powers of ten
constexpr double most_powers = 9;

// What the vertical scale has to span; whether by powers of ten.  What does not change has room about it.
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
  const double least_room = high == 0 ? 1 : 0.02 * std::abs(high);
  const double room = std::max(0.08 * (high - low), least_room);
  frame.bottom = low - room;
  frame.top = high + room;
  return false;
}

// The line through a measure, within the frame, with a dot for each iteration where there is room for dots: one alone
// has no line.  By powers of ten nothing stands on the lower edge.
void draw(Ui& ui, const PlotFrame& frame, const Course& course, bool powers) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Record& record = ui.state.record;
  const float scale = ui.memory.scale;
  std::vector<ImVec2> points;
  for (std::size_t i = 0; i < record.iterations.size(); ++i) {
    const double v = course.values[i];
    if (!std::isfinite(v)) continue;
    const double height = !powers ? v : v > 0 ? std::log10(v) : frame.bottom;
    const ImVec2 at{frame.x(record.iterations[i].iteration - record.began()), frame.y(height)};
    // Of what one column of pixels holds, the lowest and the highest: ImGui can draw 16,384 points in one line.
    const std::size_t n = points.size();
    if (n < 2 || std::floor(at.x) != std::floor(points[n - 2].x)) {
      points.push_back(at);
      continue;
    }
    const auto [low, high] = std::minmax({points[n - 2].y, points[n - 1].y, at.y});
    points[n - 2].y = low;
    points[n - 1].y = high;
  }
  const ImU32 colour = packed(course.name.colour);
  list.PushClipRect(frame.corner, {frame.corner.x + frame.size.x, frame.corner.y + frame.size.y}, true);
  list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, course.width * scale);
  list.PopClipRect();
  constexpr float room_for_dots = 7;  // pixels at scale 1, from one to the next
  if (frame.size.x < room_for_dots * scale * static_cast<float>(record.made())) return;
  for (const ImVec2& point : points)
    if (point.y <= frame.corner.y + frame.size.y + 1) list.AddCircleFilled(point, 2.2F * scale, colour);
  if (!points.empty()) ui.memory.places["newest iteration"] = {points.back().x - 1, points.back().y - 1, 2, 2};
}

void draw_by_iteration(Ui& ui) {
  const Record& run = ui.state.record;
  const auto& record = run.iterations;
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
  // What room is left, with the names of two rows below it.
  const float below_all = 2 * (ImGui::GetFontSize() + 2) + ImGui::GetStyle().ItemSpacing.y;
  const float width = ImGui::GetContentRegionAvail().x;
  const float height =
      std::clamp(ImGui::GetContentRegionAvail().y - below_all, ui.scaled(least_chart), ui.scaled(most_chart));
  const float margin = ui.scaled(44), below = ImGui::GetFontSize() + 6;
  ImGui::Dummy({width, height});
  ui.control("by iteration",
             "Iterations of this run, from its start; one that goes on where the last ended continues it. Thin lines: "
             "edits while it ran.");
  PlotFrame frame{
      {at.x + margin, at.y + 4}, {width - margin - 6, height - below - 4}, 0, 10, by_objective ? 0.0 : -9, 1};
  if (!record.empty()) {
    const double last = std::max(1, run.made()), room = 0.02 * last;
    frame.left = -room;
    frame.right = last + room;
  }
  std::vector<Course> courses;
  if (!record.empty()) courses = by_objective ? objective(ui, record) : convergence(ui, record);
  const bool powers = fit(frame, courses, !by_objective);
  draw_scales(list, frame, ui.colours(), powers, true);
  for (const int edit : run.edits) {
    const float x = frame.x(edit - run.began());
    list.AddLine({x, frame.corner.y}, {x, frame.corner.y + frame.size.y}, packed(ui.colours().accent, 0.6F), 1);
  }
  for (std::size_t i = courses.size(); i-- > 0;) draw(ui, frame, courses[i], powers);
  std::vector<Name> names;
  for (const Course& course : courses) names.push_back(course.name);
  const Legend legend = arrange(names, ImGui::GetCursorScreenPos(), width, 2, ui.scaled(14));
  draw(list, legend, names, ui.colours(), false);
  ImGui::Dummy({width, std::max(legend.height, ImGui::GetFontSize())});
}

void draw_terms(Ui& ui) {
  const auto& motion = ui.state.motion;
  if (!motion) return;
  // Close together, so that all of the panel has room at 1280x800.
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ImGui::GetStyle().CellPadding.x, ui.scaled(1)});
  const bool drawn = ImGui::BeginTable("terms", 2, ImGuiTableFlags_RowBg);
  ImGui::PopStyleVar();
  if (!drawn) return;
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
  ui.here("terms");
}

// How it stands, in a few words, and what there is to say of it.
struct Standing {
  std::string words, text;
  ImVec4 colour;
};

std::string iterations(int number) { return fmt::format("{} iteration{}", number, number == 1 ? "" : "s"); }

// Of the last run, while the motion is what that has reached: its number in the session, and its own iterations.
std::string told_of_run(const State& s, const std::string& what) {
  const Record& run = s.record;
  const int all = s.motion->iterations;
  if (run.run == 0 || run.began() + run.made() != all) return fmt::format("{} after {}", what, iterations(all));
  const std::string before = run.began() == 0 ? "" : fmt::format(" ({} in all)", all);
  return fmt::format("Run {}: {} after {}{}", run.run, what, iterations(run.made()), before);
}

Standing standing_of(const Ui& ui) {
  const State& s = ui.state;
  const Colours& c = ui.colours();
  if (s.steering) return {"Following the drag", "", c.accent};
  if (s.running) {
    std::string words = fmt::format("Run {}: {}", s.record.run, s.stopping ? "stopping" : "solving");
    if (!s.record.iterations.empty())
      words +=
          fmt::format(", iteration {}, objective {}", s.record.made(), shown(s.record.iterations.back().objective));
    return {words, "", c.accent};
  }
  if (!s.motion || s.motion->iterations == 0) return {"Not solved yet: press Run.", "", c.faint};
  const Motion& motion = *s.motion;
  if (can_continue(s)) return {told_of_run(s, "paused"), "Continue goes on: " + s.paused->line, c.warning};
  // An edit that takes nothing of it away leaves a converged motion converged.
  const bool edited = s.present >= 0 && !s.log[static_cast<std::size_t>(s.present)].iterated;
  if (edited && motion.status == Status::stopped) return {"Edited: press Run", motion.message, c.warning};
  const ImVec4& colour = motion.status == Status::converged ? c.good
                         : motion.status == Status::stopped ? c.warning
                                                            : c.bad;
  return {told_of_run(s, std::string(name_of(motion.status))), motion.message, colour};
}

constexpr float room_below = 290;  // pixels at scale 1, that table and chart want

// However long it is, the table and the chart below stay in sight.
void draw_standing(Ui& ui) {
  const Standing standing = standing_of(ui);
  ImGui::PushStyleColor(ImGuiCol_Text, standing.colour);
  ImGui::TextWrapped("%s", standing.words.c_str());
  ImGui::PopStyleColor();
  ui.memory.standing = standing.words;
  float& height = ui.memory.outcome_height;
  const float most =
      std::max(4.3F * ImGui::GetTextLineHeight(), ImGui::GetContentRegionAvail().y - ui.scaled(room_below));
  ImGui::BeginChild("outcome", {0, std::clamp(height, 1.0F, most)});
  ui.notices(Notice::Place::optimisation);
  if (!standing.text.empty()) {
    ImGui::TextWrapped("%s", standing.text.c_str());
    ui.here("outcome");
  }
  height = ImGui::GetCursorPosY();
  ImGui::EndChild();
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
  draw_choices(ui);
  draw_standing(ui);
  draw_terms(ui);
  draw_by_iteration(ui);
}

}  // namespace spacetime::gui
