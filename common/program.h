// A program: the straight-line list of operations that the symbolic side emits for one statement and the
// optimizer evaluates at many times at once.  It is data: it is validated before use and can only compute.
//
// Values are numbered: first the inputs, then the literal numbers, then one value for each operation.  An
// operand's index is always below that of the value it helps to make, so running the columns once from top to
// bottom computes everything.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spacetime {

// The instruction set.  The table in program.cpp gives each its name in documents, its number of operands and its
// meaning; adding an operation is adding a row there, a loop in evaluate_kernels.inl and a rule in
// symbolic/derivative.cpp.
// clang-format off
enum class Op : std::uint8_t {
  add, subtract, multiply, divide, negate, multiply_add,  // multiply_add: a*b + c, rounded once
  absolute, sign, square_root, minimum, maximum,
  sine, cosine, tangent, arc_sine, arc_cosine, arc_tangent, arc_tangent2,
  hyperbolic_sine, hyperbolic_cosine, hyperbolic_tangent, exponential, logarithm, power,
  less, less_equal, logical_and, logical_or, logical_not,  // conditions: 1 where true, else 0
  select,                                                  // a where nonzero ? b : c
};
// clang-format on
inline constexpr int op_count = static_cast<int>(Op::select) + 1;

struct OpInfo {
  std::string_view name;  // in documents, for example "mul"
  int arity;              // operands used: columns a, then b, then c
  bool commutative;       // a and b may be exchanged
};
const OpInfo& info(Op op);
std::optional<Op> op_named(std::string_view name);

// What an input stands for.  Degrees of freedom, signals, constants and parameters go by name, so that a program
// (and its hash) does not change when an unrelated declaration is added to the scene; functionals and multipliers
// go by index.
enum class InputKind : std::uint8_t { dof, signal, constant, parameter, functional, time, multiplier };
std::string_view name_of(InputKind kind);
std::optional<InputKind> input_kind_named(std::string_view name);

struct Input {
  InputKind kind = InputKind::time;
  std::string name;    // dof, signal, constant, parameter
  int index = 0;       // functional: into Problem::functionals; multiplier: the value it multiplies
  int derivative = 0;  // dof, signal: 0, 1 or 2
  bool operator==(const Input&) const = default;
};

// Whether the optimiser differentiates with respect to such an input.
inline bool is_unknown(InputKind kind) {
  return kind == InputKind::dof || kind == InputKind::parameter || kind == InputKind::functional;
}

struct JacobianEntry {  // d values[row] / d inputs[input]
  int row = 0, input = 0, value = 0;
  bool operator==(const JacobianEntry&) const = default;
};
struct HessianEntry {  // d2 (sum_i multiplier_i values[i]) / d inputs[row] d inputs[column], column <= row
  int row = 0, column = 0, value = 0;
  bool operator==(const HessianEntry&) const = default;
};

struct Program {
  std::vector<Input> inputs;
  std::vector<double> numbers;
  std::vector<Op> op;                    // one row an operation ...
  std::vector<std::int32_t> a, b, c;     // ... with value indices as operands; unused ones are 0
  std::vector<std::int32_t> values;      // the statement's outputs c_i
  std::vector<JacobianEntry> jacobian;   // structurally non-zero entries, by row, then input
  std::vector<HessianEntry> hessian;     // one lower triangle, by row, then column; empty where all zero
  std::int32_t value_operations = 0;     // running this many operations computes `values`
  std::int32_t jacobian_operations = 0;  // ... and this many also `jacobian`; all of them also `hessian`
  bool operator==(const Program&) const = default;

  std::int32_t first_operation() const { return static_cast<std::int32_t>(inputs.size() + numbers.size()); }
  std::int32_t value_count() const { return first_operation() + static_cast<std::int32_t>(op.size()); }
};

// What is wrong with a program, and where in it: "a/17" or "jacobian/3/value" (a path below the program's own).
struct ProgramFault {
  std::string path;
  std::string message;
};

// Checks every rule above.  Whether the names exist is the problem's to check.
std::optional<ProgramFault> validate(const Program& program);

// 32 hexadecimal digits over everything that determines what the program computes.  Equal programs, equal hash.
std::string hash(const Program& program);

// One operation a line, for people and golden files.
std::string print(const Program& program);

}  // namespace spacetime
