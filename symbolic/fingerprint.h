// A statement's program must not change when something else in the scene does.  In the scene's graph the order of
// operands follows the age of nodes, and so the scene's other statements; so programs are emitted from a graph of their
// own, into which expressions are copied in an order that depends on nothing but themselves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "symbolic/graph.h"

namespace spacetime::symbolic {

// A number for each node that depends on what the node means, up to its sign and the order of operands where that
// does not matter.  Grows with the graph.
class Fingerprints {
 public:
  explicit Fingerprints(const Graph& graph) : graph_(graph) {}
  std::uint64_t of(Expr e);

 private:
  std::uint64_t make(const Graph::Node& node) const;

  const Graph& graph_;
  std::vector<std::uint64_t> prints_;  // by node id
};

// The same expressions in another graph.
std::vector<Expr> copy(const Graph& from, Fingerprints& fingerprints, std::span<const Expr> roots, Graph& to);

}  // namespace spacetime::symbolic
