// Expressions, by precedence climbing:  ' .  then ^  then unary -  then * /  then + -  then relations, not, and, or.
#pragma once

#include <string_view>
#include <vector>

#include "symbolic/scene.h"
#include "symbolic/token_reader.h"

namespace spacetime::symbolic {

// What the parsing functions share.
struct Parsing {
  TokenReader in;
  Scene& scene;
  int depth = 0;  // of nested brackets, signs and powers here
};

// Brackets (and signs, exponents) may nest this deep: more than anyone writes, and far from the end of the stack.
inline constexpr int deepest_nesting = 256;

// Sums, products and so on, but no relation at its top: what stands on either side of one.
NodeId parse_sum(Parsing& p);
// Anything an expression can be, conditions too.
NodeId parse_condition(Parsing& p);
// "[a, b]".
Interval parse_interval(Parsing& p);
// "[p0, p1, ...]" as a list node.
NodeId parse_list(Parsing& p);
// "a, b, c".
std::vector<NodeId> parse_sums(Parsing& p);
// A plain name, or one with dots where `dotted`.
Name parse_name(Parsing& p, std::string_view what, bool dotted = false);
// "a, b.c, d".
std::vector<Name> parse_names(Parsing& p);

NodeId add_node(Scene& scene, Node node);
Span join(const Span& a, const Span& b);

}  // namespace spacetime::symbolic
