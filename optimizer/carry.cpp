#include "optimizer/carry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace spacetime::optimizer {
namespace {

bool is_limit(const Row& row) { return row.kind == Row::Kind::hard && row.at_most; }

// Instances of one component of a constraint.
struct Instances {
  std::vector<double> times;  // s, as the scope gives them
  std::vector<double> duals;
};

// Calls visit(name and component, row) for every limit.
template <typename Visit>
void for_each_limit(const Transcription& t, Visit visit) {
  int component = 0;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    if (!is_limit(row)) continue;
    const bool goes_on = r > 0 && t.rows[r - 1].statement == row.statement && is_limit(t.rows[r - 1]) &&
                         (t.rows[r - 1].time == row.time || std::isnan(row.time));
    component = goes_on ? component + 1 : 0;
    visit(std::pair(t.problem->constraints[row.statement].name, component), r);
  }
}

}  // namespace

Carried carried(const Transcription& from, const Layout& layout, const NewtonState& state, const Transcription& to) {
  Carried result;
  result.mu = state.barrier.mu;
  const auto& [violation, sum, stationarity, gap] = state.measures;
  if (state.condition == StepResult::stepped) result.reached = std::max({violation, stationarity, gap});
  result.dual.assign(to.rows.size(), 0.0);
  result.lower_dual.assign(to.unknowns(), 0.0);
  result.upper_dual.assign(to.unknowns(), 0.0);

  std::map<std::pair<std::string, int>, Instances> known;
  for_each_limit(from, [&](const auto& key, std::size_t r) {
    Instances& instances = known[key];
    instances.times.push_back(std::isnan(from.rows[r].time) ? 0 : from.rows[r].time);
    instances.duals.push_back(state.barrier.dual[layout.of_row[r]]);
  });
  for_each_limit(to, [&](const auto& key, std::size_t r) {
    const auto found = known.find(key);
    if (found == known.end()) return;
    const auto& [times, duals] = found->second;
    const double time = std::isnan(to.rows[r].time) ? 0 : to.rows[r].time;
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < times.size(); ++k) {
      if (std::abs(times[k] - time) < std::abs(times[nearest] - time)) nearest = k;
    }
    result.dual[r] = duals[nearest];
  });

  // Bounds' multipliers belong to coefficients: to the same ones while the basis is the same.
  for (int dof = 0; dof < to.dofs() && dof < from.dofs(); ++dof) {
    const Dof &old = from.problem->dofs[dof], &now = to.problem->dofs[dof];
    if (old.name != now.name || old.basis != now.basis) continue;
    for (int u = to.first[dof]; u < to.first[dof + 1]; ++u) {
      const int was = u - to.origin(dof) + from.origin(dof);
      if (was < from.first[dof] || was >= from.first[dof + 1] || from.fixed[was]) continue;
      result.lower_dual[u] = state.barrier.lower_dual[layout.of_unknown[was]];
      result.upper_dual[u] = state.barrier.upper_dual[layout.of_unknown[was]];
    }
  }
  return result;
}

}  // namespace spacetime::optimizer
