#include "symbolic/functions.h"

#include <array>

#include "symbolic/eliminate.h"
#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

using Arguments = std::vector<Value>;

Value numbers(std::vector<Expr> components) { return {Value::Kind::numbers, std::move(components)}; }

const Span& span_of(const Model& model, const Node& node, std::size_t argument) {
  return model.scene.nodes[node.operands[argument]].span;
}

std::string ordinal(std::size_t argument, std::string_view name) {
  static constexpr std::array<std::string_view, 3> words{"first", "second", "third"};
  return "the " + std::string(words[argument]) + " argument of " + quoted(name);
}

bool scalars(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  bool good = true;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    good = need_scalar(model, arguments[i], span_of(model, node, i), ordinal(i, function.name)) && good;
  return good;
}

Value one_operation(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (!scalars(model, function, node, arguments)) return {};
  const Expr a = arguments[0].components[0];
  const Expr b = arguments.size() > 1 ? arguments[1].components[0] : Expr{};
  return numbers({model.graph.operation(function.op, a, b)});
}

// Degrees to radians; pi stays exact.
Value degrees(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (!scalars(model, function, node, arguments)) return {};
  Graph& graph = model.graph;
  return numbers({graph.divide(graph.multiply(arguments[0].components[0], graph.pi()), graph.number(180))});
}

bool vectors(Model& model, const Function& function, const Node& node, const Arguments& arguments, std::size_t size) {
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!need_numbers(model, arguments[i], span_of(model, node, i), ordinal(i, function.name))) return false;
    const std::size_t expected = size ? size : arguments[0].components.size();
    if (arguments[i].components.size() == expected) continue;
    report(model, span_of(model, node, i),
           size ? quoted(function.name) + " takes tuples of " + std::to_string(size) + ", but this is " +
                      article(arguments[i])
                : quoted(function.name) + " takes tuples of one length, but these are " + article(arguments[0]) +
                      " and " + article(arguments[i]));
    return false;
  }
  return true;
}

Expr dot_product(Graph& graph, const std::vector<Expr>& a, const std::vector<Expr>& b) {
  Expr sum = graph.number(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum = graph.add(sum, graph.multiply(a[i], b[i]));
  return sum;
}

Value dot(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (!vectors(model, function, node, arguments, 0)) return {};
  return numbers({dot_product(model.graph, arguments[0].components, arguments[1].components)});
}

Value norm(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (!vectors(model, function, node, arguments, 0)) return {};
  const auto& a = arguments[0].components;
  return numbers({model.graph.square_root(dot_product(model.graph, a, a))});
}

Value cross(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (!vectors(model, function, node, arguments, 3)) return {};
  const auto &a = arguments[0].components, &b = arguments[1].components;
  Graph& graph = model.graph;
  std::vector<Expr> out;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    out.push_back(graph.subtract(graph.multiply(a[j], b[k]), graph.multiply(a[k], b[j])));
  }
  return numbers(std::move(out));
}

Value choice(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  if (arguments[0].kind != Value::Kind::condition) {
    report(model, span_of(model, node, 0),
           "the first argument of 'if' is a condition, such as 't < 1', but this is " + article(arguments[0]));
    return {};
  }
  for (std::size_t i = 1; i < 3; ++i)
    if (!need_numbers(model, arguments[i], span_of(model, node, i), ordinal(i, function.name))) return {};
  const auto &a = arguments[1].components, &b = arguments[2].components;
  if (a.size() != b.size()) {
    report(model, span_of(model, node, 2),
           "both choices of 'if' must have as many components, but these are " + article(arguments[1]) + " and " +
               article(arguments[2]));
    return {};
  }
  std::vector<Expr> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(model.graph.select(arguments[0].components[0], a[i], b[i]));
  return numbers(std::move(out));
}

// A tuple's functional is the tuple of its components' functionals.
Value of_components(Model& model, const Node& node, FunctionalUse use, const std::vector<Expr>& components) {
  note_uses(model, components, node.span);
  std::vector<Expr> out;
  for (const Expr e : components) {
    use.integrand = e;
    out.push_back(functional(model, use));
  }
  return numbers(std::move(out));
}

std::optional<Expr> time_argument(Model& model, const Function& function, const Node& node, const Arguments& arguments,
                                  std::size_t i) {
  const Span& span = span_of(model, node, i);
  if (!need_scalar(model, arguments[i], span, ordinal(i, function.name))) return std::nullopt;
  const Expr e = arguments[i].components[0];
  const auto known = model.facts.known(e);
  if (!known) {
    report(model, span,
           ordinal(i, function.name) + " is a time: it must be made of numbers and constants" +
               (model.facts.has_parameter(e) ? ", not of a parameter" : ""));
    return std::nullopt;
  }
  model.time_checks.push_back({span, *known, "this time"});
  return e;
}

