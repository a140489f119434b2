#include "symbolic/expression.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/nearest.h"
#include "symbolic/define.h"
#include "symbolic/derivative.h"
#include "symbolic/eliminate.h"
#include "symbolic/functions.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

using Kind = Node::Kind;

constexpr std::size_t largest_tuple = 10000;  // components; keeps tuples of tuples of tuples finite

Value numbers(std::vector<Expr> components) { return {Value::Kind::numbers, std::move(components)}; }
Value condition(Expr e) { return {Value::Kind::condition, {e}}; }

std::string symbol_of(Kind kind) {
  switch (kind) {
    case Kind::add:
      return "+";
    case Kind::subtract:
      return "-";
    case Kind::multiply:
      return "*";
    case Kind::divide:
      return "/";
    case Kind::power:
      return "^";
    case Kind::less:
      return "<";
    case Kind::less_equal:
      return "<=";
    case Kind::greater:
      return ">";
    case Kind::greater_equal:
      return ">=";
    case Kind::logical_and:
      return "and";
    case Kind::logical_or:
      return "or";
    default:
      return "not";
  }
}

Expr combine(Graph& graph, Kind kind, Expr a, Expr b) {
  switch (kind) {
    case Kind::add:
      return graph.add(a, b);
    case Kind::subtract:
      return graph.subtract(a, b);
    case Kind::multiply:
      return graph.multiply(a, b);
    case Kind::divide:
      return graph.divide(a, b);
    case Kind::power:
      return graph.power(a, b);
    case Kind::less:
      return graph.operation(Op::less, a, b);
    case Kind::less_equal:
      return graph.operation(Op::less_equal, a, b);
    case Kind::greater:
      return graph.operation(Op::less, b, a);
    case Kind::greater_equal:
      return graph.operation(Op::less_equal, b, a);
    case Kind::logical_and:
      return graph.operation(Op::logical_and, a, b);
    default:
      return graph.operation(Op::logical_or, a, b);
  }
}

// a + b, a - b by components; a * b, a / b with a scalar on one side (of `/` the right); a ^ b between scalars.
Value arithmetic(Model& model, const Node& node, const Value& a, const Value& b) {
  const std::string symbol = symbol_of(node.kind);
  if (!need_numbers(model, a, model.scene.nodes[node.operands[0]].span, "the left side of " + quoted(symbol)) ||
      !need_numbers(model, b, model.scene.nodes[node.operands[1]].span, "the right side of " + quoted(symbol)))
    return {};
  const std::size_t n = a.components.size(), m = b.components.size();
  const bool sum = node.kind == Kind::add || node.kind == Kind::subtract;
  const bool fits = sum                           ? n == m
                    : node.kind == Kind::multiply ? n == 1 || m == 1
                    : node.kind == Kind::divide   ? m == 1
                                                  : n == 1 && m == 1;
  if (!fits) {
    const std::string advice = node.kind == Kind::multiply ? ": write dot( , ) or cross( , ) for products of tuples"
                               : sum                       ? ": both sides must have as many components"
                                                           : ": both must be scalars";
    report(model, node.mark, quoted(symbol) + " cannot stand between " + article(a) + " and " + article(b) + advice);
    return {};
  }
  std::vector<Expr> out;
  for (std::size_t i = 0; i < std::max(n, m); ++i) {
    const Expr x = a.components[n == 1 ? 0 : i], y = b.components[m == 1 ? 0 : i];
    if (node.kind == Kind::divide && model.facts.known(y) == 0.0) {
      report(model, node.mark, "division by zero");
      return {};
    }
    out.push_back(combine(model.graph, node.kind, x, y));
  }
  return numbers(std::move(out));
}

Value compare(Model& model, const Node& node, const Value& a, const Value& b) {
  const std::string symbol = symbol_of(node.kind);
  if (!need_scalar(model, a, model.scene.nodes[node.operands[0]].span, "the left side of " + quoted(symbol)) ||
      !need_scalar(model, b, model.scene.nodes[node.operands[1]].span, "the right side of " + quoted(symbol)))
    return {};
  return condition(combine(model.graph, node.kind, a.components[0], b.components[0]));
}

