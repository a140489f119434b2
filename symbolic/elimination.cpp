#include "symbolic/elimination.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace spacetime::symbolic {
namespace {

// The weights of cost(), found by search over planar and spatial arms and trees of links; the result is flat around
// them.  A weight that is new will be multiplied again and one that goes will not, unless it is a constant.  A curved
// vertex waits, for it spreads its curvature over all pairs below it.  A linear combination of inputs waits, for what
// is done in it need not be done in each of them.
constexpr std::int64_t new_weight = 6;
constexpr std::int64_t weight_gone = 4;
constexpr std::int64_t curved_waits = 8;
constexpr std::int64_t linear_waits = 16;
constexpr std::int64_t most_counted = 4096;  // beyond so many products all are taken to be new

}  // namespace

Elimination::Elimination(Guards& guards, std::size_t vertices)
    : guards_(guards), vertices_(vertices), place_(vertices) {}

void Elimination::add_edge(std::uint32_t above, std::uint32_t below, Weight weight) {
  open_below(above);
  add_below(above, below, weight);
  close();
}

void Elimination::add_interaction(std::uint32_t u, std::uint32_t v, Weight weight) {
  if (vertices_[u].interacts.size() < vertices_[v].interacts.size()) std::swap(u, v);
  for (const auto& link : vertices_[v].interacts) {
    if (link.vertex == u) note(v, link.weight);
  }
  add_beside(u, v, weight);
  close();
}

std::size_t Elimination::scale_interactions(Weight factor) {
  std::size_t count = 0;
  for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
    auto& vertex = vertices_[v];
    if (!vertex.curvature.is_zero()) ++count;
    vertex.curvature = guards_.times(vertex.curvature, factor);
    for (const auto& link : vertex.interacts) {
      if (link.vertex > v) continue;
      ++count;
      weights_[link.weight] = guards_.times(weights_[link.weight], factor);
    }
  }
  return count;
}

void Elimination::note(std::uint32_t neighbour, std::uint32_t weight) {
  place_[neighbour] = weight + 1;
  noted_.push_back(neighbour);
}

void Elimination::open_below(std::uint32_t above) {
  for (const auto& link : vertices_[above].below) note(link.vertex, link.weight);
}

// Notes all of u's row or, where that is longer, looks for u in the rows of those that may be added.
void Elimination::open_beside(std::uint32_t u, const Vertex& v) {
  std::size_t theirs = 0;
  for (const auto* links : {&v.interacts, &v.below}) {
    for (const auto& x : *links) theirs += x.vertex == u ? 0 : vertices_[x.vertex].interacts.size();
  }
  if (vertices_[u].interacts.size() <= theirs) {
    for (const auto& link : vertices_[u].interacts) note(link.vertex, link.weight);
    return;
  }
  for (const auto* links : {&v.interacts, &v.below}) {
    for (const auto& x : *links) {
      if (x.vertex == u) continue;
      for (const auto& link : vertices_[x.vertex].interacts) {
        if (link.vertex == u) note(x.vertex, link.weight);
      }
    }
  }
}

void Elimination::close() {
  for (const auto v : noted_) place_[v] = 0;
  noted_.clear();
}

// With the row of `above` open.
void Elimination::add_below(std::uint32_t above, std::uint32_t below, Weight weight) {
  if (const auto place = place_[below]; place > 0) {
    weights_[place - 1] = guards_.plus(weights_[place - 1], weight);
    return;
  }
  const auto index = static_cast<std::uint32_t>(weights_.size());
  weights_.push_back(weight);
  note(below, index);
  vertices_[above].below.push_back({below, index});
  vertices_[below].above.push_back({above, index});
  ++vertices_[above].below_count;
  ++vertices_[below].above_count;
}

// With the row of u open.
void Elimination::add_beside(std::uint32_t u, std::uint32_t v, Weight weight) {
  if (u == v) {
    vertices_[u].curvature = guards_.plus(vertices_[u].curvature, weight);
    return;
  }
  if (const auto place = place_[v]; place > 0) {
    weights_[place - 1] = guards_.plus(weights_[place - 1], weight);
    return;
  }
  const auto index = static_cast<std::uint32_t>(weights_.size());
  weights_.push_back(weight);
  note(v, index);
  for (const auto& [from, to] : {std::pair(u, v), std::pair(v, u)}) {
    vertices_[from].interacts.push_back({to, index});
    ++vertices_[from].interacts_count;
  }
}

