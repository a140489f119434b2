// The constructors' rules.  All hold for finite operands; where an operand may be zero the one liberty taken is
// 0/x = 0.  Normal forms, so that what is equal is one node:
//   sums       core + constant, a - b only with a older than b; multiples of pi float to the outside
//   products   number * core; signs stand outside products, quotients, differences and odd functions
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "symbolic/graph.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

constexpr double largest_exponent = 64;  // powers up to this become products: at most 11 of them

// sin(k pi), exact at multiples of a half and correctly rounded at sixths and quarters.
double sine_of_pi(double k) {
  double r = std::fmod(k, 2), sign = 1;
  if (r < 0) r = -r, sign = -1;
  if (r >= 1) r -= 1, sign = -sign;
  if (r > 0.5) r = 1 - r;
  if (r == 0) return 0;
  if (r == 0.5) return sign;
  if (r == 0.25) return sign * std::sqrt(0.5);
  if (std::fabs(6 * r - 1) < 1e-15) return sign * 0.5;
  return sign * (r > 0.25 ? std::cos(std::numbers::pi * (0.5 - r)) : std::sin(std::numbers::pi * r));
}

double cosine_of_pi(double k) { return sine_of_pi(std::fmod(k, 2) + 0.5); }

bool is_integer(double x) { return std::floor(x) == x; }

bool is_odd_function(Op op) {
  return op == Op::sine || op == Op::tangent || op == Op::arc_sine || op == Op::arc_tangent ||
         op == Op::hyperbolic_sine || op == Op::hyperbolic_tangent || op == Op::sign;
}

bool is_even_function(Op op) { return op == Op::cosine || op == Op::hyperbolic_cosine || op == Op::absolute; }

}  // namespace

bool Graph::is_condition(Expr e) const {
  const auto& n = node(e);
  return n.kind == Kind::operation && (n.op == Op::less || n.op == Op::less_equal || n.op == Op::logical_and ||
                                       n.op == Op::logical_or || n.op == Op::logical_not);
}

// The value of an operation on constants, where it is finite; multiples of pi stay such where they can.
std::optional<Expr> Graph::fold_constants(Op op, Expr a, Expr b, Expr c) {
  const auto is_pi = [&](Expr e) { return node(e).kind == Kind::pi; };
  const double ka = node(a).number, kb = node(b).number;
  const auto finite = [&](double value) { return std::isfinite(value) ? std::optional(number(value)) : std::nullopt; };
  const auto finite_pi = [&](double k) { return std::isfinite(k) ? std::optional(pi(k)) : std::nullopt; };
  switch (op) {
    case Op::add:
      if (is_pi(a) && is_pi(b)) return finite_pi(ka + kb);
      if (a == Expr{}) return b;
      if (b == Expr{}) return a;
      break;
    case Op::subtract:
      if (is_pi(a) && is_pi(b)) return finite_pi(ka - kb);
      if (b == Expr{}) return a;
      break;
    case Op::multiply:
      if (is_pi(a) != is_pi(b)) return finite_pi(ka * kb);
      break;
    case Op::divide:
      if (is_pi(a) && !is_pi(b)) return finite_pi(ka / kb);
      if (is_pi(a) && is_pi(b)) return finite(ka / kb);
      break;
    case Op::negate:
      if (is_pi(a)) return pi(-ka);
      break;
    case Op::absolute:
      if (is_pi(a)) return pi(std::fabs(ka));
      break;
    case Op::minimum:
      return *constant(b) < *constant(a) ? b : a;
    case Op::maximum:
      return *constant(b) > *constant(a) ? b : a;
    case Op::select:
      return a != Expr{} ? b : c;
    case Op::sine:
      if (is_pi(a)) return number(sine_of_pi(ka));
      break;
    case Op::cosine:
      if (is_pi(a)) return number(cosine_of_pi(ka));
      break;
    case Op::tangent:
      if (is_pi(a)) return finite(sine_of_pi(ka) / cosine_of_pi(ka));
      break;
    default:
      break;
  }
  return finite(apply<double>(op, *constant(a), *constant(b), *constant(c)));
}