Value logic(Model& model, const Node& node, const std::vector<const Value*>& operands) {
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (operands[i]->kind == Value::Kind::lost) return {};
    if (operands[i]->kind != Value::Kind::condition) {
      report(model, model.scene.nodes[node.operands[i]].span,
             quoted(symbol_of(node.kind)) + " stands with conditions, such as 't < 1', not with numbers");
      return {};
    }
  }
  if (node.kind == Kind::logical_not)
    return condition(model.graph.operation(Op::logical_not, operands[0]->components[0]));
  return condition(combine(model.graph, node.kind, operands[0]->components[0], operands[1]->components[0]));
}

Value prime(Model& model, const Node& node, const Value& operand) {
  model.work += 4.0 * static_cast<double>(operand.components.size() * model.graph.size());
  if (!need_numbers(model, operand, model.scene.nodes[node.operands[0]].span, "what is differentiated")) return {};
  std::vector<Expr> out;
  for (const Expr e : operand.components) {
    const auto derivative = time_derivative(model.graph, e);
    if (!derivative) {
      report(model, node.mark,
             "this needs a third time derivative of a trajectory, but trajectories have two: "
             "take away a prime");
      return {};
    }
    out.push_back(*derivative);
  }
  return numbers(std::move(out));
}

Value tuple(Model& model, const Node& node, const std::vector<const Value*>& operands) {
  std::vector<Expr> out;
  bool lost = false;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    lost = !need_numbers(model, *operands[i], model.scene.nodes[node.operands[i]].span, "a tuple's component") || lost;
    out.insert(out.end(), operands[i]->components.begin(), operands[i]->components.end());
    if (out.size() > largest_tuple) {
      report(model, node.mark, "a tuple has at most " + std::to_string(largest_tuple) + " components");
      return {};
    }
  }
  return lost ? Value{} : numbers(std::move(out));
}

Value member(Model& model, const Node& node, const Value& operand) {
  if (operand.kind == Value::Kind::lost) return {};
  if (operand.creature >= 0) {
    const auto [value, found] = creature_member(model, operand.creature, operand.joint, node.text, node.mark);
    if (found) return value;
  }
  if (!need_numbers(model, operand, model.scene.nodes[node.operands[0]].span, "what stands before the dot")) return {};
  const std::size_t index = node.text == "x" ? 0 : node.text == "y" ? 1 : node.text == "z" ? 2 : largest_tuple;
  if (operand.joint >= 0) {
    report(model, node.mark, "a degree of freedom has no member " + quoted(node.text) + ", only 'force'");
    return {};
  }
  if (index == largest_tuple) {
    report(model, node.mark, article(operand) + " has no " + quoted(node.text) + ": its components are .x .y .z");
    return {};
  }
  if (operand.components.size() == 1 || index >= operand.components.size()) {
    report(model, node.mark, article(operand) + " has no component '." + node.text + "'");
    return {};
  }
  return numbers({operand.components[index]});
}

Value call(Model& model, const Node& node, const std::vector<Value>& arguments) {
  for (const Value& argument : arguments)
    if (argument.kind == Value::Kind::lost) return {};
  const Function* function = function_named(node.text);
  if (!function) return call_defined(model, node, arguments);
  if (arguments.size() >= function->least && arguments.size() <= function->most)
    return function->apply(model, *function, node, arguments);
  report_arity(model, node, function->usage);
  return {};
}

