#include "symbolic/elimination.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <utility>

namespace spacetime::symbolic {
namespace {

constexpr std::uint64_t no_key = ~std::uint64_t{0};

std::uint64_t key_of(std::uint32_t row, std::uint32_t column) { return std::uint64_t{row} << 32 | column; }

}  // namespace

PairTable::PairTable() : keys_(256, no_key), weights_(256) {}

std::size_t PairTable::slot_of(std::uint64_t key) const {
  const auto mask = keys_.size() - 1;
  auto slot = (key * 0x9e3779b97f4a7c15) >> 20 & mask;
  while (keys_[slot] != key && keys_[slot] != no_key) slot = (slot + 1) & mask;
  return slot;
}

Weight& PairTable::at(std::uint32_t row, std::uint32_t column, bool& is_new) {
  if (2 * (used_ + 1) > keys_.size()) grow();
  const auto slot = slot_of(key_of(row, column));
  is_new = keys_[slot] == no_key;
  if (is_new) {
    keys_[slot] = key_of(row, column);
    weights_[slot] = {};
    ++used_;
  }
  return weights_[slot];
}

Weight PairTable::get(std::uint32_t row, std::uint32_t column) const {
  const auto slot = slot_of(key_of(row, column));
  return keys_[slot] == no_key ? Weight{} : weights_[slot];
}

void PairTable::grow() {
  const auto keys = std::exchange(keys_, std::vector<std::uint64_t>(keys_.size() * 2, no_key));
  const auto weights = std::exchange(weights_, std::vector<Weight>(keys_.size()));
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] == no_key) continue;
    const auto slot = slot_of(keys[i]);
    keys_[slot] = keys[i];
    weights_[slot] = weights[i];
  }
}

Elimination::Elimination(Graph& graph, Guards& guards, std::size_t vertices)
    : graph_(graph), guards_(guards), vertices_(vertices) {}

void Elimination::add_edge(std::uint32_t above, std::uint32_t below, Weight weight) {
  bool is_new = false;
  auto& edge = edges_.at(above, below, is_new);
  edge = is_new ? weight : guards_.plus(edge, weight);
  if (is_new) {
    vertices_[above].below.push_back(below);
    vertices_[below].above.push_back(above);
    ++vertices_[above].below_count;
    ++vertices_[below].above_count;
  }
}

void Elimination::add_interaction(std::uint32_t u, std::uint32_t v, Weight weight) {
  bool is_new = false;
  auto& interaction = interactions_.at(std::max(u, v), std::min(u, v), is_new);
  interaction = is_new ? weight : guards_.plus(interaction, weight);
  if (!is_new) return;
  if (u == v) {
    vertices_[u].curved = true;
  } else {
    for (const auto& [from, to] : {std::pair(u, v), std::pair(v, u)}) {
      vertices_[from].interacts.push_back(to);
      ++vertices_[from].interacts_count;
    }
  }
}

Weight Elimination::interaction(std::uint32_t u, std::uint32_t v) const {
  return interactions_.get(std::max(u, v), std::min(u, v));
}

std::uint64_t Elimination::cost(std::uint32_t v) const {
  const auto& vertex = vertices_[v];
  const std::uint64_t below = vertex.below_count;
  return below * (std::uint64_t{vertex.above_count} + vertex.interacts_count) +
         (vertex.curved ? below * (below + 3) / 2 : 0);
}

std::vector<std::uint32_t> Elimination::remaining(const std::vector<std::uint32_t>& neighbours) const {
  std::vector<std::uint32_t> result;
  for (const auto v : neighbours) {
    if (!vertices_[v].gone) result.push_back(v);
  }
  std::ranges::sort(result);
  return result;
}

void Elimination::remove(std::uint32_t v) {
  const auto above = remaining(vertices_[v].above), below = remaining(vertices_[v].below),
             interacts = remaining(vertices_[v].interacts);
  vertices_[v].gone = true;
  for (const auto w : above) --vertices_[w].below_count;
  for (const auto u : below) --vertices_[u].above_count;
  for (const auto x : interacts) --vertices_[x].interacts_count;

  const auto curvature = interaction(v, v);
  for (std::size_t i = 0; i < below.size(); ++i) {
    const auto u = below[i];
    const auto c = edge(v, u);
    for (const auto w : above) add_edge(w, u, guards_.times(edge(w, v), c));
    for (const auto x : interacts) {
      const auto product = guards_.times(interaction(v, x), c);
      if (product.is_zero()) continue;
      add_interaction(u, x, u == x ? guards_.plus(product, product) : product);
    }
    if (!curvature.is_zero()) {
      const auto bent = guards_.times(curvature, c);
      for (std::size_t j = 0; j <= i; ++j) add_interaction(u, below[j], guards_.times(bent, edge(v, below[j])));
    }
  }
}

void Elimination::eliminate(std::span<const std::uint32_t> vertices) {
  using Candidate = std::tuple<std::uint64_t, std::uint32_t>;  // cost, then the newest node first
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  std::vector<std::uint8_t> wanted(vertices_.size());
  const auto offer = [&](std::uint32_t v) {
    if (wanted[v] && !vertices_[v].gone) queue.emplace(cost(v), ~v);
  };
  for (const auto v : vertices) wanted[v] = 1;
  for (const auto v : vertices) offer(v);
  while (!queue.empty()) {
    const auto [known, inverse] = queue.top();
    queue.pop();
    const auto v = ~inverse;
    if (vertices_[v].gone || cost(v) != known) continue;  // an offer that has been overtaken
    remove(v);
    for (const auto* neighbours : {&vertices_[v].above, &vertices_[v].below, &vertices_[v].interacts}) {
      for (const auto u : *neighbours) offer(u);
    }
  }
}

}  // namespace spacetime::symbolic