Expr Graph::operation(Op op, Expr a, Expr b, Expr c) {
  switch (op) {
    case Op::add:
      return add(a, b);
    case Op::subtract:
      return subtract(a, b);
    case Op::multiply:
      return multiply(a, b);
    case Op::divide:
      return divide(a, b);
    case Op::negate:
      return negate(a);
    case Op::multiply_add:
      return add(multiply(a, b), c);
    case Op::sine:
      return sine(a);
    case Op::cosine:
      return cosine(a);
    case Op::tangent:
      return tangent(a);
    case Op::power:
      return power(a, b);
    case Op::less:
    case Op::less_equal:
      return comparison(op, a, b);
    case Op::logical_and:
    case Op::logical_or:
      return logical(op, a, b);
    case Op::select:
      return select(a, b, c);
    case Op::minimum:
    case Op::maximum:
      if (a == b) return a;
      [[fallthrough]];
    case Op::arc_tangent2:
      if (is_constant(a) && is_constant(b)) {
        if (const auto value = fold_constants(op, a, b, {})) return *value;
      }
      return make(op, a, b);
    default:
      return function(op, a);
  }
}

// A function of one operand.
Expr Graph::function(Op op, Expr a) {
  if (is_constant(a)) {
    if (const auto value = fold_constants(op, a, {}, {})) return *value;
    return make(op, a);
  }
  if (is_operation(a, Op::negate)) {
    if (is_odd_function(op)) return negate(function(op, node(a).a));
    if (is_even_function(op)) return function(op, node(a).a);
  }
  if (op == Op::logical_not) {
    if (is_operation(a, Op::logical_not) && is_condition(node(a).a)) return node(a).a;
  }
  if (op == Op::absolute && is_operation(a, Op::absolute)) return a;
  return make(op, a);
}

Expr Graph::negate(Expr a) {
  if (is_constant(a)) return *fold_constants(Op::negate, a, {}, {});
  if (is_operation(a, Op::negate)) return node(a).a;
  return make(Op::negate, a);
}

Expr Graph::add(Expr a, Expr b) {
  if (is_constant(a) && is_constant(b)) {
    if (const auto value = fold_constants(Op::add, a, b, {})) return *value;
    return make(Op::add, std::min(a, b), std::max(a, b));
  }
  if (a == Expr{}) return b;
  if (b == Expr{}) return a;

  // Constants: [+-](core + constant) on either side.
  struct Split {
    Expr core, constant;
  };
  const auto split = [&](Expr e) -> Split {
    if (is_constant(e)) return {{}, e};
    const bool negative = is_operation(e, Op::negate);
    const auto& n = node(negative ? node(e).a : e);
    if (n.kind != Kind::operation || n.op != Op::add || !is_constant(n.b)) return {e, {}};
    const Expr core = n.a, constant = n.b;
    return negative ? Split{negate(core), negate(constant)} : Split{core, constant};
  };
  const auto [core_a, constant_a] = split(a);
  const auto [core_b, constant_b] = split(b);
  const bool both = constant_a != Expr{} && constant_b != Expr{};
  const bool floats = node(constant_a).kind == Kind::pi || node(constant_b).kind == Kind::pi;
  if (core_a != Expr{} && core_b != Expr{} && (both || floats))
    return add(add(core_a, core_b), add(constant_a, constant_b));
  if (core_a == Expr{} || core_b == Expr{}) {
    if (both) return add(core_a == Expr{} ? core_b : core_a, add(constant_a, constant_b));
    const Expr core = core_a == Expr{} ? b : a, constant = core_a == Expr{} ? a : b;
    if (is_operation(core, Op::negate)) return negate(add(node(core).a, negate(constant)));
    return make(Op::add, core, constant);
  }

  // Signs.
  const bool minus_a = is_operation(a, Op::negate), minus_b = is_operation(b, Op::negate);
  if (minus_a && minus_b) return negate(add(node(a).a, node(b).a));
  if (minus_b) return subtract(a, node(b).a);
  if (minus_a) return subtract(b, node(a).a);

  // Multiples of the same, and the same multiple.
  const auto coefficient = [&](Expr e) { return is_operation(e, Op::multiply) && is_constant(node(e).a); };
  const Expr ka = coefficient(a) ? node(a).a : number(1), xa = coefficient(a) ? node(a).b : a;
  const Expr kb = coefficient(b) ? node(b).a : number(1), xb = coefficient(b) ? node(b).b : b;
  if (xa == xb) return multiply(add(ka, kb), xa);
  if (ka == kb && coefficient(a)) return multiply(ka, add(xa, xb));

  // (x - y) + y.
  if (is_operation(a, Op::subtract) && node(a).b == b) return node(a).a;
  if (is_operation(b, Op::subtract) && node(b).b == a) return node(b).a;
  return make(Op::add, std::min(a, b), std::max(a, b));
}

