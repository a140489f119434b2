#include "symbolic/define.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/nearest.h"
#include "symbolic/expression.h"
#include "symbolic/functions.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

constexpr std::size_t most_notes = 3;  // of calls on the way to a mistake, the outermost left out
constexpr int deepest_calls = 64;      // of functions that call functions: far from the end of the stack

bool declare_arguments(Model& model, const DefineDeclaration& declaration) {
  const std::size_t mistakes = model.diagnostics.size();
  std::map<std::string, Span> seen;
  for (const Name& argument : declaration.parameters) {
    const auto symbol = model.symbols.find(argument.text);
    if (is_reserved(argument.text))
      report(model, argument.span, quoted(argument.text) + " is reserved: choose another name");
    else if (argument.text == declaration.name.text)
      report(model, argument.span, "an argument cannot have the function's name: choose another name");
    else if (symbol != model.symbols.end() && symbol->second.declared)
      report(model, argument.span,
             quoted(argument.text) + " is declared already, and an argument does not hide it: choose another name",
             {{symbol->second.span, "it is declared here"}});
    const auto [it, fresh] = seen.try_emplace(argument.text, argument.span);
    if (!fresh)
      report(model, argument.span, quoted(argument.text) + " is declared twice: choose another name",
             {{it->second, "it is declared first here"}});
  }
  return model.diagnostics.size() == mistakes;
}

// What other languages call them.
using Alias = std::pair<std::string_view, std::string_view>;
constexpr std::array<Alias, 7> called_otherwise{{{"ln", "the natural logarithm is log(x)"},
                                                 {"pow", "a power is written a^b"},
                                                 {"arcsin", "write asin(x)"},
                                                 {"arccos", "write acos(x)"},
                                                 {"arctan", "write atan(x)"},
                                                 {"fabs", "write abs(x)"},
                                                 {"sgn", "write sign(x)"}}};

void unknown_function(Model& model, const Node& node) {
  std::vector<std::string> names = function_names();
  for (const auto& [name, function] : model.functions) names.push_back(name);
  const auto symbol = model.symbols.find(node.text);
  const auto other = std::ranges::find(called_otherwise, node.text, &Alias::first);
  if (symbol == model.symbols.end() && other != called_otherwise.end())
    report(model, node.mark, "there is no function " + quoted(node.text) + ": " + std::string(other->second));
  else if (symbol == model.symbols.end())
    report(
        model, node.mark,
        "there is no function " + quoted(node.text) + suggestion(node.text, names, "declare it first, with 'define'"));
  else if (symbol->second.kind != Symbol::Kind::lost)
    report(model, node.mark, quoted(node.text) + " is no function: write '*' for a product");
}

// The names in a body, before anything is known of its arguments.
bool check_body(Model& model, const Defined& function) {
  const std::size_t mistakes = model.diagnostics.size();
  std::map<std::string, Value> arguments;
  for (const std::string& argument : function.arguments) arguments.try_emplace(argument);
  for (NodeId id = model.scene.nodes[function.body].first; id <= function.body; ++id) {
    const Node& node = model.scene.nodes[id];
    const bool known = function_named(node.text) || model.functions.contains(node.text);
    if (node.kind == Node::Kind::name && !arguments.contains(node.text)) look_up(model, node.text, node.mark);
    if (node.kind == Node::Kind::call && !known) unknown_function(model, node);
  }
  return model.diagnostics.size() == mistakes;
}

std::string usage_of(const std::string& name, const Defined& function) {
  std::string out = name + "(";
  for (std::size_t i = 0; i < function.arguments.size(); ++i) out += (i > 0 ? ", " : "") + function.arguments[i];
  return out + ")";
}

}  // namespace

void elaborate_define(Model& model, const DefineDeclaration& declaration) {
  Defined function;
  function.body = declaration.value;
  for (const Name& argument : declaration.parameters) function.arguments.push_back(argument.text);
  function.lost = !declare_arguments(model, declaration) || !check_body(model, function);
  Symbol symbol;
  symbol.kind = Symbol::Kind::function;
  declare(model, declaration.name, symbol);
  model.functions.try_emplace(declaration.name.text, std::move(function));
}

Value call_defined(Model& model, const Node& node, const std::vector<Value>& arguments) {
  const auto found = model.functions.find(node.text);
  if (found == model.functions.end()) return unknown_function(model, node), Value{};
  Defined& function = found->second;
  if (function.lost) return {};
  if (arguments.size() != function.arguments.size())
    return report_arity(model, node, usage_of(node.text, function)), Value{};
  if (model.calls == deepest_calls) {
    report(model, node.mark,
           "functions call one another more than " + std::to_string(deepest_calls) +
               " deep here: give a part of this a name with 'let'");
    return {};
  }
  std::map<std::string, Value> bound;
  for (std::size_t i = 0; i < arguments.size(); ++i) bound.try_emplace(function.arguments[i], arguments[i]);
  const std::size_t mistakes = model.diagnostics.size();
  const auto* outer = model.arguments;
  model.arguments = &bound;
  ++model.calls;
  Value out = elaborate(model, function.body);
  --model.calls;
  model.arguments = outer;
  if (model.diagnostics.size() == mistakes) return out;
  function.lost = true;
  auto& notes = model.diagnostics[mistakes].notes;
  if (notes.size() < most_notes || model.calls == 0)
    notes.push_back({node.mark, quoted(node.text) + " is called here"});
  return {};
}

void report_arity(Model& model, const Node& node, std::string_view usage) {
  const std::size_t n = node.operands.size();
  report(model, node.mark,
         quoted(node.text) + " is written " + std::string(usage) + ", but has " + std::to_string(n) +
             (n == 1 ? " argument here" : " arguments here"));
}

}  // namespace spacetime::symbolic
