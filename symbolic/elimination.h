// Derivatives by vertex elimination on the linearised graph (Griewank and Walther, Evaluating Derivatives, ch. 9-11).
//
// Each vertex v is a node with  dv = sum_u c(v,u) du  over its operands u, and the quadratic form
//   1/2 sum h(u,v) du dv
// collects the nodes' own second derivatives times their adjoints.  Eliminating v substitutes its dv everywhere:
//   c(w,u)  += c(w,v) c(v,u)             for each w above and u below v
//   h(u,x)  += c(v,u) h(v,x)             for each u below v and other x that v interacts with
//   h(u,u') += c(v,u) c(v,u') h(v,v)     for each u, u' below v
// until only inputs remain: h is then the Hessian, and the c that are left are the Jacobian of the vertices kept.
// Every order gives the same derivatives and another number of operations; edge pushing (Gower and Mello 2012) is the
// order from the outputs down.  Here the cheapest goes next; see cost().
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "symbolic/guarded.h"

namespace spacetime::symbolic {

class Elimination {
 public:
  Elimination(Guards& guards, std::size_t vertices);

  void add_edge(std::uint32_t above, std::uint32_t below, Weight weight);
  void add_interaction(std::uint32_t u, std::uint32_t v, Weight weight);
  // Multiplies all h; returns how many there are.
  std::size_t scale_interactions(Weight factor);
  // Declares a vertex to be a sum of inputs with constant coefficients.
  void set_linear(std::uint32_t v) { vertices_[v].linear = true; }

  // Eliminates these vertices; the others stay.
  void eliminate(std::span<const std::uint32_t> vertices);

  // Visits what is left: f(neighbour, weight).
  template <class F>
  void for_each_below(std::uint32_t v, F f) const {
    for (const auto& [u, index] : vertices_[v].below) {
      if (!vertices_[u].gone) f(u, weights_[index]);
    }
  }
  template <class F>
  void for_each_interaction(std::uint32_t v, F f) const {
    if (!vertices_[v].curvature.is_zero()) f(v, vertices_[v].curvature);
    for (const auto& [u, index] : vertices_[v].interacts) {
      if (!vertices_[u].gone) f(u, weights_[index]);
    }
  }

 private:
  struct Link {
    std::uint32_t vertex, weight;  // neighbour; index into weights_, which both ends share
  };
  struct Vertex {
    std::vector<Link> above, below, interacts;                            // gone ones among them; itself never
    std::uint32_t above_count = 0, below_count = 0, interacts_count = 0;  // without those gone
    Weight curvature;                                                     // h(v,v)
    bool linear = false, gone = false;
  };

  std::int64_t fill(std::uint32_t v);
  std::int64_t cost(std::uint32_t v);
  void remove(std::uint32_t v);
  void compact(std::uint32_t v);
  // Opens a vertex's row: notes where the weights of its neighbours are, for add_below and add_beside.
  void open_below(std::uint32_t above);
  // ... for additions to the vertices that v interacts with and those below it.
  void open_beside(std::uint32_t u, const Vertex& v);
  void note(std::uint32_t neighbour, std::uint32_t weight);
  void close();
  void add_below(std::uint32_t above, std::uint32_t below, Weight weight);
  void add_beside(std::uint32_t u, std::uint32_t v, Weight weight);

  Guards& guards_;
  std::vector<Vertex> vertices_;
  std::vector<Weight> weights_;
  std::vector<std::uint32_t> place_;  // of each vertex, in the row that is open: 1 + index into weights_, or 0
  std::vector<std::uint32_t> noted_;  // the vertices that have a place
};

}  // namespace spacetime::symbolic
