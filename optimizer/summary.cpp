#include "optimizer/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/diagnostic.h"
#include "common/sample.h"

namespace spacetime::optimizer {
namespace {

// Of many constraints the summary names so many, the worst first.
constexpr std::size_t violations_shown = 5;

template <typename Range, typename Name>
std::string names(const Range& range, Name name) {
  constexpr std::size_t most = 8;
  std::string text;
  std::size_t count = 0;
  for (const auto& item : range) {
    if (count == most) return text + ", ...";
    text += (count++ ? ", " : "") + name(item);
  }
  return text;
}

double time_of(const Motion& motion, const std::string& text) {
  for (const auto& [name, value] : motion.constants) {
    if (name == text) return value;
  }
  return std::strtod(text.c_str(), nullptr);
}

// One line a constraint: those that are off most, or, where all hold, those that cost most.
std::string constraints_of(const Motion& motion) {
  auto all = motion.violations;
  if (motion.status == Status::converged) {
    const auto cost = [](const Violation& one) { return one.multiplier ? std::abs(one.multiplier->value) : -1.0; };
    std::ranges::stable_sort(all, std::ranges::greater{}, cost);
  } else {
    std::ranges::stable_sort(all, std::ranges::greater{}, &Violation::max);
    std::erase_if(all, [](const Violation& one) { return one.max == 0; });
  }
  if (all.empty()) return "";
  const auto at = [](const std::optional<double>& time) {
    return time ? fmt::format("at {:.4g} s", *time) : std::string();
  };
  std::string text = "           constraint        line     off by                multiplier\n";
  for (std::size_t k = 0; k < std::min(all.size(), violations_shown); ++k) {
    const Violation& one = all[k];
    text += fmt::format("           {:16} {:5} {:10.3g} {:12}", one.name, one.line, one.max, at(one.time));
    if (one.multiplier) text += fmt::format(" {:12.4g} {}", one.multiplier->value, at(one.multiplier->time));
    text += '\n';
  }
  if (all.size() > violations_shown) text += fmt::format("           and {} more\n", all.size() - violations_shown);
  return text;
}

}  // namespace

std::string question(const Problem& problem) {
  std::size_t unknowns = problem.functionals.size(), soft = 0;
  for (const Dof& dof : problem.dofs) unknowns += dof.basis.size();
  for (const Constraint& constraint : problem.constraints) soft += constraint.weight.has_value();
  std::string text = fmt::format("asked      {} unknowns: {}, {} s\n", unknowns,
                                 names(problem.dofs, [](const Dof& d) { return d.name; }), problem.end - problem.start);
  text += fmt::format("minimise   {}\n", problem.objective.empty()
                                             ? "nothing: any motion that keeps the constraints"
                                             : names(problem.objective, [](const Term& t) { return t.name; }));
  text += fmt::format("subject to {}", names(problem.constraints, [](const Constraint& c) { return c.name; }));
  if (problem.constraints.empty()) text += "nothing";
  if (soft > 0) text += fmt::format(" ({} soft)", soft);
  return text + "\n\n";
}

std::string heading() { return "iteration      objective   violation   gradient       step      shift   seconds\n"; }

std::string line(const IterationRecord& p) {
  return fmt::format("{:9d} {:14.8g} {:11.2e} {:10.2e} {:10.2e} {:10.1e} {:9.3f}\n", p.iteration, p.objective,
                     p.violation, p.stationarity, p.step, p.shift, p.seconds);
}

Show parse_show(const Problem& problem, const std::string& text) {
  const auto split = text.find('@');
  if (split == std::string::npos) {
    throw InputError("--show '" + text + "': expected NAME@TIME, for example arm.hand@1.0 or arm.hand@release");
  }
  Show show{text.substr(0, split), text.substr(split + 1)};
  if (std::ranges::find(problem.plots, show.plot, &Plot::name) == problem.plots.end()) {
    throw InputError("--show '" + text + "': the problem has no expression '" + show.plot + "'; it has " +
                     names(problem.plots, [](const Plot& plot) { return plot.name; }));
  }
  const bool constant = std::ranges::find(problem.constants, show.time, &Constant::name) != problem.constants.end();
  char* end = nullptr;
  const double time = std::strtod(show.time.c_str(), &end);
  if (!constant && (end == show.time.c_str() || *end != '\0' || !(time >= problem.start && time <= problem.end))) {
    throw InputError("--show '" + text + "': '" + show.time +
                     "' is neither a constant nor a time within the animation");
  }
  return show;
}

std::string summary(const Problem& problem, const Motion& motion, const std::vector<Show>& shows) {
  std::string text = fmt::format("\n{}: {}\n", name_of(motion.status), motion.message);
  text += fmt::format("iterations {}\n", motion.iterations);
  text +=
      std::isnan(motion.objective) ? "objective  not a number" : fmt::format("objective  {:.10g}", motion.objective);
  if (motion.terms.size() > 1) {
    text += "  =";
    for (std::size_t k = 0; k < motion.terms.size(); ++k) {
      text += fmt::format("{} {} {:.6g}", k ? "  +" : "", motion.terms[k].first, motion.terms[k].second);
    }
  }
  text += fmt::format("\nviolation  {:.2e} at most\n", motion.violation);
  text += constraints_of(motion);
  for (const Show& show : shows) {
    const double time = time_of(motion, show.time);
    if (!(time >= motion.start && time <= motion.end)) continue;
    const std::vector<double> times{time};
    Problem only = problem;
    std::erase_if(only.plots, [&](const Plot& plot) { return plot.name != show.plot; });
    only.bodies.clear();
    const Samples samples = sample(only, motion, {}, times);
    text += fmt::format("{:10} {} at {:.4g} s:", "show", show.plot, time);
    for (const double value : samples.values.at(show.plot).front()) text += fmt::format(" {:.6g}", value);
    text += '\n';
  }
  const double rest = motion.seconds.total - motion.seconds.evaluate - motion.seconds.factor;
  text +=
      fmt::format("time       {:.1f} ms: {:.1f} evaluating, {:.1f} factoring, {:.1f} elsewhere\n",
                  1e3 * motion.seconds.total, 1e3 * motion.seconds.evaluate, 1e3 * motion.seconds.factor, 1e3 * rest);
  return text;
}

}  // namespace spacetime::optimizer
