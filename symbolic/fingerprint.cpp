#include "symbolic/fingerprint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace spacetime::symbolic {
namespace {

// SplitMix64's finaliser (Steele, Lea and Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31);
}

std::uint64_t mix(std::uint64_t x, std::uint64_t y) { return mix(mix(x) ^ y); }

std::uint64_t print_of(const Input& input) {
  std::uint64_t out = mix(static_cast<std::uint64_t>(input.kind), static_cast<std::uint64_t>(input.index));
  out = mix(out, static_cast<std::uint64_t>(input.derivative));
  for (const char c : input.name) out = mix(out, static_cast<unsigned char>(c));
  return out;
}

// Whether operands may change places, as far as fingerprints go: a - b is b - a up to its sign.
bool is_symmetric(Op op) { return op == Op::subtract || info(op).commutative; }

}  // namespace

std::uint64_t Fingerprints::make(const Graph::Node& node) const {
  const auto kind = static_cast<std::uint64_t>(node.kind);
  if (node.kind == Graph::Kind::input) return mix(kind, print_of(graph_.inputs()[node.input]));
  if (node.kind != Graph::Kind::operation) return mix(kind, std::bit_cast<std::uint64_t>(std::fabs(node.number)));
  if (node.op == Op::negate) return prints_[node.a.id];
  std::uint64_t a = prints_[node.a.id], b = prints_[node.b.id];
  if (is_symmetric(node.op) && b < a) std::swap(a, b);
  return mix(mix(mix(kind, static_cast<std::uint64_t>(node.op)), a), mix(b, prints_[node.c.id]));
}

std::uint64_t Fingerprints::of(Expr e) {
  while (prints_.size() <= e.id) prints_.push_back(make(graph_.node({static_cast<std::uint32_t>(prints_.size())})));
  return prints_[e.id];
}

std::vector<Expr> copy(const Graph& from, Fingerprints& fingerprints, std::span<const Expr> roots, Graph& to) {
  std::unordered_map<std::uint32_t, Expr> done{{0, Expr{}}};  // node 0 is the number 0 in every graph
  std::vector<Expr> stack;
  for (const Expr root : roots) {
    stack.push_back(root);
    while (!stack.empty()) {
      const Expr e = stack.back();
      const Graph::Node& node = from.node(e);
      if (done.contains(e.id)) {
        stack.pop_back();
      } else if (node.kind == Graph::Kind::input) {
        done[e.id] = to.input(from.input_of(e));
      } else if (node.kind == Graph::Kind::number) {
        done[e.id] = to.number(node.number);
      } else if (node.kind == Graph::Kind::pi) {
        done[e.id] = to.pi(node.number);
      } else {
        // The last one pushed is visited first.
        std::array<Expr, 3> order{node.c, node.b, node.a};
        if (is_symmetric(node.op) && fingerprints.of(node.b) < fingerprints.of(node.a)) std::swap(order[1], order[2]);
        const std::size_t pending = stack.size();
        for (const Expr operand : order)
          if (!done.contains(operand.id)) stack.push_back(operand);
        if (stack.size() == pending)
          done[e.id] = to.operation(node.op, done[node.a.id], done[node.b.id], done[node.c.id]);
      }
    }
  }
  std::vector<Expr> out;
  for (const Expr root : roots) out.push_back(done[root.id]);
  return out;
}

}  // namespace spacetime::symbolic
