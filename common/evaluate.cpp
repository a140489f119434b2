#include "common/evaluate.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <numeric>
#include <string>
#include <utility>

#include "common/assert.h"
#include "common/diagnostic.h"
#include "common/evaluate_kernels.h"

namespace spacetime {
namespace {

constexpr std::int32_t nowhere = -1;

// One value that a depth writes: which, and to which row.
struct Output {
  std::int32_t value;
  std::uint32_t row;
};

std::vector<Output> outputs_of(const Program& program, Depth depth) {
  std::vector<Output> result;
  const auto add = [&](std::int32_t value) { result.push_back({value, static_cast<std::uint32_t>(result.size())}); };
  for (const auto value : program.values) add(value);
  if (depth >= Depth::jacobian) {
    for (const auto& entry : program.jacobian) add(entry.value);
  }
  if (depth >= Depth::hessian) {
    for (const auto& entry : program.hessian) add(entry.value);
  }
  return result;
}

std::int32_t operations_of(const Program& program, Depth depth) {
  switch (depth) {
    case Depth::values:
      return program.value_operations;
    case Depth::jacobian:
      return program.jacobian_operations;
    case Depth::hessian:
      break;
  }
  return static_cast<std::int32_t>(program.op.size());
}

// A prefix of the program, ready to run.  Inputs, numbers and the units below have the first slots for themselves, in
// this order; the results of operations share the others, each given back after its last use.
struct Prefix {
  std::vector<Instruction> instructions;
  std::size_t slots = 0, operations = 0, outputs = 0;
};

// Where multiply_add is one instruction of the machine, sums, differences, products and negations are run as one too:
// the result and its rounding are the same, the sign of a zero included, and the interpreter's branch is foreseen.
//   a + b = a 1 + b,  a - b = b (-1) + a,  a b = a b + (-0),  -a = a (-1) + (-0)
constexpr double units[] = {1, -1, -0.0};

Instruction as_multiply_add(Instruction i, std::uint32_t one, std::uint32_t minus_one, std::uint32_t minus_zero) {
  constexpr auto code = static_cast<std::uint32_t>(Op::multiply_add);
  switch (static_cast<Op>(i.code)) {
    case Op::add:
      return {code, i.d, i.a, one, i.b};
    case Op::subtract:
      return {code, i.d, i.b, minus_one, i.a};
    case Op::multiply:
      return {code, i.d, i.a, i.b, minus_zero};
    case Op::negate:
      return {code, i.d, i.a, minus_one, minus_zero};
    default:
      return i;
  }
}

Prefix prepare(const Program& program, Depth depth, bool fused) {
  const auto first = program.first_operation();
  const auto operations = operations_of(program, depth);

  // Unused operands are 0, which is never an operation's result: all three columns are treated alike.
  std::vector<std::int32_t> last_use(first + operations, nowhere);  // of each value, the last operation that reads it
  for (std::int32_t i = 0; i < operations; ++i) {
    for (const auto value : {program.a[i], program.b[i], program.c[i]}) last_use[value] = i;
  }
  std::fill_n(last_use.begin(), first, nowhere);  // inputs and numbers keep their slots

  auto outputs = outputs_of(program, depth);
  std::sort(outputs.begin(), outputs.end(), [](Output x, Output y) { return x.value < y.value; });
  Prefix prefix;
  prefix.operations = operations;
  prefix.outputs = outputs.size();
  prefix.slots = first + std::size(units);
  prefix.instructions.reserve(operations + outputs.size());
  const auto unit = static_cast<std::uint32_t>(first);

  std::vector<std::uint32_t> slot(first + operations), free;  // of each value; those given back
  std::iota(slot.begin(), slot.begin() + first, 0);
  auto output = outputs.begin();
  const auto store_up_to = [&](std::int32_t value) {  // as soon as it is computed, so that no slot waits
    for (; output != outputs.end() && output->value <= value; ++output) {
      prefix.instructions.push_back({store_code, output->row, slot[output->value]});
    }
  };
  store_up_to(first - 1);
  for (std::int32_t i = 0; i < operations; ++i) {
    const std::int32_t operands[] = {program.a[i], program.b[i], program.c[i]}, result = first + i;
    for (const auto value : operands) {  // the result may take the place of an operand
      if (last_use[value] != i) continue;
      free.push_back(slot[value]);
      last_use[value] = nowhere;  // given back once, where it is two operands
    }
    if (free.empty()) free.push_back(static_cast<std::uint32_t>(prefix.slots++));
    slot[result] = free.back();  // the one given back last is the likeliest to be in the cache
    free.pop_back();
    const Instruction plain{static_cast<std::uint32_t>(program.op[i]), slot[result], slot[operands[0]],
                            slot[operands[1]], slot[operands[2]]};
    prefix.instructions.push_back(fused ? as_multiply_add(plain, unit, unit + 1, unit + 2) : plain);
    store_up_to(result);
    if (last_use[result] == nowhere) free.push_back(slot[result]);
  }
  return prefix;
}

// Slots of one thread, aligned for the widest vectors; kept from run to run while it is of reasonable size.
class Scratch {
 public:
  static constexpr std::size_t reasonable = std::size_t{64} << 20;  // bytes

  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { release(); }

  double* reserve(std::size_t bytes) {
    if (bytes > bytes_) {
      release();
      slots_ = static_cast<double*>(::operator new(bytes, alignment));
      bytes_ = bytes;
    }
    return slots_;
  }
  void release() {
    ::operator delete(std::exchange(slots_, nullptr), alignment);
    bytes_ = 0;
  }

