#include "common/evaluate.h"

#include <cmath>

#include "common/assert.h"

namespace spacetime {
namespace {

double apply(Op op, double a, double b, double c) {
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
      return a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0;
    case Op::square_root:
      return std::sqrt(a);
    case Op::minimum:
      return b < a ? b : a;
    case Op::maximum:
      return b > a ? b : a;
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
      return a < b ? 1.0 : 0.0;
    case Op::less_equal:
      return a <= b ? 1.0 : 0.0;
    case Op::logical_and:
      return a != 0 && b != 0 ? 1.0 : 0.0;
    case Op::logical_or:
      return a != 0 || b != 0 ? 1.0 : 0.0;
    case Op::logical_not:
      return a != 0 ? 0.0 : 1.0;
    case Op::select:
      return a != 0 ? b : c;
  }
  SPACETIME_ASSERT(!"an operation of the enumeration");
  return 0;
}

}  // namespace

struct Evaluator::Plan {
  Program program;
};

Evaluator::Evaluator(const Program& program) : plan_(std::make_unique<Plan>(Plan{program})) {
  SPACETIME_ASSERT(!validate(program));
}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

std::size_t Evaluator::outputs(Depth depth) const {
  const auto& program = plan_->program;
  std::size_t count = program.values.size();
  if (depth >= Depth::jacobian) count += program.jacobian.size();
  if (depth >= Depth::hessian) count += program.hessian.size();
  return count;
}

std::size_t Evaluator::operations(Depth depth) const {
  const auto& program = plan_->program;
  switch (depth) {
    case Depth::values:
      return program.value_operations;
    case Depth::jacobian:
      return program.jacobian_operations;
    case Depth::hessian:
      break;
  }
  return program.op.size();
}

void Evaluator::run(Depth depth, std::size_t samples, std::span<const double* const> inputs,
                    std::span<const std::uint8_t> uniform, double* outputs, std::size_t stride) const {
  const auto& program = plan_->program;
  SPACETIME_ASSERT(inputs.size() == program.inputs.size() && uniform.size() == inputs.size() && stride >= samples);
  std::vector<double> v(program.value_count());
  for (std::size_t s = 0; s < samples; ++s) {
    auto* next = v.data();
    for (std::size_t i = 0; i < inputs.size(); ++i) *next++ = inputs[i][uniform[i] ? 0 : s];
    for (const double number : program.numbers) *next++ = number;
    for (std::size_t i = 0; i < operations(depth); ++i) {
      *next++ = apply(program.op[i], v[program.a[i]], v[program.b[i]], v[program.c[i]]);
    }
    auto* out = outputs + s;
    const auto write = [&](std::int32_t value) { *out = v[value], out += stride; };
    for (const auto value : program.values) write(value);
    if (depth >= Depth::jacobian) {
      for (const auto& entry : program.jacobian) write(entry.value);
    }
    if (depth >= Depth::hessian) {
      for (const auto& entry : program.hessian) write(entry.value);
    }
  }
}

std::vector<double> evaluate_once(const Program& program, Depth depth, std::span<const double> inputs) {
  const Evaluator evaluator(program);
  std::vector<const double*> pointers(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) pointers[i] = &inputs[i];
  const std::vector<std::uint8_t> uniform(inputs.size(), 1);
  std::vector<double> result(evaluator.outputs(depth));
  evaluator.run(depth, 1, pointers, uniform, result.data(), 1);
  return result;
}

std::string_view evaluation_target() { return "generic"; }

}  // namespace spacetime
