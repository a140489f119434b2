// Functionals: integral( ) and at( ).  Inside expressions each stands as one input of the graph; the statement that
// uses it decides whether it becomes part of an ordinary instance, a piece of the objective, or an entry of
// Problem::functionals.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "symbolic/model.h"

namespace spacetime::symbolic {

// The input that stands for it.  `at` of what does not depend on time is that itself.
Expr functional(Model& model, const FunctionalUse& use);

// The functionals that stand in `values` (not those inside these), in the order they were written.
std::vector<int> functionals_in(Model& model, std::span<const Expr> values);

// Those, and the ones inside them.
std::vector<int> all_functionals_in(Model& model, std::span<const Expr> values);

// The time, where all of them are values at one and the same.
std::optional<Expr> common_time(const Model& model, const std::vector<int>& functionals);

// With what an `at` is taken of in its place; for use at that time.
Expr take_out(Model& model, Expr e, const std::vector<int>& functionals);

// With every functional in it entered into the problem.
Expr place(Model& model, Expr e);
std::vector<Expr> place(Model& model, std::vector<Expr> values);

Expr input_of(Model& model, int functional);
Expr substitute(Graph& graph, Expr e, const std::map<Expr, Expr>& by);

}  // namespace spacetime::symbolic
