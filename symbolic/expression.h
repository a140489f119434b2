// From expressions of the tree to expressions of the graph.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "symbolic/model.h"

namespace spacetime::symbolic {

// The meaning of an expression; lost where something is wrong with it, which has then been reported.
Value elaborate(Model& model, NodeId root);

// One number.  `what` names it in messages: "the step".
std::optional<Expr> elaborate_scalar(Model& model, NodeId root, std::string_view what);
// The components of a scalar or tuple.
std::optional<std::vector<Expr>> elaborate_numbers(Model& model, NodeId root, std::string_view what);

// Made of numbers and constants alone: the expression and its value now.
struct Fixed {
  Expr expr;
  double value = 0;
};
std::optional<Fixed> elaborate_fixed(Model& model, NodeId root, std::string_view what);
std::optional<std::vector<Fixed>> elaborate_fixed_tuple(Model& model, NodeId root, std::size_t size,
                                                        std::string_view what);
// A whole number in [least, most], frozen.
std::optional<int> elaborate_count(Model& model, NodeId root, std::string_view what, int least, int most);

// As the problem stores it.
Quantity quantity(Model& model, Expr e);

std::string article(const Value& value);  // "a scalar", "a tuple of 3"

}  // namespace spacetime::symbolic
