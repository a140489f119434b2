// The value of expressions, computed node by node from the graph itself: the plainest evaluation there is, against
// which programs and derivatives are tested, and with which constant expressions are folded.
#pragma once

#include <cmath>
#include <span>
#include <type_traits>
#include <vector>

#include "common/program.h"
#include "symbolic/graph.h"

namespace spacetime::symbolic {

// What an operation means, for double and for every type that has its operators, comparisons and functions (dual
// numbers).  Ties and NaN go as in the interpreter's kernels.
template <class T>
T apply(Op op, const T& a, const T& b, const T& c) {
  using std::sqrt, std::sin, std::cos, std::tan, std::asin, std::acos, std::atan, std::atan2, std::sinh, std::cosh,
      std::tanh, std::exp, std::log, std::pow;
  const T zero(0.0), one(1.0);
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::negate:
      return -a;
    case Op::multiply_add:
      if constexpr (std::is_same_v<T, double>)
        return std::fma(a, b, c);
      else
        return a * b + c;
    case Op::absolute:
      return zero < a ? a : a < zero ? -a : a * zero;
    case Op::sign:
      return zero < a ? one : a < zero ? -one : zero;
    case Op::square_root:
      return sqrt(a);
    case Op::minimum:
      return b < a ? b : a;
    case Op::maximum:
      return a < b ? b : a;
    case Op::sine:
      return sin(a);
    case Op::cosine:
      return cos(a);
    case Op::tangent:
      return tan(a);
    case Op::arc_sine:
      return asin(a);
    case Op::arc_cosine:
      return acos(a);
    case Op::arc_tangent:
      return atan(a);
    case Op::arc_tangent2:
      return atan2(a, b);
    case Op::hyperbolic_sine:
      return sinh(a);
    case Op::hyperbolic_cosine:
      return cosh(a);
    case Op::hyperbolic_tangent:
      return tanh(a);
    case Op::exponential:
      return exp(a);
    case Op::logarithm:
      return log(a);
    case Op::power:
      return pow(a, b);
    case Op::less:
      return a < b ? one : zero;
    case Op::less_equal:
      return a < b || a == b ? one : zero;
    case Op::logical_and:
      return a != zero && b != zero ? one : zero;
    case Op::logical_or:
      return a != zero || b != zero ? one : zero;
    case Op::logical_not:
      return a != zero ? zero : one;
    case Op::select:
      return a != zero ? b : c;
  }
  return zero;
}

// The nodes that the roots need, marked by id.
std::vector<std::uint8_t> reachable(const Graph& graph, std::span<const Expr> roots);

// The values of `roots` where inputs[i] is the value of graph.inputs()[i].
template <class T>
std::vector<T> evaluate(const Graph& graph, std::span<const Expr> roots, std::span<const T> inputs) {
  const auto needed = reachable(graph, roots);
  std::vector<T> value(needed.size(), T(0.0));
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const auto& n = graph.node({id});
    switch (n.kind) {
      case Graph::Kind::number:
      case Graph::Kind::pi:
        value[id] = T(*graph.constant({id}));
        break;
      case Graph::Kind::input:
        value[id] = inputs[n.input];
        break;
      case Graph::Kind::operation:
        value[id] = apply<T>(n.op, value[n.a.id], value[n.b.id], value[n.c.id]);
        break;
    }
  }
  std::vector<T> result;
  for (const auto root : roots) result.push_back(value[root.id]);
  return result;
}

}  // namespace spacetime::symbolic
