// Statements: each function starts behind the statement's first word.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "symbolic/parse_expression.h"

namespace spacetime::symbolic {

using What = decltype(Statement::what);

// The parser of the statement that begins with a word; null where there is none.
using StatementParser = What (*)(Parsing&);
StatementParser declaration_parser(std::string_view word);  // parse_declaration.cpp
StatementParser action_parser(std::string_view word);       // parse_action.cpp

What parse_creature(Parsing& p);  // parse_creature.cpp
What parse_script(Parsing& p);    // parse_script.cpp

// Pieces that declarations and actions share (parse_declaration.cpp).
ConstrainDeclaration parse_constraint(Parsing& p,
                                      NodeId left);  // from behind the left side: relation, scope, when, weight
MinimizeDeclaration parse_objective(Parsing& p, NodeId value);  // from behind the functional
bool at_relation(const Parsing& p);
std::optional<ScopeClause> parse_scope(Parsing& p);
std::optional<WeightClause> parse_weight(Parsing& p);
NodeId parse_weight_value(Parsing& p, bool& infinite);
std::vector<Assignment> parse_assignments(Parsing& p);
std::optional<Interval> parse_bounds(Parsing& p);  // "[in [lo, hi]]"

// The words that items of a creature begin with.
inline constexpr std::array<std::string_view, 4> creature_words{"gravity", "link", "point", "force"};

// Reports a line that begins with a binary operator.
bool refuse_leading_operator(Parsing& p);

// "{ item; item }": runs `item` for each, recovering inside the braces.  Returns whether any was lost.  A word of
// `outer`, which begins items of the block around this one, shows that the closing brace is missing.
bool parse_braces(Parsing& p, std::string_view owner, void (*item)(Parsing&, void*), void* target,
                  std::span<const std::string_view> outer = {});

}  // namespace spacetime::symbolic
