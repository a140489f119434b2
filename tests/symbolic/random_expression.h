// Random expressions over every operation, kept as a plain list beside the graph's folded form, so that folding,
// differentiation and emission are all judged by what was written.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "symbolic/value.h"
#include "tests/symbolic/dual.h"

namespace spacetime::symbolic {

struct RawNode {
  bool is_input = false;
  int input = 0;      // which variable
  double number = 0;  // a literal where no operation
  bool is_operation = false;
  Op op = Op::add;
  std::array<int, 3> operand{};
  bool tame = true;  // well inside the domain of every function that was chosen
};

struct RandomExpression {
  std::vector<RawNode> raw;   // operands first; the last is the expression
  std::vector<Expr> expr;     // the same in the graph
  std::vector<double> point;  // values of the variables at which the expression and its derivatives are finite
  std::vector<Expr> variables;

  template <class T>
  std::vector<T> values(std::span<const T> at) const {
    std::vector<T> value;
    for (const auto& n : raw) {
      const auto [a, b, c] = n.operand;
      value.push_back(n.is_operation ? apply<T>(n.op, value[a], value[b], value[c])
                      : n.is_input   ? at[n.input]
                                     : T(n.number));
    }
    return value;
  }
  template <class T>
  T value(std::span<const T> at) const {
    return values<T>(at).back();
  }
};

class RandomExpressions {
 public:
  explicit RandomExpressions(std::uint64_t seed) : random_(seed) {}

  // An expression of about `operations` operations over `variables` degrees of freedom.  Where a function would be
  // outside its domain at the chosen point, it stands in the branch of an `if` that is not taken there.
  RandomExpression make(Graph& graph, int operations, int variables) {
    RandomExpression e;
    for (int i = 0; i < variables; ++i) {
      const Input input{
          .kind = InputKind::dof, .name = std::string(1, 'x').append(std::to_string(i)), .index = 0, .derivative = 0};
      e.variables.push_back(graph.input(input));
      e.point.push_back(uniform(-2, 2));
      push(graph, e, {.is_input = true, .input = i}, e.variables.back());
    }
    for (const double number : {0.0, 1.0, -1.0, 2.0, 0.5, -3.0, uniform(-2, 2)}) {
      push(graph, e, {.number = number}, graph.number(number));
    }
    for (const double multiple : {1.0, 0.5, -1.5, 1.0 / 6}) {
      push(graph, e, {.number = multiple * M_PI}, graph.pi(multiple));
    }
    while (operations > 0) operations -= grow(graph, e);
    // The sum of a few, so that most of what was made counts.
    int sum = pick(e);
    for (int i = 0; i < 4; ++i) {
      const int scaled = apply_op(graph, e, Op::multiply, {pick(e), pick(e), 0});
      if (std::fabs(value_[scaled]) < 100) sum = apply_op(graph, e, Op::add, {sum, scaled, 0});
    }
    apply_op(graph, e, Op::add, {sum, pick(e), 0});
    value_.clear();
    return e;
  }

  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int below(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }

 private:
  int push(Graph&, RandomExpression& e, RawNode node, Expr expr) {
    double value = node.number;
    if (node.is_input) value = e.point[node.input];
    if (node.is_operation) {
      const auto [a, b, c] = node.operand;
      value = apply<double>(node.op, value_[a], value_[b], value_[c]);
      node.tame = is_tame(node.op, value_[a], value_[b]);
      for (int k = 0; k < info(node.op).arity; ++k) {
        const bool chosen = node.op != Op::select || k == 0 || k == (value_[a] != 0 ? 1 : 2);
        if (chosen && !e.raw[node.operand[k]].tame) node.tame = false;
      }
    }
    e.raw.push_back(node);
    e.expr.push_back(expr);
    value_.push_back(value);
    return static_cast<int>(e.raw.size()) - 1;
  }

  int apply_op(Graph& graph, RandomExpression& e, Op op, std::array<int, 3> operand) {
    const auto expr = graph.operation(op, e.expr[operand[0]], e.expr[operand[1]], e.expr[operand[2]]);
    return push(graph, e, {.is_operation = true, .op = op, .operand = operand}, expr);
  }

