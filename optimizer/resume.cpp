#include "optimizer/resume.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace spacetime::optimizer {
namespace {

// Positions of hard inequalities and of bounded unknowns, rows that have a condition: in the order of instances.
struct Places {
  std::vector<int> limits, equations, lower, upper;
  std::vector<int> conditional;  // rows
};

Places places_of(const Transcription& t, const Layout& layout) {
  Places places;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    if (t.rows[r].kind == Row::Kind::soft) continue;
    (t.rows[r].at_most ? places.limits : places.equations).push_back(layout.of_row[r]);
  }
  for (const int u : layout.free) {
    if (std::isfinite(t.lower[u])) places.lower.push_back(layout.of_unknown[u]);
    if (std::isfinite(t.upper[u])) places.upper.push_back(layout.of_unknown[u]);
  }
  for (const Conditional& conditional : t.conditionals) {
    const int rows = conditional.rows * conditional.condition.samples();
    for (int k = 0; k < rows; ++k) places.conditional.push_back(conditional.first_row + k);
  }
  return places;
}

// What a checkpoint keeps as the state has it: copy(of what is kept, of the state) in either direction.
template <class Kept, class State, class Copy>
void each_alike(Kept& kept, State& state, const Copy& copy) {
  copy(kept.mu, state.barrier.mu);
  copy(kept.outside, state.outside);
  copy(kept.most_violation, state.most_violation);
  copy(kept.shift, state.shift);
  copy(kept.radius, state.radius);
  copy(kept.restore_from, state.restore_from);
  copy(kept.damping, state.damping);
  copy(kept.curved, state.curved);
  copy(kept.least_sum, state.least_sum);
  copy(kept.without_progress, state.without_progress);
}

std::vector<double> taken(const Eigen::VectorXd& from, const std::vector<int>& places) {
  std::vector<double> result;
  for (const int k : places) result.push_back(from[k]);
  return result;
}

Eigen::VectorXd put(const std::vector<double>& numbers, const std::vector<int>& places, const Layout& layout,
                    std::string_view path) {
  require_size(path, numbers.size(), places.size());
  Eigen::VectorXd result = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t i = 0; i < places.size(); ++i) result[places[i]] = numbers[i];
  return result;
}

}  // namespace

void refuse_checkpoint(int unknowns_of_bfgs) {
  if (unknowns_of_bfgs <= most_bfgs_checkpoint) return;
  throw InputError(
      fmt::format("a checkpoint of the method 'bfgs' has its dense matrix, and can be made of at most {} unknowns; "
                  "there are {}",
                  most_bfgs_checkpoint, unknowns_of_bfgs));
}

void require_size(std::string_view path, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw CheckpointError(std::string(path),
                        fmt::format("there are {}, but the problem, as edited, asks for {}: the checkpoint does not "
                                    "belong to it; use the motion without its checkpoint",
                                    found, expected));
}

Checkpoint::Newton kept(const Transcription& t, const Layout& layout, const NewtonState& state) {
  const Places places = places_of(t, layout);
  Checkpoint::Newton kept;
  each_alike(kept, state, [](auto& to, const auto& from) { to = from; });
  const Barrier& barrier = state.barrier;
  kept.slacks = taken(barrier.slack, places.limits);
  kept.multipliers = taken(barrier.dual, places.limits);
  kept.lower = taken(barrier.lower_dual, places.lower);
  kept.upper = taken(barrier.upper_dual, places.upper);
  for (const int r : places.conditional) {
    kept.active.push_back(state.active[r]);
    kept.switches.push_back(state.switches[r]);
  }
  for (const auto& [violation, objective] : state.filter.pairs()) kept.filter.push_back({violation, objective});
  kept.filter_limit = state.filter.most();
  if (state.proposed.size() > 0) kept.proposed = taken(state.proposed, places.equations);
  return kept;
}

Checkpoint::Sqp92 kept(const Layout& layout, const Sqp92State& state) {
  return {state.multipliers, taken(state.merit_weights, layout.of_row)};
}

NewtonState brought_back(const Transcription& t, const Layout& layout, const Checkpoint::Newton& kept,
                         std::vector<double> x) {
  const Places places = places_of(t, layout);
  NewtonState state;
  state.x = std::move(x);
  each_alike(kept, state, [](const auto& from, auto& to) { to = from; });
  state.barrier.slack = put(kept.slacks, places.limits, layout, "/checkpoint/newton/slacks");
  state.barrier.dual = put(kept.multipliers, places.limits, layout, "/checkpoint/newton/multipliers");
  state.barrier.lower_dual = put(kept.lower, places.lower, layout, "/checkpoint/newton/lower");
  state.barrier.upper_dual = put(kept.upper, places.upper, layout, "/checkpoint/newton/upper");
  require_size("/checkpoint/newton/active", kept.active.size(), places.conditional.size());
  require_size("/checkpoint/newton/switches", kept.switches.size(), places.conditional.size());
  state.active.assign(t.rows.size(), 1);
  state.switches.assign(t.rows.size(), 0);
  for (std::size_t i = 0; i < places.conditional.size(); ++i) {
    state.active[places.conditional[i]] = static_cast<char>(kept.active[i]);
    state.switches[places.conditional[i]] = static_cast<char>(kept.switches[i]);
  }
  std::vector<Filter::Pair> pairs;
  for (const auto& [violation, objective] : kept.filter) pairs.push_back({violation, objective});
  state.filter = {std::move(pairs), kept.filter_limit};
  if (!kept.proposed.empty()) {
    state.proposed = put(kept.proposed, places.equations, layout, "/checkpoint/newton/proposed");
  }
  return state;
}

}  // namespace spacetime::optimizer
