#include "gui/views/curve_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "gui/views/freedoms.h"

namespace spacetime::gui {
namespace {

constexpr int samples_drawn = 400;

// Of the largest multiplier: bounds that are further from touching than this cost nothing.
constexpr double nothing = 1e-6;

std::string with_primes(const std::string& name, int derivative) {
  return name + std::string(static_cast<std::size_t>(derivative), '\'');
}

void add_dof(const Ui& ui, const Trajectory& dof, bool ghost, std::vector<Curve>& out) {
  const double start = std::max(ui.memory.span.from, dof.basis.knots.front());
  const double end = std::min(ui.memory.span.to, dof.basis.knots.back());
  const CurvesMemory& m = ui.memory.curves;
  std::vector<double> coefficients = dof.coefficients;
  if (!ghost && m.dragged == dof.name && m.dragged_index >= 0)
    coefficients[static_cast<std::size_t>(m.dragged_index)] = m.dragged_value;
  for (int d = 0; d <= max_derivative; ++d) {
    if (!m.derivative[d]) continue;
    Curve curve{.name = dof.name, .whole = with_primes(dof.name, d), .of = dof.name, .colour = colour_of(ui, dof.name)};
    curve.derivative = d;
    curve.dotted = ghost;
    if (ghost) curve.whole += " before", curve.colour.w = 0.45F;
    for (int k = 0; k <= samples_drawn; ++k) {
      const double t = start + (end - start) * k / samples_drawn;
      curve.times.push_back(t);
      curve.values.push_back(value(dof.basis, coefficients, t, d));
    }
    out.push_back(std::move(curve));
  }
}

// Differences of samples: what has been sampled is all that is known of an expression here.
std::vector<double> slopes(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> out(values.size());
  const std::size_t last = values.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const std::size_t a = i == 0 ? 0 : i - 1, b = i == last ? last : i + 1;
    out[i] = (values[b] - values[a]) / (times[b] - times[a]);
  }
  return out;
}

void add_expression(const Ui& ui, const std::string& name, std::vector<Curve>& out) {
  const auto& samples = ui.state.samples;
  if (!samples) return;
  const auto found = samples->values.find(name);
  if (found == samples->values.end() || samples->times.size() < 3) return;
  const std::size_t components = found->second.empty() ? 0 : found->second.front().size();
  for (std::size_t c = 0; c < components; ++c) {
    Curve curve{.name = name, .of = name, .colour = colour_of(ui, name), .times = samples->times};
    curve.dotted = c > 0;
    if (components > 1) curve.name += fmt::format("[{}]", c + 1);
    for (const auto& row : found->second) curve.values.push_back(row[c]);
    for (int d = 0; d <= max_derivative; ++d) {
      if (d > 0) curve.values = slopes(curve.times, curve.values);
      curve.derivative = d;
      curve.whole = with_primes(curve.name, d);
      if (ui.memory.curves.derivative[d]) out.push_back(curve);
    }
  }
}

// Each of as many as there are in a colour of its own, and once all have been used, with another mark.
void add_points(const Ui& ui, Curve curve, std::vector<Curve>& out) {
  const auto& colours = ui.colours().curves;
  curve.colour = colours[out.size() % colours.size()];
  curve.mark = static_cast<int>(out.size() / colours.size()) % marks;
  curve.points = true;
  curve.whole = curve.name;
  out.push_back(std::move(curve));
}

std::vector<Curve> residual_curves(const Ui& ui) {
  std::vector<Curve> out;
  const std::string& selected = ui.state.selection.constraint;
  for (std::size_t e = 0; e < ui.residuals().size(); ++e) {
    const Equation& equation = ui.question().equations[e];
    if (!selected.empty() && selected != equation.name) continue;
    Curve curve{.name = equation.name, .of = equation.name};
    for (const Residual& r : ui.residuals()[e]) {
      curve.times.push_back(r.time);
      curve.values.push_back(r.value);
    }
    if (!curve.times.empty()) add_points(ui, std::move(curve), out);
  }
  return out;
}

double largest(const Multipliers& multipliers) {
  double most = 0;
  for (const auto& row : multipliers.values)
    for (const double value : row) most = std::max(most, std::abs(value));
  return most;
}

std::vector<Curve> multiplier_curves(const Ui& ui) {
  std::vector<Curve> out;
  if (!ui.state.motion) return out;
  const std::string& selected = ui.state.selection.constraint;
  double most = 0;
  for (const Multipliers& multipliers : ui.state.motion->multipliers) most = std::max(most, largest(multipliers));
  for (const Multipliers& multipliers : ui.state.motion->multipliers) {
    if (multipliers.times.empty()) continue;
    if (!selected.empty() && selected != multipliers.name) continue;
    const auto& dofs = ui.question().dofs;
    const bool bound = std::ranges::find(dofs, multipliers.name, &Freedom::name) != dofs.end();
    if (bound && largest(multipliers) <= nothing * most) continue;
    const std::size_t components = multipliers.values.front().size();
    for (std::size_t c = 0; c < components; ++c) {
      Curve curve{.name = multipliers.name, .of = multipliers.name};
      if (components > 1) curve.name += fmt::format("[{}]", c + 1);
      curve.times = multipliers.times;
      for (const auto& row : multipliers.values) curve.values.push_back(row[c]);
      add_points(ui, std::move(curve), out);
    }
  }
  return out;
}

}  // namespace

std::vector<Curve> curves_shown(const Ui& ui) {
  const State& s = ui.state;
  if (ui.memory.curves.show == CurvesMemory::Show::residuals) return residual_curves(ui);
  if (ui.memory.curves.show == CurvesMemory::Show::multipliers) return multiplier_curves(ui);
  std::vector<Curve> out;
  if (!s.curves) return out;
  for (const Trajectory& dof : s.curves->dofs) {
    if (!is_among(s.selection.dofs, dof.name)) continue;
    add_dof(ui, dof, false, out);
    if (!s.ghost) continue;
    const auto before = std::ranges::find(s.ghost->dofs, dof.name, &Trajectory::name);
    if (before != s.ghost->dofs.end()) add_dof(ui, *before, true, out);
  }
  for (const std::string& name : s.selection.expressions) add_expression(ui, name, out);
  return out;
}

const char* why_none(const Ui& ui) {
  const State& s = ui.state;
  if (ui.memory.curves.show == CurvesMemory::Show::curves)
    return "Select degrees of freedom or expressions to see their curves.";
  if (!s.selection.constraint.empty()) return "The constraint that is selected has none in time.";
  if (ui.memory.curves.show == CurvesMemory::Show::residuals) return "No constraint has instances in time.";
  if (s.motion && !s.motion->multipliers.empty()) return "No constraint has instances in time.";
  return "Not known here: they are found by solving with Newton where all constraints can hold.";
}

}  // namespace spacetime::gui
