#include "optimizer/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "optimizer/conflict.h"
#include "optimizer/dependence.h"
#include "optimizer/not_finite.h"

namespace spacetime::optimizer {
namespace {

std::string and_then(const std::string& sentence) { return sentence.empty() ? "" : " " + sentence; }

std::string contradictions(const Transcription& t, const Layout& layout, const NewtonState& state) {
  std::string text;
  for (const Conflict& conflict : conflicts(t, layout, state.x, state.values, state.linear.jacobian, state.sizes)) {
    text += and_then(sentence(conflict));
  }
  return text;
}

}  // namespace

std::vector<Violation> violations(const Transcription& t, std::span<const double> x, const Values& values) {
  std::vector<Violation> result;
  std::vector<int> of_constraint(t.problem->constraints.size(), -1);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (row.kind != Row::Kind::hard) continue;
    int& index = of_constraint[row.statement];
    if (index < 0) {
      const Constraint& constraint = t.problem->constraints[row.statement];
      index = static_cast<int>(result.size());
      result.push_back({constraint.name, 0, std::nullopt, constraint.place.line});
      if (!std::isnan(row.time)) result.back().time = row.time;
    }
    const double amount = std::abs(excess(row, values.residual[r]));
    if (!(amount <= result[index].max)) {
      result[index].max = amount;
      if (!std::isnan(row.time)) result[index].time = row.time;
    }
  }
  for (int k = 0; k < t.dofs(); ++k) {
    const Dof& dof = t.problem->dofs[k];
    if (!dof.lower && !dof.upper) continue;
    const auto times = greville(dof.basis);
    Violation bound{dof.name, 0, times.front(), dof.place.line};
    for (int u = t.first[k]; u < t.first[k + 1]; ++u) {
      const double amount = std::max(t.lower[u] - x[u], x[u] - t.upper[u]);
      if (amount > bound.max) {
        bound.max = amount;
        bound.time = times[u - t.origin(k)];
      }
    }
    result.push_back(std::move(bound));
  }
  return result;
}

std::string worst_of(const std::vector<Violation>& all, double tolerance) {
  const auto worst = std::ranges::max_element(all, {}, &Violation::max);
  if (worst == all.end() || worst->max == 0) return "every hard constraint holds";
  if (worst->max <= tolerance) return fmt::format("every hard constraint holds to {:.3g}", tolerance);
  std::string text = fmt::format("'{}' (line {}) is off by {:.3g}", worst->name, worst->line, worst->max);
  if (worst->time) text += fmt::format(" at {:.4g} s", *worst->time);
  return text;
}

Outcome outcome_of(StepResult result, const Transcription& t, const Layout& layout, const NewtonState& state,
                   double tolerance) {
  const std::string worst = worst_of(violations(t, state.x, state.values), tolerance);
  switch (result) {
    case StepResult::converged:
      return {Status::converged,
              fmt::format("Hard constraints hold, and the gradient of the Lagrangian vanishes, to {:.3g}.", tolerance) +
                  and_then(sentence(*t.problem, dependences(t, layout, state.linear.jacobian, state.active))) +
                  and_then(undecided_condition(t, state.x))};
    case StepResult::infeasible: {
      std::string why = contradictions(t, layout, state);
      if (why.empty()) why = " No change reduces the violation: " + worst + ".";
      return {Status::infeasible, "No motion near this one satisfies every hard constraint." + why +
                                      " Relax a constraint, give it a weight, or start from another sketch."};
    }
    case StepResult::not_finite: {
      std::string why = why_not_finite(t, state.x, state.multipliers, state.active);
      if (why.empty()) why = "A sum along this motion is too large to be a number.";
      return {Status::failed, why + " Start from another sketch, or keep the motion away from there."};
    }
    case StepResult::singular:
      return {Status::failed,
              "The equations of the step could not be solved however strongly they were regularised; " + worst + "."};
    case StepResult::exhausted:
      return {Status::stopped,
              fmt::format("Rounding hides any further progress: the gradient of the Lagrangian is down "
                          "to {:.3g} of the objective's; {}.",
                          state.measures.stationarity, worst)};
    case StepResult::stepped:
      break;
  }
  return {Status::stopped, ""};
}

