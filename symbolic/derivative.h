// Derivatives of expressions.  All rules stand on one page, in derivative.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "symbolic/graph.h"

namespace spacetime::symbolic {

// Total derivative with respect to time: dof and signal inputs go to their next derivative, time to 1, everything else
// is constant.  Nothing where a third derivative of a trajectory would be needed.
std::optional<Expr> time_derivative(Graph& graph, Expr e);

struct Entry {
  int row = 0, column = 0;
  Expr value;
};

// Structurally non-zero entries of d values[row] / d inputs[column], by row, then column.
std::vector<Entry> jacobian(Graph& graph, std::span<const Expr> values, std::span<const Expr> inputs);

// Structurally non-zero entries of the lower triangle (column <= row) of d2 e / d inputs d inputs, times `factor` where
// there is one.
std::vector<Entry> hessian(Graph& graph, Expr e, std::span<const Expr> inputs, std::optional<Expr> factor = {});

}  // namespace spacetime::symbolic
