// A second, plain meaning of every operation, one number at a time, to hold the interpreter against.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/program.h"

namespace spacetime {

inline double scalar(Op op, double a, double b, double c) {
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
      return std::fma(a, b, c);
    case Op::absolute:
      return std::fabs(a);
    case Op::sign:
      return static_cast<double>((a > 0) - (a < 0));
    case Op::square_root:
      return std::sqrt(a);
    case Op::minimum:
      return a <= b || std::isunordered(a, b) ? a : b;
    case Op::maximum:
      return a >= b || std::isunordered(a, b) ? a : b;
    case Op::sine:
      return std::sin(a);
    case Op::cosine:
      return std::cos(a);
    case Op::tangent:
      return std::tan(a);
    case Op::arc_sine:
      return std::asin(a);
    case Op::arc_cosine:
      return std::acos(a);
    case Op::arc_tangent:
      return std::atan(a);
    case Op::arc_tangent2:
      return std::atan2(a, b);
    case Op::hyperbolic_sine:
      return std::sinh(a);
    case Op::hyperbolic_cosine:
      return std::cosh(a);
    case Op::hyperbolic_tangent:
      return std::tanh(a);
    case Op::exponential:
      return std::exp(a);
    case Op::logarithm:
      return std::log(a);
    case Op::power:
      return std::pow(a, b);
    case Op::less:
      return a < b;
    case Op::less_equal:
      return a <= b;
    case Op::logical_and:
      return a != 0 && b != 0;
    case Op::logical_or:
      return a != 0 || b != 0;
    case Op::logical_not:
      return a == 0;
    case Op::select:
      return a == 0 ? c : b;
  }
  return NAN;
}

// Every value of the program at one point.
inline std::vector<double> scalar(const Program& program, std::span<const double> inputs) {
  std::vector<double> v(inputs.begin(), inputs.end());
  v.insert(v.end(), program.numbers.begin(), program.numbers.end());
  for (std::size_t i = 0; i < program.op.size(); ++i) {
    v.push_back(scalar(program.op[i], v[program.a[i]], v[program.b[i]], v[program.c[i]]));
  }
  return v;
}

// The same bits; any NaN is as good as another.
inline bool same(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
}

// How many numbers lie between two of one sign; 0 where both are NaN.
inline double ulps(double x, double y) {
  if (same(x, y) || x == y) return 0;
  if (!std::isfinite(x) || !std::isfinite(y) || std::signbit(x) != std::signbit(y)) return INFINITY;
  return std::fabs(static_cast<double>(std::bit_cast<std::int64_t>(x) - std::bit_cast<std::int64_t>(y)));
}

// Whether every target rounds the operation once, as IEEE 754 has it; the others come from a library.
inline bool is_exact(Op op) { return op < Op::sine || op > Op::power; }

}  // namespace spacetime
