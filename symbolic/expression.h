// From expressions of the tree to expressions of the graph.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "symbolic/model.h"
#include "symbolic/vector.h"

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
// Made of numbers, constants and parameters: what does not move.
std::optional<Expr> elaborate_still(Model& model, NodeId root, std::string_view what);
bool is_still(Model& model, Expr e, const Span& span, std::string_view what);
std::optional<Vector3> elaborate_still_vector(Model& model, NodeId root, std::string_view what);
// A whole number in [least, most].
struct Count {
  Expr expr;
  int value = 0;
};
std::optional<Count> elaborate_count(Model& model, NodeId root, std::string_view what, int least, int most);

// The constants that stand in it.
std::vector<std::string> constants_in(Model& model, Expr e);

// From here on the constants in it cannot be set, because `what` has built in their values.
void freeze(Model& model, Expr e, const Span& span, std::string_view what);

// As the problem stores it.
Quantity quantity(Model& model, Expr e);

// [lo, hi] of a degree of freedom or a parameter.
struct Bounds {
  Quantity lower, upper;
};
std::optional<Bounds> elaborate_bounds(Model& model, const Interval& bounds, std::optional<Fixed> start = {});

std::string text_of(double number);  // as messages write it

std::string article(const Value& value);  // "a scalar", "a tuple of 3"

}  // namespace spacetime::symbolic
