// From expressions to a program, and the sizes of both.
#pragma once

#include <cstddef>
#include <span>

#include "common/program.h"
#include "symbolic/graph.h"

namespace spacetime::symbolic {

enum class Derivatives { none, first, second };  // second: with the multiplier-contracted Hessian

// The program that computes `values` with the derivatives asked for, with respect to every unknown input that they
// use.  Operations that values alone need come first, then what the Jacobian adds, then the Hessian.  A product that
// nothing but a sum needs becomes multiply_add.
// `differentiating`, where given, gets the milliseconds spent on derivatives added.
Program emit(Graph& graph, std::span<const Expr> values, Derivatives derivatives, double* differentiating = nullptr);

// Sizes.  `tree` counts every node once for each path from a root, without building the tree (inputs and numbers
// count; it may be astronomically large, hence a double); `shared` counts distinct nodes.
struct Size {
  double tree = 0;
  std::size_t shared = 0;
};
Size size_of(const Graph& graph, std::span<const Expr> roots);

}  // namespace spacetime::symbolic
