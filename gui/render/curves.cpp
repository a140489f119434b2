#include "gui/render/curves.h"

#include <algorithm>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "common/sample.h"

namespace spacetime::gui {
namespace {

// "arm.hand" of three components: arm.hand.x, arm.hand.y, arm.hand.z.  A creature's force has one for each of its
// degrees of freedom.  Others are numbered.
std::vector<std::string> components(const Motion& motion, const std::string& name, std::size_t count) {
  if (count == 1) return {name};
  std::vector<std::string> labels;
  if (name.ends_with(".force")) {
    const std::string creature = name.substr(0, name.size() - 5);
    for (const Trajectory& dof : motion.dofs)
      if (dof.name.starts_with(creature)) labels.push_back(dof.name + ".force");
    if (labels.size() == count) return labels;
    labels.clear();
  }
  for (std::size_t k = 0; k < count; ++k)
    labels.push_back(count <= 3 ? name + "." + "xyz"[k] : name + " " + std::to_string(k + 1));
  return labels;
}

std::vector<Curve> curves_of_rows(const Motion& motion, const std::string& name,
                                  const std::vector<std::vector<double>>& rows) {
  std::vector<Curve> curves;
  const auto labels = components(motion, name, rows.empty() ? 0 : rows.front().size());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    curves.push_back({labels[k], {}});
    for (const auto& row : rows) curves.back().values.push_back(row[k]);
  }
  return curves;
}

std::vector<Curve> curves_of_plot(const Motion& motion, const Problem& problem, const Plot& plot,
                                  std::span<const double> times) {
  const Program& program = problem.programs.at(plot.program);
  if (std::ranges::find(program.inputs, InputKind::functional, &Input::kind) != program.inputs.end()) {
    throw InputError("'" + plot.name + "' is made of integrals over the whole motion, which are not computed here: " +
                     "solve with '--samples 30', and leave '--problem' out");
  }
  const Rows rows = along(program, Evaluator(program), motion, {}, times);
  std::vector<std::vector<double>> table(times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    for (const int output : plot.outputs) table[i].push_back(rows(output, i));
  return curves_of_rows(motion, plot.name, table);
}

}  // namespace

std::vector<Curve> curves_of(const Motion& motion, const Problem* problem, const std::string& name,
                             std::span<const double> times) {
  const std::string stem = name.substr(0, name.find('\''));
  const auto primes = name.size() - stem.size();
  std::vector<Curve> curves;
  if (primes <= max_derivative && name.find_first_not_of('\'', stem.size()) == std::string::npos) {
    for (const Trajectory& dof : motion.dofs) {
      if (dof.name != stem && !dof.name.starts_with(stem + ".")) continue;
      curves.push_back({dof.name + std::string(primes, '\''), {}});
      for (const double t : times)
        curves.back().values.push_back(value(dof.basis, dof.coefficients, t, static_cast<int>(primes)));
    }
    if (!curves.empty()) return curves;
  }
  if (problem != nullptr) {
    const auto plot = std::ranges::find(problem->plots, name, &Plot::name);
    if (plot != problem->plots.end()) return curves_of_plot(motion, *problem, *plot, times);
  }
  if (motion.samples) {
    const auto sampled = motion.samples->values.find(name);
    if (sampled != motion.samples->values.end()) {
      std::vector<std::vector<double>> rows;
      for (const double t : times) rows.push_back(between(*motion.samples, sampled->second, t));
      return curves_of_rows(motion, name, rows);
    }
  }
  std::string known;
  const auto add = [&](const std::string& each) { known += (known.empty() ? "" : ", ") + each; };
  for (const Trajectory& dof : motion.dofs) add(dof.name);
  if (problem != nullptr) {
    for (const Plot& plot : problem->plots) add(plot.name);
  } else if (motion.samples) {
    for (const auto& [each, rows] : motion.samples->values) add(each);
  } else {
    known += "; and with '--problem' every named expression";
  }
  throw InputError("there is no curve '" + name + "'; there are " + known);
}

}  // namespace spacetime::gui