Value meaning(Model& model, const Node& node, const std::vector<Value>& values, NodeId first) {
  std::vector<const Value*> operands;
  for (const NodeId id : node.operands) operands.push_back(&values[id - first]);
  switch (node.kind) {
    case Kind::missing:
    case Kind::list:
      return {};
    case Kind::number:
      return numbers({model.graph.number(node.number)});
    case Kind::name:
      return look_up(model, node.text, node.mark);
    case Kind::member:
      return member(model, node, *operands[0]);
    case Kind::prime:
      return prime(model, node, *operands[0]);
    case Kind::negate: {
      if (!need_numbers(model, *operands[0], node.span, "what '-' stands before")) return {};
      std::vector<Expr> out;
      for (const Expr e : operands[0]->components) out.push_back(model.graph.negate(e));
      return numbers(std::move(out));
    }
    case Kind::add:
    case Kind::subtract:
    case Kind::multiply:
    case Kind::divide:
    case Kind::power:
      return arithmetic(model, node, *operands[0], *operands[1]);
    case Kind::call: {
      std::vector<Value> arguments;
      for (const Value* operand : operands) arguments.push_back(*operand);
      return call(model, node, arguments);
    }
    case Kind::tuple:
      return tuple(model, node, operands);
    case Kind::less:
    case Kind::less_equal:
    case Kind::greater:
    case Kind::greater_equal:
      return compare(model, node, *operands[0], *operands[1]);
    case Kind::logical_and:
    case Kind::logical_or:
    case Kind::logical_not:
      return logic(model, node, operands);
  }
  return {};
}

// A scene can ask for more than any machine has: tuples of tuples, functions that call functions.  Units are about two
// nanoseconds, so that a few seconds are allowed, and nodes take 64 bytes.
constexpr double most_work = 1e9;
constexpr std::size_t most_nodes = 4'000'000;
constexpr double work_of_a_node = 200, work_of_a_component = 50;

bool can_go_on(Model& model, const Node& node) {
  if (model.work <= most_work && model.graph.size() <= most_nodes) return true;
  if (!model.overworked)
    report(model, node.span, "the scene's expressions are too large by here: make them of fewer components and calls");
  model.overworked = true;
  return false;
}

// "A constant expression that is not finite is an error."
bool is_finite(Model& model, const Node& node, const Value& value) {
  for (const Expr e : value.components) {
    const auto known = model.facts.known(e);
    if (!known || std::isfinite(*known)) continue;
    report(model, node.span, "this constant expression has no finite value");
    return false;
  }
  return true;
}

}  // namespace

std::string article(const Value& value) {
  if (value.kind == Value::Kind::condition) return "a condition";
  if (value.kind == Value::Kind::creature) return "a creature";
  return value.components.size() == 1 ? "a scalar" : "a tuple of " + std::to_string(value.components.size());
}

Value elaborate(Model& model, NodeId root) {
  const NodeId first = model.scene.nodes[root].first;
  std::vector<Value> values;
  for (NodeId id = first; id <= root; ++id) {
    const Node& node = model.scene.nodes[id];
    if (!can_go_on(model, node)) return {};
    Value value = meaning(model, node, values, first);
    if (!is_finite(model, node, value)) value = {};
    model.work += work_of_a_node + work_of_a_component * static_cast<double>(value.components.size());
    values.push_back(std::move(value));
  }
  note_uses(model, values.back().components, model.scene.nodes[root].span);
  return std::move(values.back());
}

std::optional<Expr> elaborate_scalar(Model& model, NodeId root, std::string_view what) {
  const Value value = elaborate(model, root);
  if (!need_scalar(model, value, model.scene.nodes[root].span, what)) return std::nullopt;
  return value.components[0];
}

std::optional<std::vector<Expr>> elaborate_numbers(Model& model, NodeId root, std::string_view what) {
  Value value = elaborate(model, root);
  if (!need_numbers(model, value, model.scene.nodes[root].span, what)) return std::nullopt;
  return std::move(value.components);
}

namespace {

std::string dependence(Model& model, Expr e) {
  return model.facts.moving(e)           ? "the motion"
         : model.facts.timed(e)          ? "time"
         : model.facts.has_functional(e) ? "a functional"
                                         : "a parameter, which is not known before the motion is";
}

}  // namespace

std::optional<Fixed> elaborate_fixed(Model& model, NodeId root, std::string_view what) {
  const auto e = elaborate_scalar(model, root, what);
  if (!e) return std::nullopt;
  if (const auto known = model.facts.known(*e)) return Fixed{*e, *known};
  report(model, model.scene.nodes[root].span,
         std::string(what) + " must be made of numbers and constants, but this depends on " + dependence(model, *e));
  return std::nullopt;
}

