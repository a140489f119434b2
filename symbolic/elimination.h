// Second derivatives by vertex elimination on the linearised graph (Griewank and Walther, Evaluating Derivatives, ch.
// 9 to 11).
//
// Each vertex v is a node with  dv = sum_u c(v,u) du  over its operands u, and the quadratic form
//   1/2 sum h(u,v) du dv
// collects the nodes' own second derivatives times their adjoints.  Eliminating v substitutes its dv everywhere:
//   c(w,u) += c(w,v) c(v,u)                     for each w above and u below v
//   h(u,x) += c(v,u) h(v,x)                     for each u below v and other x that v interacts with
//   h(u,u') += c(v,u) c(v,u') h(v,v)            for each u, u' below v
// until only inputs remain: h is then the Hessian, and the c that are left are the Jacobian of the vertices kept.
// Every order gives the same derivatives and another number of operations; edge pushing (Gower and Mello 2012) is the
// order from the outputs down.  Taken is the cheapest vertex next (Markowitz).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "symbolic/guarded.h"

namespace spacetime::symbolic {

// A symmetric or directed sparse table of weights, keyed by pairs of vertices.
class PairTable {
 public:
  PairTable();
  // The weight of a pair; a new zero one where `is_new` says so.
  Weight& at(std::uint32_t row, std::uint32_t column, bool& is_new);
  Weight get(std::uint32_t row, std::uint32_t column) const;

 private:
  std::size_t slot_of(std::uint64_t key) const;
  void grow();
  std::vector<std::uint64_t> keys_;
  std::vector<Weight> weights_;
  std::size_t used_ = 0;
};

class Elimination {
 public:
  Elimination(Graph& graph, Guards& guards, std::size_t vertices);

  void add_edge(std::uint32_t above, std::uint32_t below, Weight weight);
  void add_interaction(std::uint32_t u, std::uint32_t v, Weight weight);

  // Eliminates these vertices.
  void eliminate(std::span<const std::uint32_t> vertices);

  Weight edge(std::uint32_t above, std::uint32_t below) const { return edges_.get(above, below); }
  Weight interaction(std::uint32_t u, std::uint32_t v) const;

 private:
  struct Vertex {
    std::vector<std::uint32_t> above, below, interacts;  // neighbours, gone ones among them; itself never
    std::uint32_t above_count = 0, below_count = 0, interacts_count = 0;  // without those gone
    bool curved = false;                                                  // h(v,v) is not zero
    bool gone = false;
  };
  std::uint64_t cost(std::uint32_t v) const;
  void remove(std::uint32_t v);
  std::vector<std::uint32_t> remaining(const std::vector<std::uint32_t>& neighbours) const;

  Graph& graph_;
  Guards& guards_;
  std::vector<Vertex> vertices_;
  PairTable edges_, interactions_;
};

}  // namespace spacetime::symbolic
