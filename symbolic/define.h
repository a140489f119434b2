// Functions of the scene's own, and what calls of functions have in common.
#pragma once

#include <string_view>

#include "symbolic/model.h"

namespace spacetime::symbolic {

void elaborate_define(Model& model, const DefineDeclaration& declaration);

// The value of a call: the function's body with these in place of its arguments.
Value call_defined(Model& model, const Node& node, const std::vector<Value>& arguments);

// "'f' is written f(x, y), but has 1 argument here".
void report_arity(Model& model, const Node& node, std::string_view usage);

}  // namespace spacetime::symbolic
