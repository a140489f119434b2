// The functions of the language: one row each.
#pragma once

#include <string_view>
#include <vector>

#include "symbolic/model.h"

namespace spacetime::symbolic {

struct Function {
  std::string_view name;
  std::string_view usage;   // for messages
  std::size_t least, most;  // arguments
  // Applies it to arguments whose kinds have been seen to; reports what else is wrong with them.
  Value (*apply)(Model&, const Function&, const Node&, const std::vector<Value>&);
  Op op = Op::add;  // of those that are one operation
};

// Null where there is none.
const Function* function_named(std::string_view name);
std::vector<std::string> function_names();
// The function that is this one operation; null where none is.
const Function* function_of(Op op);

// Whether `value` is one number, reporting at `span` where it is not; quiet about lost ones.
bool need_scalar(Model& model, const Value& value, const Span& span, std::string_view what);
bool need_numbers(Model& model, const Value& value, const Span& span, std::string_view what);

}  // namespace spacetime::symbolic
