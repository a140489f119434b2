#include "optimizer/carry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>

namespace spacetime::optimizer {
namespace {

double time_of(const Row& row) { return std::isnan(row.time) ? 0 : row.time; }
bool is_limit(const Row& row) { return row.kind == Row::Kind::hard && row.at_most; }

// Of one component of a constraint: the multiplier of the first instance at each time (s), 0 where it has none.
using Instances = std::map<double, double>;

double nearest(const Instances& instances, double time) {
  const auto after = instances.lower_bound(time);
  if (after == instances.begin()) return after->second;
  const auto before = std::prev(after);
  return after == instances.end() || time - before->first <= after->first - time ? before->second : after->second;
}

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
    known[key].emplace(time_of(from.rows[r]), state.barrier.dual[layout.of_row[r]]);
  });
  for_each_limit(to, [&](const auto& key, std::size_t r) {
    const auto found = known.find(key);
    if (found != known.end()) result.dual[r] = nearest(found->second, time_of(to.rows[r]));
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