Expr Graph::subtract(Expr a, Expr b) {
  if (a == b) return {};
  const auto is_sum_with_constant = [&](Expr e) { return is_operation(e, Op::add) && is_constant(node(e).b); };
  const auto coefficient = [&](Expr e) { return is_operation(e, Op::multiply) && is_constant(node(e).a); };
  if (is_constant(a) || is_constant(b) || is_operation(a, Op::negate) || is_operation(b, Op::negate)) {
    if (is_constant(a) && is_constant(b)) {
      if (const auto value = fold_constants(Op::subtract, a, b, {})) return *value;
      return make(Op::subtract, a, b);
    }
    return add(a, negate(b));
  }
  if (is_sum_with_constant(a) || is_sum_with_constant(b)) {
    const Expr core_a = is_sum_with_constant(a) ? node(a).a : a, core_b = is_sum_with_constant(b) ? node(b).a : b;
    const Expr constant_a = is_sum_with_constant(a) ? node(a).b : Expr{};
    const Expr constant_b = is_sum_with_constant(b) ? node(b).b : Expr{};
    if ((constant_a != Expr{} && constant_b != Expr{}) || node(constant_a).kind == Kind::pi ||
        node(constant_b).kind == Kind::pi) {
      return add(subtract(core_a, core_b), subtract(constant_a, constant_b));
    }
  }
  const Expr ka = coefficient(a) ? node(a).a : number(1), xa = coefficient(a) ? node(a).b : a;
  const Expr kb = coefficient(b) ? node(b).a : number(1), xb = coefficient(b) ? node(b).b : b;
  if (xa == xb) return multiply(subtract(ka, kb), xa);
  if (ka == kb && coefficient(a)) return multiply(ka, subtract(xa, xb));

  // (x + y) - y, (x - y) - x, x - (x - y), y - (x + y).
  if (is_operation(a, Op::add) && node(a).a == b) return node(a).b;
  if (is_operation(a, Op::add) && node(a).b == b) return node(a).a;
  if (is_operation(b, Op::add) && node(b).a == a) return negate(node(b).b);
  if (is_operation(b, Op::add) && node(b).b == a) return negate(node(b).a);
  if (is_operation(a, Op::subtract) && node(a).a == b) return negate(node(a).b);
  if (is_operation(b, Op::subtract) && node(b).a == a) return node(b).b;
  if (b < a) return negate(make(Op::subtract, b, a));
  return make(Op::subtract, a, b);
}

// coefficient * e for a constant coefficient, which may be negative.
Expr Graph::scaled(Expr coefficient, Expr e) {
  if (node(coefficient).number < 0) return negate(scaled(negate(coefficient), e));
  if (is_number(coefficient, 1)) return e;
  if (is_constant(e)) {
    if (const auto value = fold_constants(Op::multiply, coefficient, e, {})) return *value;
    return make(Op::multiply, coefficient, e);
  }
  if (is_operation(e, Op::negate)) return negate(scaled(coefficient, node(e).a));
  const bool product = is_operation(e, Op::multiply), quotient = is_operation(e, Op::divide);
  if ((product || quotient) && is_constant(node(e).a) && !is_undefined(e)) {
    const Expr inner = node(e).a, rest = node(e).b;
    if (const auto value = fold_constants(Op::multiply, coefficient, inner, {})) {
      return product ? scaled(*value, rest) : divide(*value, rest);
    }
  }
  return make(Op::multiply, coefficient, e);
}

Expr Graph::multiply(Expr a, Expr b) {
  if ((a == Expr{} && !is_undefined(b)) || (b == Expr{} && !is_undefined(a))) return {};
  if (is_constant(a)) return scaled(a, b);
  if (is_constant(b)) return scaled(b, a);
  const bool minus_a = is_operation(a, Op::negate), minus_b = is_operation(b, Op::negate);
  if (minus_a || minus_b) {
    const Expr product = multiply(minus_a ? node(a).a : a, minus_b ? node(b).a : b);
    return minus_a == minus_b ? product : negate(product);
  }
  // Two numbers gather outside; a single one stays with its factor, where it is made once for many products.
  const auto is_scaled = [&](Expr e) { return is_operation(e, Op::multiply) && is_constant(node(e).a); };
  if (is_scaled(a) && is_scaled(b)) {
    const Expr k = scaled(node(a).a, node(b).a), x = node(a).b, y = node(b).b;
    return scaled(k, multiply(x, y));
  }
  return make(Op::multiply, std::min(a, b), std::max(a, b));
}