 private:
  static constexpr std::align_val_t alignment{64};
  double* slots_ = nullptr;
  std::size_t bytes_ = 0;
};

// The targets this machine runs, best first.
std::vector<Kernels> available_kernels() {
  std::vector<Kernels> result;
#ifdef SPACETIME_LIBMVEC
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    result.push_back(avx512_kernels());
  }
  if (v3) result.push_back(avx2_kernels());
#endif
  result.push_back(generic_kernels());
  return result;
}

Kernels kernels_named(std::string_view target) {
  std::string known;
  for (const auto& kernels : available_kernels()) {
    if (kernels.target == target) return kernels;
    known.append(known.empty() ? "" : ", ").append(kernels.target);
  }
  throw InputError("no evaluation target \"" + std::string(target) + "\": this machine runs " + known);
}

// What a run reads besides its prefix.
struct Source {
  std::span<const double> numbers;
  std::span<const double* const> inputs;
  std::span<const std::uint8_t> uniform;
};

// Samples [from, to) in blocks of `lanes`.
void run_blocks(const Prefix& prefix, RunBlock run_block, std::size_t lanes, const Source& source, double* slots,
                std::size_t from, std::size_t to, double* outputs, std::size_t stride) {
  if (from == to) return;
  double* next = slots;
  for (std::size_t i = 0; i < source.inputs.size(); ++i, next += lanes) {
    if (source.uniform[i]) std::fill_n(next, lanes, *source.inputs[i]);
  }
  for (const double number : source.numbers) next = std::fill_n(next, lanes, number);
  for (const double number : units) next = std::fill_n(next, lanes, number);
  for (std::size_t s = from; s < to; s += lanes) {
    const std::size_t valid = std::min(lanes, to - s);
    for (std::size_t i = 0; i < source.inputs.size(); ++i) {
      if (source.uniform[i]) continue;
      const double* const column = source.inputs[i] + s;
      std::fill(std::copy_n(column, valid, slots + i * lanes), slots + (i + 1) * lanes, column[valid - 1]);
    }
    const auto& instructions = prefix.instructions;
    run_block(instructions.data(), instructions.data() + instructions.size(), {slots, outputs + s, stride, valid});
  }
}

void run_prefix(const Prefix& prefix, const Kernels& kernels, const Source& source, std::size_t samples,
                double* outputs, std::size_t stride) {
  // Where slots in wide blocks would take unreasonable memory, all blocks are narrow: a few times the program's own.
  constexpr std::size_t rest_for_narrow = 24;  // up to so many left over are sooner done in narrow blocks
  const std::size_t rest = samples % wide;
  const bool huge = prefix.slots > Scratch::reasonable / (wide * sizeof(double));
  const std::size_t in_wide = huge ? 0 : rest > rest_for_narrow ? samples : samples - rest;

  thread_local Scratch scratch;
  double* const slots = scratch.reserve(prefix.slots * (in_wide > 0 ? wide : narrow) * sizeof(double));
  run_blocks(prefix, kernels.run_wide, wide, source, slots, 0, in_wide, outputs, stride);
  run_blocks(prefix, kernels.run_narrow, narrow, source, slots, in_wide, samples, outputs, stride);
  if (huge) scratch.release();
}

}  // namespace

struct Evaluator::Plan {
  std::vector<double> numbers;
  std::size_t inputs;
  Kernels kernels;
  std::array<Prefix, 3> prefixes;  // by Depth
};

Evaluator::Evaluator(const Program& program, std::string_view target) {
  SPACETIME_ASSERT(!validate(program));
  plan_ = std::make_unique<Plan>(Plan{program.numbers, program.inputs.size(), kernels_named(target), {}});
  for (const auto depth : {Depth::values, Depth::jacobian, Depth::hessian}) {
    plan_->prefixes[static_cast<int>(depth)] = prepare(program, depth, plan_->kernels.fused);
  }
}
Evaluator::~Evaluator() = default;
Evaluator::Evaluator(Evaluator&&) noexcept = default;
Evaluator& Evaluator::operator=(Evaluator&&) noexcept = default;

std::size_t Evaluator::outputs(Depth depth) const { return plan_->prefixes[static_cast<int>(depth)].outputs; }
std::size_t Evaluator::operations(Depth depth) const { return plan_->prefixes[static_cast<int>(depth)].operations; }

void Evaluator::run(Depth depth, std::size_t samples, std::span<const double* const> inputs,
                    std::span<const std::uint8_t> uniform, double* outputs, std::size_t stride) const {
  SPACETIME_ASSERT(inputs.size() == plan_->inputs && uniform.size() == plan_->inputs && stride >= samples);
  run_prefix(plan_->prefixes[static_cast<int>(depth)], plan_->kernels, {plan_->numbers, inputs, uniform}, samples,
             outputs, stride);
}

std::vector<double> evaluate_once(const Program& program, Depth depth, std::span<const double> inputs) {
  SPACETIME_ASSERT(!validate(program) && inputs.size() == program.inputs.size());
  const auto kernels = kernels_named(evaluation_target());
  const auto prefix = prepare(program, depth, kernels.fused);
  std::vector<const double*> columns;
  for (const double& input : inputs) columns.push_back(&input);
  const std::vector<std::uint8_t> uniform(inputs.size(), 1);
  std::vector<double> result(prefix.outputs);
  run_prefix(prefix, kernels, {program.numbers, columns, uniform}, 1, result.data(), 1);
  return result;
}

std::vector<std::string_view> evaluation_targets() {
  std::vector<std::string_view> result;
  for (const auto& kernels : available_kernels()) result.push_back(kernels.target);
  return result;
}

std::string_view evaluation_target() {
  static const std::string_view target = [] {
    const char* const wanted = std::getenv("SPACETIME_TARGET");
    return wanted ? kernels_named(wanted).target : available_kernels().front().target;
  }();
  return target;
}

}  // namespace spacetime