bool is_still(Model& model, Expr e, const Span& span, std::string_view what) {
  if (!model.facts.timed(e) && !model.facts.has_functional(e)) return true;
  report(model, span,
         std::string(what) + " must be made of numbers, constants and parameters, but this depends on " +
             dependence(model, e));
  return false;
}

std::optional<Expr> elaborate_still(Model& model, NodeId root, std::string_view what) {
  const auto e = elaborate_scalar(model, root, what);
  if (!e || !is_still(model, *e, model.scene.nodes[root].span, what)) return std::nullopt;
  return e;
}

std::optional<Vector3> elaborate_still_vector(Model& model, NodeId root, std::string_view what) {
  const auto components = elaborate_numbers(model, root, what);
  if (!components) return std::nullopt;
  const Span& span = model.scene.nodes[root].span;
  if (components->size() != 3) {
    report(model, span, std::string(what) + " has 3 components, but here are " + std::to_string(components->size()));
    return std::nullopt;
  }
  for (const Expr e : *components)
    if (!is_still(model, e, span, what)) return std::nullopt;
  return Vector3{(*components)[0], (*components)[1], (*components)[2]};
}

std::optional<Count> elaborate_count(Model& model, NodeId root, std::string_view what, int least, int most) {
  const auto number = elaborate_fixed(model, root, what);
  if (!number) return std::nullopt;
  if (number->value == std::floor(number->value) && number->value >= least && number->value <= most)
    return Count{number->expr, static_cast<int>(number->value)};
  report(model, model.scene.nodes[root].span,
         std::string(what) + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return std::nullopt;
}

void freeze(Model& model, Expr e, const Span& span, std::string_view what) {
  std::vector<Expr> pending{e};
  while (!pending.empty()) {
    const Expr next = pending.back();
    pending.pop_back();
    if (!model.facts.has_constant(next)) continue;
    for (const std::string& name : constants_in(model, next)) {
      if (!model.frozen.try_emplace(name, Frozen{span, std::string(what)}).second) continue;
      for (const auto& [constant, value] : model.constants)
        if (constant == name) pending.push_back(value);
    }
  }
}

std::vector<std::string> constants_in(Model& model, Expr e) {
  std::vector<std::string> out;
  if (!model.facts.has_constant(e)) return out;
  model.work += static_cast<double>(model.graph.size());
  const auto needed = reachable(model.graph, std::vector{e});
  for (std::uint32_t id = 0; id < needed.size(); ++id)
    if (needed[id] && model.graph.node({id}).kind == Graph::Kind::input &&
        model.graph.input_of({id}).kind == InputKind::constant)
      out.push_back(model.graph.input_of({id}).name);
  return out;
}

Quantity quantity(Model& model, Expr e) {
  if (!model.facts.has_constant(e)) return {*model.facts.known(e), {}, 0};
  return {0, add_program(model, std::vector{e}, Derivatives::none), 0};
}

std::optional<Bounds> elaborate_bounds(Model& model, const Interval& bounds, std::optional<Fixed> start) {
  const auto lower = elaborate_fixed(model, bounds.from, "a lower bound");
  const auto upper = elaborate_fixed(model, bounds.to, "an upper bound");
  if (!lower || !upper) return std::nullopt;
  if (!(lower->value < upper->value)) {
    report(model, bounds.span, "the upper bound must be greater than the lower one");
    return std::nullopt;
  }
  if (start && (start->value < lower->value || start->value > upper->value)) {
    report(model, bounds.span,
           "the start value " + text_of(start->value) + " lies outside these bounds: choose another start");
    return std::nullopt;
  }
  return Bounds{quantity(model, lower->expr), quantity(model, upper->expr)};
}

std::string text_of(double number) {
  char out[32];
  std::snprintf(out, sizeof out, "%.6g", number);
  return out;
}

}  // namespace spacetime::symbolic
