#include "tests/protocol/random_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace spacetime::examples {

std::vector<double> random_knots(std::mt19937& random, double start, double end) {
  std::vector<double> inner;
  for (int i = below(random, 6); i > 0; --i)
    inner.push_back(start + (end - start) * std::ldexp(static_cast<double>(random()), -32));
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  std::erase_if(inner, [&](double t) { return t <= start || t >= end; });
  std::vector<double> knots(4, start);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), 4, end);
  return knots;
}

std::string random_name(std::mt19937& random, const char* prefix, std::size_t index) {
  static const char* const oddities[] = {"", "", "", ".x", " \"q\"", "\\", "/~", "ä€😀"};
  return prefix + std::to_string(index) + oddities[random() % std::size(oddities)];
}

double random_number(std::mt19937& random) {
  using Limits = std::numeric_limits<double>;
  switch (below(random, 10)) {
    case 0:
      return coin(random) ? 0.0 : -0.0;
    case 1:
      return coin(random) ? Limits::denorm_min() : -Limits::min() / 3;
    case 2:
      return coin(random) ? Limits::max() : 1e308;
    case 3:
      return below(random, 2000) - 1000;
    case 4:
      return std::ldexp(below(random, 1000), below(random, 80));  // integers, most beyond 64 bits
    case 5:
      return below(random, 2000) / 100.0;
    default:
      break;
  }
  for (;;) {
    const auto bits = std::uint64_t{random()} << 32 | random();
    if (const auto value = std::bit_cast<double>(bits); std::isfinite(value)) return value;
  }
}

Program random_program(std::mt19937& random, std::vector<Input> inputs, int operations) {
  Program program;
  std::vector<int> unknowns;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (is_unknown(inputs[i].kind)) unknowns.push_back(static_cast<int>(i));
  }
  program.inputs = std::move(inputs);
  const auto values = 1 + below(random, 3);
  const bool second = !unknowns.empty() && coin(random);
  if (second) {
    for (int i = 0; i < values; ++i) program.inputs.push_back(multiplier(i));
  }
  program.numbers.push_back(random_number(random));
  for (int i = below(random, 4); i > 0; --i) program.numbers.push_back(random_number(random));
  for (int i = 0; i < operations; ++i) {
    const auto own = program.value_count();
    const auto op = static_cast<Op>(below(random, op_count));
    std::int32_t operands[3] = {0, 0, 0};
    for (int k = 0; k < info(op).arity; ++k) operands[k] = below(random, own);
    push(program, op, operands[0], operands[1], operands[2]);
  }
  program.value_operations = below(random, operations + 1);
  program.jacobian_operations = program.value_operations + below(random, operations + 1 - program.value_operations);
  const auto first = program.first_operation();
  for (int i = 0; i < values; ++i) program.values.push_back(below(random, first + program.value_operations));
  for (int row = 0; row < values; ++row) {
    for (const int input : unknowns) {
      if (coin(random)) program.jacobian.push_back({row, input, below(random, first + program.jacobian_operations)});
    }
  }
  for (const int row : unknowns) {
    for (const int column : unknowns) {
      if (second && column <= row && coin(random)) {
        program.hessian.push_back({row, column, below(random, program.value_count())});
      }
    }
  }
  return program;
}

}  // namespace spacetime::examples