Expr Graph::divide(Expr a, Expr b) {
  if (is_constant(a) && is_constant(b)) {
    if (const auto value = fold_constants(Op::divide, a, b, {})) return *value;
    return make(Op::divide, a, b);
  }
  if (a == Expr{}) return {};
  if (const auto value = constant(b)) {
    const double reciprocal = 1 / *value;
    if (std::isnormal(reciprocal)) return multiply(number(reciprocal), a);
    return make(Op::divide, a, b);
  }
  const bool minus_a = is_operation(a, Op::negate), minus_b = is_operation(b, Op::negate);
  const bool negative_a = is_constant(a) && node(a).number < 0;
  if (minus_a || minus_b || negative_a) {
    const Expr quotient = divide(minus_a || negative_a ? negate(a) : a, minus_b ? node(b).a : b);
    return (minus_a || negative_a) == minus_b ? quotient : negate(quotient);
  }
  if (a == b && is_operation(a, Op::exponential)) return number(1);  // never 0
  return make(Op::divide, a, b);
}

Expr Graph::power(Expr a, Expr b) {
  if (is_constant(a) && is_constant(b)) {
    if (const auto value = fold_constants(Op::power, a, b, {})) return *value;
    return make(Op::power, a, b);
  }
  if (is_number(a, 1)) return a;
  if (is_number(b, 0.5)) return square_root(a);
  const auto exponent = constant(b);
  if (!exponent || !is_integer(*exponent) || std::fabs(*exponent) > largest_exponent) return make(Op::power, a, b);
  Expr result = number(1);
  for (auto n = static_cast<int>(std::fabs(*exponent)); n > 0; n /= 2, a = n > 0 ? multiply(a, a) : a) {
    if (n % 2 == 1) result = multiply(result, a);
  }
  return *exponent < 0 ? divide(number(1), result) : result;
}

// sin and cos of x + k pi with 2k whole are those of x.
Expr Graph::sine(Expr a) {
  if (is_operation(a, Op::negate)) return negate(sine(node(a).a));
  if (is_operation(a, Op::add) && node(node(a).b).kind == Kind::pi) {
    const double halves = std::fmod(2 * node(node(a).b).number, 4);
    const Expr x = node(a).a;
    if (halves == 1 || halves == -3) return cosine(x);
    if (halves == 2 || halves == -2) return negate(sine(x));
    if (halves == 3 || halves == -1) return negate(cosine(x));
    if (halves == 0) return sine(x);
  }
  return function(Op::sine, a);
}

Expr Graph::cosine(Expr a) {
  if (is_operation(a, Op::negate)) return cosine(node(a).a);
  if (is_operation(a, Op::add) && node(node(a).b).kind == Kind::pi) {
    const double halves = std::fmod(2 * node(node(a).b).number, 4);
    const Expr x = node(a).a;
    if (halves == 1 || halves == -3) return negate(sine(x));
    if (halves == 2 || halves == -2) return negate(cosine(x));
    if (halves == 3 || halves == -1) return sine(x);
    if (halves == 0) return cosine(x);
  }
  return function(Op::cosine, a);
}

Expr Graph::tangent(Expr a) {
  if (is_operation(a, Op::negate)) return negate(tangent(node(a).a));
  if (is_operation(a, Op::add) && node(node(a).b).kind == Kind::pi && is_integer(node(node(a).b).number)) {
    return tangent(node(a).a);
  }
  return function(Op::tangent, a);
}

Expr Graph::square_root(Expr a) { return function(Op::square_root, a); }

Expr Graph::comparison(Op op, Expr a, Expr b) {
  if (is_constant(a) && is_constant(b)) return *fold_constants(op, a, b, {});
  if (a == b) return number(op == Op::less_equal ? 1 : 0);
  return make(op, a, b);
}

Expr Graph::logical(Op op, Expr a, Expr b) {
  if (is_constant(b)) std::swap(a, b);
  if (is_constant(a)) {
    if (is_constant(b)) return *fold_constants(op, a, b, {});
    const bool decides = (a != Expr{}) == (op == Op::logical_or);
    if (decides) return number(op == Op::logical_or ? 1 : 0);
    if (is_condition(b)) return b;
  }
  if (a == b && is_condition(a)) return a;
  return make(op, std::min(a, b), std::max(a, b));
}

Expr Graph::select(Expr condition, Expr a, Expr b) {
  if (is_constant(condition)) return condition != Expr{} ? a : b;
  if (a == b) return a;
  if (is_operation(condition, Op::logical_not)) return select(node(condition).a, b, a);
  return make(Op::select, condition, a, b);
}

}  // namespace spacetime::symbolic