Value integral(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  FunctionalUse use;
  if (!need_numbers(model, arguments[0], span_of(model, node, 0), ordinal(0, function.name))) return {};
  if (arguments.size() == 2) {
    report(model, node.mark,
           "'integral' has one argument for the whole time, or three: " + std::string(function.usage));
    return {};
  }
  if (arguments.size() == 3) {
    use.from = time_argument(model, function, node, arguments, 1);
    use.to = time_argument(model, function, node, arguments, 2);
    if (!use.from || !use.to) return {};
    if (*model.facts.known(*use.from) >= *model.facts.known(*use.to)) {
      report(model, span_of(model, node, 2), "an integral's second time must be later than its first");
      return {};
    }
  }
  return of_components(model, node, use, arguments[0].components);
}

Value at(Model& model, const Function& function, const Node& node, const Arguments& arguments) {
  FunctionalUse use;
  use.kind = Functional::Kind::at;
  if (!need_numbers(model, arguments[0], span_of(model, node, 0), ordinal(0, function.name))) return {};
  use.from = time_argument(model, function, node, arguments, 1);
  if (!use.from) return {};
  return of_components(model, node, use, arguments[0].components);
}

constexpr std::array<Function, 24> table{{
    {"sin", "sin(x)", 1, 1, one_operation, Op::sine},
    {"cos", "cos(x)", 1, 1, one_operation, Op::cosine},
    {"tan", "tan(x)", 1, 1, one_operation, Op::tangent},
    {"asin", "asin(x)", 1, 1, one_operation, Op::arc_sine},
    {"acos", "acos(x)", 1, 1, one_operation, Op::arc_cosine},
    {"atan", "atan(x)", 1, 1, one_operation, Op::arc_tangent},
    {"sinh", "sinh(x)", 1, 1, one_operation, Op::hyperbolic_sine},
    {"cosh", "cosh(x)", 1, 1, one_operation, Op::hyperbolic_cosine},
    {"tanh", "tanh(x)", 1, 1, one_operation, Op::hyperbolic_tangent},
    {"exp", "exp(x)", 1, 1, one_operation, Op::exponential},
    {"log", "log(x)", 1, 1, one_operation, Op::logarithm},
    {"sqrt", "sqrt(x)", 1, 1, one_operation, Op::square_root},
    {"abs", "abs(x)", 1, 1, one_operation, Op::absolute},
    {"sign", "sign(x)", 1, 1, one_operation, Op::sign},
    {"atan2", "atan2(y, x)", 2, 2, one_operation, Op::arc_tangent2},
    {"min", "min(a, b)", 2, 2, one_operation, Op::minimum},
    {"max", "max(a, b)", 2, 2, one_operation, Op::maximum},
    {"deg", "deg(x)", 1, 1, degrees, Op::add},
    {"if", "if(condition, a, b)", 3, 3, choice, Op::add},
    {"dot", "dot(u, v)", 2, 2, dot, Op::add},
    {"norm", "norm(u)", 1, 1, norm, Op::add},
    {"cross", "cross(u, v)", 2, 2, cross, Op::add},
    {"integral", "integral(x) or integral(x, from, to)", 1, 3, integral, Op::add},
    {"at", "at(x, time)", 2, 2, at, Op::add},
}};

}  // namespace

const Function* function_named(std::string_view name) {
  for (const Function& function : table)
    if (function.name == name) return &function;
  return nullptr;
}

const Function* function_of(Op op) {
  for (const Function& function : table)
    if (function.apply == one_operation && function.op == op) return &function;
  return nullptr;
}

std::vector<std::string> function_names() {
  std::vector<std::string> out;
  for (const Function& function : table) out.emplace_back(function.name);
  return out;
}

bool need_numbers(Model& model, const Value& value, const Span& span, std::string_view what) {
  if (value.kind == Value::Kind::lost) return false;
  if (value.kind == Value::Kind::numbers) return true;
  const std::string advice = value.kind == Value::Kind::creature
                                 ? ": name one of its members, such as " +
                                       model.creatures[static_cast<std::size_t>(value.creature)].name + ".q"
                                 : ": write if(condition, 1, 0) for a number made from one";
  report(model, span, std::string(what) + " must be a number or a tuple, but this is " + article(value) + advice);
  return false;
}

bool need_scalar(Model& model, const Value& value, const Span& span, std::string_view what) {
  if (!need_numbers(model, value, span, what)) return false;
  if (value.components.size() == 1) return true;
  report(model, span, std::string(what) + " must be a single number, but this is " + article(value));
  return false;
}

}  // namespace spacetime::symbolic
