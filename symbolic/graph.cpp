#include "symbolic/graph.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "common/assert.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

// Mixes all bits of a node into each bit of the result (the finaliser of MurmurHash3, Appleby).
std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccd;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53;
  return x ^ (x >> 33);
}

std::uint64_t hash_of(const Graph::Node& node) {
  const auto tag = static_cast<std::uint64_t>(node.kind) << 8 | static_cast<std::uint64_t>(node.op);
  const auto operands = std::uint64_t{node.a.id} << 32 | node.b.id;
  const auto rest = std::uint64_t{node.c.id} << 32 | node.input;
  return mixed(operands + mixed(rest + mixed(std::bit_cast<std::uint64_t>(node.number) + tag)));
}

}  // namespace

Graph::Graph() : nodes_(1), table_(1024) {}

void Graph::grow() {
  table_.assign(table_.size() * 2, 0);
  const auto mask = table_.size() - 1;
  for (std::uint32_t id = 1; id < nodes_.size(); ++id) {
    auto slot = hash_of(nodes_[id]) & mask;
    while (table_[slot] != 0) slot = (slot + 1) & mask;
    table_[slot] = id;
  }
}

Expr Graph::intern(const Node& node) {
  const auto mask = table_.size() - 1;
  auto slot = hash_of(node) & mask;
  for (; table_[slot] != 0; slot = (slot + 1) & mask) {
    if (nodes_[table_[slot]] == node) return {table_[slot]};
  }
  SPACETIME_ASSERT(nodes_.size() < 0xffff'ffff);
  const Expr e{static_cast<std::uint32_t>(nodes_.size())};
  nodes_.push_back(node);
  table_[slot] = e.id;
  if (nodes_.size() * 2 > table_.size()) grow();  // at most half full: probes stay short
  return e;
}

Expr Graph::make(Op op, Expr a, Expr b, Expr c) {
  return intern({.kind = Kind::operation, .op = op, .a = a, .b = b, .c = c});
}

Expr Graph::number(double value) {
  SPACETIME_ASSERT(std::isfinite(value));
  if (value == 0) return {};  // minus zero too
  return intern({.number = value});
}

Expr Graph::pi(double multiple) {
  SPACETIME_ASSERT(std::isfinite(multiple));
  if (multiple == 0) return {};
  return intern({.kind = Kind::pi, .number = multiple});
}

Expr Graph::input(const Input& input) {
  const auto key = std::to_string(static_cast<int>(input.kind)) + ' ' + std::to_string(input.derivative) + ' ' +
                   std::to_string(input.index) + ' ' + input.name;
  const auto [found, is_new] = input_nodes_.try_emplace(key);
  if (is_new) {
    found->second = intern({.kind = Kind::input, .input = static_cast<std::uint32_t>(inputs_.size())});
    inputs_.push_back(input);
  }
  return found->second;
}

bool Graph::is_number(Expr e, double value) const {
  return nodes_[e.id].kind == Kind::number && nodes_[e.id].number == value;
}

std::optional<double> Graph::constant(Expr e) const {
  const auto& n = nodes_[e.id];
  if (n.kind == Kind::number) return n.number;
  if (n.kind == Kind::pi) return n.number * std::numbers::pi;
  return std::nullopt;
}

bool Graph::is_undefined(Expr e) const {
  const auto& n = nodes_[e.id];
  if (n.kind != Kind::operation) return false;
  // What is constant and finite has been folded: a constant operation that is still here has no finite value.
  const int arity = info(n.op).arity;
  return is_constant(n.a) && (arity < 2 || is_constant(n.b)) && (arity < 3 || is_constant(n.c));
}

}  // namespace spacetime::symbolic
