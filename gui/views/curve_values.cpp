#include "gui/views/curve_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/bspline.h"
#include "gui/views/freedoms.h"
#include "gui/views/pen.h"

namespace spacetime::gui {
namespace {

constexpr int samples_drawn = 400;

// Of the largest multiplier: bounds that are further from touching than this cost nothing.
constexpr double nothing = 1e-6;

std::string with_primes(const std::string& name, int derivative) {
  return name + std::string(static_cast<std::size_t>(derivative), '\'');
}

void add_dof(const Ui& ui, const Trajectory& dof, bool ghost, std::vector<Plotted>& out) {
  const double start = std::max(ui.memory.span.from, dof.basis.knots.front());
  const double end = std::min(ui.memory.span.to, dof.basis.knots.back());
  const CurvesMemory& m = ui.memory.curves;
  std::vector<double> coefficients = dof.coefficients;
  if (const auto index = static_cast<std::size_t>(m.dragged_index);
      !ghost && m.dragged == dof.name && index < coefficients.size())
    coefficients[index] = m.dragged_value;
  for (int d = 0; d <= max_derivative; ++d) {
    if (!m.derivative[d]) continue;
    Plotted curve{
        .name = dof.name, .whole = with_primes(dof.name, d), .of = dof.name, .colour = colour_of(ui, dof.name)};
    curve.derivative = d;
    curve.before = ghost;
    if (ghost) curve.whole += " before";
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

void add_expression(const Ui& ui, const std::string& name, std::vector<Plotted>& out) {
  const auto& samples = ui.state.samples;
  if (!samples) return;
  const auto found = samples->values.find(name);
  if (found == samples->values.end() || samples->times.empty()) return;
  const std::size_t components = found->second.empty() ? 0 : found->second.front().size();
  for (std::size_t c = 0; c < components; ++c) {
    Plotted curve{.name = name, .of = name, .colour = colour_of(ui, name), .times = samples->times};
    if (components > 1) curve.name += fmt::format("[{}]", c + 1);
    for (const auto& row : found->second) curve.values.push_back(row[c]);
    for (int d = 0; d <= (samples->times.size() > 1 ? max_derivative : 0); ++d) {
      if (d > 0) curve.values = slopes(curve.times, curve.values);
      curve.derivative = d;
      curve.whole = with_primes(curve.name, d);
      if (ui.memory.curves.derivative[d]) out.push_back(curve);
    }
  }
}

// Each in a colour of its own, as long as there are any.
void add_points(const Ui& ui, Plotted curve, std::vector<Plotted>& out) {
  const auto& colours = ui.colours().curves;
  curve.colour = colours[out.size() % colours.size()];
  curve.points = true;
  curve.whole = curve.name;
  out.push_back(std::move(curve));
}

// So many can be told apart.
std::size_t looks(const Ui& ui) { return ui.colours().curves.size() * static_cast<std::size_t>(styles); }

// Of equations that are shown and have any; indices into both.
std::vector<std::size_t> residuals_shown(const Ui& ui) {
  std::vector<std::size_t> out;
  const std::string& selected = ui.state.selection.constraint;
  for (std::size_t e = 0; e < ui.residuals().size(); ++e) {
    const bool meant = selected.empty() || selected == ui.question().equations[e].name;
    if (meant && !ui.residuals()[e].empty()) out.push_back(e);
  }
  return out;
}

std::vector<Plotted> residual_curves(const Ui& ui) {
  std::vector<Plotted> out;
  for (const std::size_t e : residuals_shown(ui)) {
    const Equation& equation = ui.question().equations[e];
    Plotted curve{.name = equation.name, .of = equation.name};
    for (const Residual& r : ui.residuals()[e]) {
      curve.times.push_back(r.time);
      curve.values.push_back(r.value);
    }
    add_points(ui, std::move(curve), out);
  }
  return out;
}

double largest(const Multipliers& multipliers) {
  double most = 0;
  for (const auto& row : multipliers.values)
    for (const double value : row) most = std::max(most, std::abs(value));
  return most;
}

// Those that have something to say: before anything was solved they are guesses.
std::vector<const Multipliers*> multipliers_shown(const Ui& ui) {
  std::vector<const Multipliers*> out;
  if (!ui.state.motion || ui.state.motion->iterations == 0) return out;
  const std::string& selected = ui.state.selection.constraint;
  double most = 0;
  for (const Multipliers& multipliers : ui.state.motion->multipliers) most = std::max(most, largest(multipliers));
  for (const Multipliers& multipliers : ui.state.motion->multipliers) {
    if (multipliers.times.empty()) continue;
    if (!selected.empty() && selected != multipliers.name) continue;
    const auto& dofs = ui.question().dofs;
    const bool bound = std::ranges::find(dofs, multipliers.name, &Freedom::name) != dofs.end();
    if (!bound || largest(multipliers) > nothing * most) out.push_back(&multipliers);
  }
  return out;
}

std::vector<Plotted> multiplier_curves(const Ui& ui) {
  std::vector<Plotted> out;
  const auto all = multipliers_shown(ui);
  std::size_t count = 0;
  for (const Multipliers* multipliers : all) count += multipliers->values.front().size();
  const bool folded = count > looks(ui);  // then by the largest component in size
  for (const Multipliers* multipliers : all) {
    const std::size_t components = multipliers->values.front().size();
    for (std::size_t c = 0; c < (folded ? 1 : components); ++c) {
      Plotted curve{.name = multipliers->name, .of = multipliers->name};
      if (components > 1)
        curve.name += folded ? fmt::format(" (largest of {})", components) : fmt::format("[{}]", c + 1);
      curve.times = multipliers->times;
      for (const auto& row : multipliers->values)
        curve.values.push_back(folded ? *std::ranges::max_element(row, {}, [](double v) { return std::abs(v); })
                                      : row[c]);
      add_points(ui, std::move(curve), out);
    }
  }
  return out;
}

// A name that looks like one before it takes the next style, and once all have been used, the next colour.
void tell_apart(const Ui& ui, std::vector<Plotted>& curves) {
  const auto& colours = ui.colours().curves;
  const auto index = [&](const ImVec4& colour) {
    const auto is_it = [&](const ImVec4& c) { return c.x == colour.x && c.y == colour.y && c.z == colour.z; };
    return static_cast<std::size_t>(std::ranges::find_if(colours, is_it) - colours.begin()) % colours.size();
  };
  std::map<std::string, std::pair<std::size_t, int>> known;
  std::set<std::pair<std::size_t, int>> taken;
  for (Plotted& curve : curves) {
    auto look = known.find(curve.name);
    if (look == known.end()) {
      std::pair<std::size_t, int> wanted{index(curve.colour), 0};
      for (std::size_t tries = 0; taken.contains(wanted) && tries < looks(ui); ++tries)
        if (++wanted.second == styles) wanted = {(wanted.first + 1) % colours.size(), 0};
      taken.insert(wanted);
      look = known.emplace(curve.name, wanted).first;
    }
    curve.colour = colours[look->second.first];
    curve.style = look->second.second;
    if (curve.before) curve.colour.w = 0.45F, curve.style = faded;
  }
}

std::vector<Plotted> motion_curves(const Ui& ui) {
  const State& s = ui.state;
  std::vector<Plotted> out;
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

bool has_values(const Samples& samples, const std::string& name) {
  const auto found = samples.values.find(name);
  if (found == samples.values.end()) return false;
  return std::ranges::any_of(found->second, [](const auto& row) {
    return std::ranges::any_of(row, [](double v) { return std::isfinite(v); });
  });
}

std::string motion_lacks(const Ui& ui) {
  const State& s = ui.state;
  if (s.selection.dofs.empty() && s.selection.expressions.empty())
    return "Select degrees of freedom or expressions in the tab Freedom to see their curves.";
  if (std::ranges::count(ui.memory.curves.derivative, true) == 0) return "Choose q, q' or q'' to see curves.";
  std::string names;
  for (const std::string& name : s.selection.expressions)
    if (!s.samples || !has_values(*s.samples, name)) names += (names.empty() ? "" : ", ") + name;
  if (names.empty()) return {};
  return s.samples ? names + ": no number at any time of this motion." : names + ": not known yet. Solve to see it.";
}

bool has_constraints(const Ui& ui) {
  return std::ranges::count(ui.question().equations, false, &Equation::objective) > 0;
}

constexpr const char* no_constraints = "The scene has no constraints. Add one in the tab Equations.";
constexpr const char* none_in_time = "The constraint that is selected has no instances in time. Its name selects all.";

std::string residuals_lack(const Ui& ui) {
  if (!has_constraints(ui)) return no_constraints;
  if (!residuals_shown(ui).empty()) return {};
  if (!ui.state.selection.constraint.empty()) return none_in_time;
  return "No constraint has instances in time.";
}

std::string multipliers_lack(const Ui& ui) {
  const auto& motion = ui.state.motion;
  if (!has_constraints(ui)) return no_constraints;
  if (!motion || motion->iterations == 0) return "Solve to see what each constraint costs.";
  if (motion->multipliers.empty())
    return "Not known of this motion. Solve by Newton, where all constraints can hold, to see what each costs.";
  if (!multipliers_shown(ui).empty()) return {};
  if (!ui.state.selection.constraint.empty()) return none_in_time;
  return "No constraint has instances in time.";
}

}  // namespace

std::vector<Plotted> curves_shown(const Ui& ui) {
  using Show = CurvesMemory::Show;
  const Show show = ui.memory.curves.show;
  std::vector<Plotted> out = show == Show::residuals     ? residual_curves(ui)
                             : show == Show::multipliers ? multiplier_curves(ui)
                                                         : motion_curves(ui);
  tell_apart(ui, out);
  return out;
}

std::string what_lacks(const Ui& ui) {
  using Show = CurvesMemory::Show;
  const Show show = ui.memory.curves.show;
  return show == Show::residuals     ? residuals_lack(ui)
         : show == Show::multipliers ? multipliers_lack(ui)
                                     : motion_lacks(ui);
}

}  // namespace spacetime::gui
