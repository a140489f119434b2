// Random straight-line programs of the kind mechanics gives, for tests and benchmarks: mostly sums and products, 2 %
// sines and cosines, every result of use, and all values of moderate size where the inputs are within [0.1, 0.9].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "common/program.h"

namespace spacetime {

inline Program random_program(int inputs, int operations, std::mt19937_64& random) {
  constexpr int window = 40;   // most operands are among this many newest values,
  constexpr int far = 1000;    // and some among this many
  constexpr double bound = 4;  // on the values
  struct Range {
    double low, high;
    double largest() const { return std::max(-low, high); }
  };
  const auto below = [&](std::size_t n) { return static_cast<std::int32_t>(random() % n); };

  Program program;
  program.numbers = {0.5, -1.5, 2, 3};
  std::vector<Range> value;
  for (int i = 0; i < inputs; ++i) {
    std::string name = "q";
    program.inputs.push_back({InputKind::dof, name += std::to_string(i), 0, 0});
    value.push_back({0.1, 0.9});
  }
  for (const double number : program.numbers) value.push_back({number, number});

  std::vector<std::int32_t> unused;
  const auto operand = [&]() -> std::int32_t {
    const auto dice = below(100), n = static_cast<std::int32_t>(value.size());
    if (unused.size() > 100) return unused[below(4)];
    if (dice < 10) return below(program.first_operation());
    return n - 1 - below(std::min(n, dice < 80 ? window : far));
  };
  while (static_cast<int>(program.op.size()) < operations) {
    const auto dice = below(1000);
    auto op = dice < 10    ? Op::sine
              : dice < 20  ? Op::cosine
              : dice < 40  ? Op::negate
              : dice < 50  ? Op::divide
              : dice < 180 ? Op::multiply_add
              : dice < 550 ? Op::multiply
              : dice < 850 ? Op::add
                           : Op::subtract;
    auto a = operand(), b = operand(), c = operand();
    const auto hull = [](std::initializer_list<double> corners) { return Range{std::min(corners), std::max(corners)}; };
    const auto x = value[a], y = value[b], z = value[c];
    const auto product = hull({x.low * y.low, x.low * y.high, x.high * y.low, x.high * y.high});
    if (op == Op::divide && y.low < 0.1 && y.high > -0.1) op = Op::multiply;
    auto result = op == Op::sine || op == Op::cosine ? Range{-1, 1}
                  : op == Op::negate                 ? Range{-x.high, -x.low}
                  : op == Op::multiply_add           ? Range{product.low + z.low, product.high + z.high}
                  : op == Op::multiply               ? product
                  : op == Op::add                    ? Range{x.low + y.low, x.high + y.high}
                  : op == Op::subtract               ? Range{x.low - y.high, x.high - y.low}
                                       : hull({x.low / y.low, x.low / y.high, x.high / y.low, x.high / y.high});
    if (result.largest() > bound) {
      op = Op::multiply;  // halve instead
      b = inputs;
      result = {x.low / 2, x.high / 2};
    }
    const int arity = info(op).arity;
    program.op.push_back(op);
    program.a.push_back(a);
    program.b.push_back(arity > 1 ? b : 0);
    program.c.push_back(arity > 2 ? c : 0);
    std::erase_if(unused, [&](auto v) { return v == a || (arity > 1 && v == b) || (arity > 2 && v == c); });
    unused.push_back(static_cast<std::int32_t>(value.size()));
    value.push_back(result);
  }
  program.values = unused;
  program.value_operations = program.jacobian_operations = operations;
  return program;
}

}  // namespace spacetime