std::string remark_of(int pivoted) {
  return pivoted > 0 ? fmt::format(" ({} of the steps needed a pivoted solve.)", pivoted) : "";
}

std::vector<std::pair<std::string, double>> terms_of(const Transcription& t, const Values& values) {
  const Problem& problem = *t.problem;
  std::vector<std::pair<std::string, double>> terms;
  for (std::size_t k = 0; k < problem.objective.size(); ++k) {
    terms.emplace_back(problem.objective[k].name, values.terms[k]);
  }
  std::vector<double> sums(problem.constraints.size(), 0.0);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    if (t.rows[r].kind != Row::Kind::soft) continue;
    const double amount = excess(t.rows[r], values.residual[r]);
    sums[t.rows[r].statement] += t.rows[r].weight / 2 * amount * amount;
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (problem.constraints[k].weight) terms.emplace_back(problem.constraints[k].name, sums[k]);
  }
  return terms;
}

int count_of_terms(const Transcription& t) {
  const auto is_soft = [](const Constraint& constraint) { return constraint.weight.has_value(); };
  return static_cast<int>(t.problem->objective.size()) +
         static_cast<int>(std::ranges::count_if(t.problem->constraints, is_soft));
}

void measure(const Transcription& t, std::span<const double> x, const Values& values, Motion& motion) {
  motion.objective = values.objective;
  motion.terms = terms_of(t, values);
  motion.violations = violations(t, x, values);
  for (const Violation& violation : motion.violations) {
    if (!(violation.max <= motion.violation)) motion.violation = violation.max;
  }
}

std::vector<Multipliers> multipliers_of(const Transcription& t, const Layout& layout, const NewtonState& state) {
  std::vector<Multipliers> result;
  std::vector<int> of_constraint(t.problem->constraints.size(), -1);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (row.kind != Row::Kind::hard) continue;
    const Constraint& constraint = t.problem->constraints[row.statement];
    int& index = of_constraint[row.statement];
    if (index < 0) {
      index = static_cast<int>(result.size());
      result.push_back({constraint.name, constraint.place.line, {}, {}});
    }
    // Instances follow one another, each component by component.
    auto& [name, line, times, values] = result[index];
    const std::size_t components = t.problem->programs.at(constraint.program).values.size();
    if (values.empty() || values.back().size() == components) {
      values.emplace_back();
      if (!std::isnan(row.time)) times.push_back(row.time);
    }
    values.back().push_back(state.multipliers[r]);
  }
  for (int k = 0; k < t.dofs(); ++k) {
    const Dof& dof = t.problem->dofs[k];
    if (!dof.lower && !dof.upper) continue;
    Multipliers bound{dof.name, dof.place.line, {}, {}};
    const auto times = greville(dof.basis);
    for (int u = t.first[k]; u < t.first[k + 1]; ++u) {
      const int position = layout.of_unknown[u];
      if (position < 0) continue;
      bound.times.push_back(times[u - t.origin(k)]);
      bound.values.push_back({state.barrier.upper_dual[position] - state.barrier.lower_dual[position]});
    }
    if (!bound.times.empty()) result.push_back(std::move(bound));
  }
  std::erase_if(result, [](const Multipliers& multipliers) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return !std::ranges::all_of(multipliers.values, [&](const auto& row) { return std::ranges::all_of(row, finite); });
  });
  return result;
}

void add_multipliers(const std::vector<Multipliers>& all, Motion& motion) {
  for (const Multipliers& multipliers : all) {
    const auto found = std::ranges::find_if(motion.violations, [&](const Violation& violation) {
      return violation.line == multipliers.line && violation.name == multipliers.name;
    });
    if (found == motion.violations.end()) continue;
    for (std::size_t i = 0; i < multipliers.values.size(); ++i) {
      for (const double value : multipliers.values[i]) {
        if (found->multiplier && !(std::abs(value) > std::abs(found->multiplier->value))) continue;
        found->multiplier =
            Multiplier{value, multipliers.times.empty() ? std::nullopt : std::optional(multipliers.times[i])};
      }
    }
  }
}

}  // namespace spacetime::optimizer