  // A finite operand, a recent one more often than not, so that expressions get deep; none that is zero but for
  // rounding.
  int pick(const RandomExpression& e) {
    const int n = static_cast<int>(e.raw.size());
    for (;;) {
      const int i = below(2) == 0 ? below(n) : n - 1 - below(std::min(n, 6));
      const double size = std::fabs(value_[i]);
      if (e.raw[i].tame && (size == 0 || (size > 1e-6 && size < 50))) return i;
    }
  }

  // Whether an operation has finite value and derivatives at these operands, with some room.
  bool is_tame(Op op, double a, double b) {
    switch (op) {
      case Op::divide:
        return std::fabs(b) > 0.1;
      case Op::square_root:
      case Op::logarithm:
        return a > 0.1;
      case Op::arc_sine:
      case Op::arc_cosine:
        return std::fabs(a) < 0.9;
      case Op::tangent:
        return std::fabs(std::cos(a)) > 0.2;
      case Op::arc_tangent2:
        return a * a + b * b > 0.1;
      case Op::hyperbolic_sine:
      case Op::hyperbolic_cosine:
      case Op::exponential:
        return std::fabs(a) < 3;
      case Op::power:
        return a > 0.1 && std::fabs(b * std::log(a)) < 3;
      case Op::absolute:
      case Op::sign:
        return std::fabs(a) > 1e-3;
      case Op::minimum:
      case Op::maximum:
      case Op::less:
      case Op::less_equal:
        return std::fabs(a - b) > 1e-3;
      default:
        return true;
    }
  }

  // Adds one operation, or an `if` around one that is not tame; returns how many.
  int grow(Graph& graph, RandomExpression& e) {
    const auto op = static_cast<Op>(below(op_count));
    std::array<int, 3> operand{};
    for (int k = 0; k < info(op).arity; ++k) operand[k] = pick(e);
    if (is_tame(op, value_[operand[0]], value_[operand[1]])) {
      apply_op(graph, e, op, operand);
      return 1;
    }
    if (op == Op::less || op == Op::less_equal || op == Op::sign || op == Op::absolute || op == Op::minimum ||
        op == Op::maximum) {
      return 0;  // a kink too near: differences would step over it
    }
    const int wild = apply_op(graph, e, op, operand);
    const int wilder = apply_op(graph, e, Op::multiply, {wild, pick(e), 0});
    const int x = pick(e), y = pick(e);
    if (std::fabs(value_[x] - value_[y]) < 1e-3) return 2;
    const int condition = apply_op(graph, e, Op::less, {x, y, 0});
    const bool holds = value_[condition] != 0;
    const int tame = pick(e);
    apply_op(graph, e, Op::select, {condition, holds ? tame : wilder, holds ? wilder : tame});
    return 4;
  }

  std::mt19937_64 random_;
  std::vector<double> value_;
};

// What rounding may have done to each root: a running error bound, each operation good to four units in the last place.
inline std::vector<double> rounding_bounds(const Graph& graph, std::span<const Expr> roots,
                                           std::span<const double> inputs) {
  const auto needed = reachable(graph, roots);
  std::vector<double> value(needed.size()), error(needed.size());
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const auto& n = graph.node({id});
    if (n.kind == Graph::Kind::input) value[id] = inputs[n.input];
    if (const auto constant = graph.constant({id})) value[id] = *constant;
    if (n.kind != Graph::Kind::operation) continue;
    const std::array operand{n.a.id, n.b.id, n.c.id};
    const std::array at{value[n.a.id], value[n.b.id], value[n.c.id]};
    value[id] = apply<double>(n.op, at[0], at[1], at[2]);
    error[id] = 4 * std::numeric_limits<double>::epsilon() * std::fabs(value[id]);
    for (int k = 0; k < info(n.op).arity; ++k) {
      std::array<Dual<double>, 3> dual{Dual<double>(at[0]), Dual<double>(at[1]), Dual<double>(at[2])};
      dual[k].d = 1;
      const double slope = std::fabs(apply(n.op, dual[0], dual[1], dual[2]).d);
      if (slope != 0 && error[operand[k]] != 0) error[id] += slope * error[operand[k]];
    }
  }
  std::vector<double> result;
  for (const auto root : roots) result.push_back(error[root.id]);
  return result;
}

}  // namespace spacetime::symbolic