// How many weights eliminating v would make that are not there yet.
std::int64_t Elimination::fill(std::uint32_t v) {
  compact(v);
  const auto& vertex = vertices_[v];
  std::int64_t count = 0;
  for (const auto& w : vertex.above) {
    open_below(w.vertex);
    for (const auto& u : vertex.below) count += place_[u.vertex] == 0 ? 1 : 0;
    close();
  }
  const bool curved = !vertex.curvature.is_zero();
  for (const auto& u : vertex.below) {
    open_beside(u.vertex, vertex);
    place_[u.vertex] = vertices_[u.vertex].curvature.is_zero() ? 0 : 1;
    for (const auto& x : vertex.interacts) count += place_[x.vertex] == 0 ? 1 : 0;
    for (const auto& x : vertex.below) {
      if (curved && x.vertex <= u.vertex && place_[x.vertex] == 0) ++count;
    }
    place_[u.vertex] = 0;
    close();
  }
  return count;
}

std::int64_t Elimination::cost(std::uint32_t v) {
  const auto& vertex = vertices_[v];
  const std::int64_t below = vertex.below_count, others = vertex.above_count + vertex.interacts_count;
  std::int64_t constants = 0;
  for (const auto& u : vertex.below)
    constants += guards_.is_constant(weights_[u.weight]) && !vertices_[u.vertex].gone ? 1 : 0;
  const auto products = below * others;
  return products + new_weight * (products > most_counted ? products : fill(v)) - weight_gone * (others - constants) +
         (vertex.curvature.is_zero() ? 0 : curved_waits * below * below) + (vertex.linear ? linear_waits : 0);
}

// Forgets the neighbours that are gone.
void Elimination::compact(std::uint32_t v) {
  auto& vertex = vertices_[v];
  for (auto* links : {&vertex.above, &vertex.below, &vertex.interacts}) {
    std::erase_if(*links, [&](const Link& link) { return vertices_[link.vertex].gone; });
  }
}

void Elimination::remove(std::uint32_t v) {
  auto& vertex = vertices_[v];
  vertex.gone = true;
  compact(v);
  for (const auto& w : vertex.above) {
    open_below(w.vertex);
    for (const auto& u : vertex.below) {
      add_below(w.vertex, u.vertex, guards_.times(weights_[w.weight], weights_[u.weight]));
    }
    close();
    --vertices_[w.vertex].below_count;
  }
  for (std::size_t i = 0; i < vertex.below.size(); ++i) {
    const auto u = vertex.below[i].vertex;
    const auto c = weights_[vertex.below[i].weight];
    open_beside(u, vertex);
    for (const auto& x : vertex.interacts) {
      const auto product = guards_.times(weights_[x.weight], c);
      add_beside(u, x.vertex, u == x.vertex ? guards_.plus(product, product) : product);
    }
    if (!vertex.curvature.is_zero()) {
      const auto bent = guards_.times(vertex.curvature, c);
      for (std::size_t j = 0; j <= i; ++j) {
        add_beside(u, vertex.below[j].vertex, guards_.times(bent, weights_[vertex.below[j].weight]));
      }
    }
    close();
    --vertices_[u].above_count;
  }
  for (const auto& x : vertex.interacts) --vertices_[x.vertex].interacts_count;
}

void Elimination::eliminate(std::span<const std::uint32_t> vertices) {
  using Candidate = std::tuple<std::int64_t, std::uint32_t>;  // cost, then (inverted) the newest first
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  std::vector<std::uint8_t> wanted(vertices_.size());
  std::vector<std::int64_t> offered(vertices_.size(), std::numeric_limits<std::int64_t>::max());
  const auto offer = [&](std::uint32_t v) {
    if (!wanted[v] || vertices_[v].gone) return;
    const auto now = cost(v);
    if (now != offered[v]) queue.emplace(offered[v] = now, ~v);
  };
  for (const auto v : vertices) wanted[v] = 1;
  for (const auto v : vertices) offer(v);
  while (!queue.empty()) {
    const auto [known, inverted] = queue.top();
    const auto v = ~inverted;
    queue.pop();
    if (vertices_[v].gone || offered[v] != known) continue;  // an offer that has been overtaken
    remove(v);
    for (const auto* links : {&vertices_[v].above, &vertices_[v].below, &vertices_[v].interacts}) {
      for (const auto& link : *links) offer(link.vertex);
    }
  }
}

}  // namespace spacetime::symbolic
