#include "common/program.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "common/assert.h"
#include "common/fnv.h"

namespace spacetime {
namespace {

// In the order of Op.  What each means, NaN and ties included, is written down in evaluate_kernels.inl.
constexpr std::array<OpInfo, op_count> op_table{{
    {"add", 2, true},     {"sub", 2, false},  {"mul", 2, true},    {"div", 2, false},  {"neg", 1, false},
    {"mul_add", 3, true}, {"abs", 1, false},  {"sign", 1, false},  {"sqrt", 1, false}, {"min", 2, false},
    {"max", 2, false},    {"sin", 1, false},  {"cos", 1, false},   {"tan", 1, false},  {"asin", 1, false},
    {"acos", 1, false},   {"atan", 1, false}, {"atan2", 2, false}, {"sinh", 1, false}, {"cosh", 1, false},
    {"tanh", 1, false},   {"exp", 1, false},  {"log", 1, false},   {"pow", 2, false},  {"lt", 2, false},
    {"le", 2, false},     {"and", 2, true},   {"or", 2, true},     {"not", 1, false},  {"select", 3, false},
}};

struct InputKindInfo {
  std::string_view name;  // in documents
  bool named;             // goes by name
  bool indexed;           // goes by index
  bool derivable;         // may carry time derivatives
};
// In the order of InputKind.
constexpr std::array<InputKindInfo, 7> input_kind_table{{
    {"dof", true, false, true},
    {"signal", true, false, true},
    {"constant", true, false, false},
    {"parameter", true, false, false},
    {"functional", false, true, false},
    {"time", false, false, false},
    {"multiplier", false, true, false},
}};

const InputKindInfo& info(InputKind kind) { return input_kind_table[static_cast<std::size_t>(kind)]; }

ProgramFault fault(std::string path, std::string message) { return {std::move(path), std::move(message)}; }

std::string at(std::string_view list, std::size_t index, std::string_view member = {}) {
  auto path = std::string(list) + '/' + std::to_string(index);
  if (!member.empty()) path.append("/").append(member);
  return path;
}

std::optional<ProgramFault> validate_inputs(const Program& program) {
  std::set<std::tuple<InputKind, std::string_view, int, int>> seen;
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const auto& input = program.inputs[i];
    if (static_cast<std::size_t>(input.kind) >= input_kind_table.size()) {
      return fault(at("inputs", i, "kind"), "is no kind of input");
    }
    const auto& kind = info(input.kind);
    const auto name = std::string(kind.name);
    if (kind.named && input.name.empty()) return fault(at("inputs", i, "name"), "a " + name + " needs a name");
    if (!kind.named && !input.name.empty()) return fault(at("inputs", i, "name"), "a " + name + " goes without a name");
    if (!kind.indexed && input.index != 0) return fault(at("inputs", i, "index"), "a " + name + " has no index");
    if (input.index < 0) return fault(at("inputs", i, "index"), "must not be negative");
    if (input.kind == InputKind::multiplier && static_cast<std::size_t>(input.index) >= program.values.size()) {
      return fault(at("inputs", i, "index"),
                   "multiplies value " + std::to_string(input.index) + " of " + std::to_string(program.values.size()));
    }
    if (!kind.derivable && input.derivative != 0) {
      return fault(at("inputs", i, "derivative"), "a " + name + " has no derivatives");
    }
    if (input.derivative < 0 || input.derivative > 2) {
      return fault(at("inputs", i, "derivative"), "must be 0, 1 or 2");
    }
    if (!seen.emplace(input.kind, input.name, input.index, input.derivative).second) {
      return fault(at("inputs", i), "repeats an earlier input");
    }
  }
  for (std::size_t i = 0; i < program.numbers.size(); ++i) {
    if (!std::isfinite(program.numbers[i])) return fault(at("numbers", i), "must be finite");
  }
  return std::nullopt;
}

std::optional<ProgramFault> validate_operations(const Program& program) {
  const auto rows = program.op.size();
  const std::pair<std::string_view, const std::vector<std::int32_t>*> columns[] = {
      {"a", &program.a}, {"b", &program.b}, {"c", &program.c}};
  for (const auto& [name, column] : columns) {
    if (column->size() != rows) {
      return fault(std::string(name),
                   "has " + std::to_string(column->size()) + " rows, but op has " + std::to_string(rows));
    }
  }
  if (program.inputs.size() + program.numbers.size() + rows >
      static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return fault("op", "more values than 32 bits can number");
  }
  const auto first = program.first_operation();
  for (std::size_t i = 0; i < rows; ++i) {
    if (static_cast<int>(program.op[i]) >= op_count) return fault(at("op", i), "is no operation");
    const int arity = info(program.op[i]).arity;
    const auto own = first + static_cast<std::int32_t>(i);
    for (int k = 0; k < 3; ++k) {
      const auto& [name, column] = columns[k];
      const auto operand = (*column)[i];
      if (k >= arity && operand != 0) {
        return fault(at(name, i), std::string(info(program.op[i]).name) + " does not use it: must be 0");
      }
      if (k < arity && (operand < 0 || operand >= own)) {
        return fault(at(name, i), "must be at least 0 and below " + std::to_string(own) + ", the index of its result");
      }
    }
  }
  const auto operations = static_cast<std::int32_t>(rows);
  if (program.jacobian_operations < 0 || program.jacobian_operations > operations) {
    return fault("jacobian_operations", "must be from 0 to " + std::to_string(operations));
  }
  if (program.value_operations < 0 || program.value_operations > program.jacobian_operations) {
    return fault("value_operations", "must be from 0 to jacobian_operations");
  }
  return std::nullopt;
}

// Whether an output can be read once the first `operations` have run.
std::optional<ProgramFault> validate_output(std::string path, std::int32_t value, std::int32_t first,
                                            std::int32_t operations, std::string_view prefix) {
  if (value >= 0 && value < first + operations) return std::nullopt;
  return fault(std::move(path), "must be at least 0 and below " + std::to_string(first + operations) +
                                    ", what the first " + std::string(prefix) + " compute");
}

std::optional<ProgramFault> validate_unknown(std::string path, const Program& program, int input) {
  if (input < 0 || static_cast<std::size_t>(input) >= program.inputs.size()) {
    return fault(std::move(path), "there is no such input");
  }
  if (!is_unknown(program.inputs[input].kind)) {
    return fault(std::move(path), "a " + std::string(name_of(program.inputs[input].kind)) + " is no unknown");
  }
  return std::nullopt;
}

std::optional<ProgramFault> validate_outputs(const Program& program) {
  const auto first = program.first_operation();
  for (std::size_t i = 0; i < program.values.size(); ++i) {
    if (auto found =
            validate_output(at("values", i), program.values[i], first, program.value_operations, "value_operations")) {
      return found;
    }
  }
  for (std::size_t i = 0; i < program.jacobian.size(); ++i) {
    const auto& entry = program.jacobian[i];
    if (entry.row < 0 || static_cast<std::size_t>(entry.row) >= program.values.size()) {
      return fault(at("jacobian", i, "row"), "there is no such value");
    }
    if (auto found = validate_unknown(at("jacobian", i, "input"), program, entry.input)) return found;
    if (auto found = validate_output(at("jacobian", i, "value"), entry.value, first, program.jacobian_operations,
                                     "jacobian_operations")) {
      return found;
    }
    if (i > 0 &&
        std::pair(program.jacobian[i - 1].row, program.jacobian[i - 1].input) >= std::pair(entry.row, entry.input)) {
      return fault(at("jacobian", i), "entries go by row, then input, each once");
    }
  }
  for (std::size_t i = 0; i < program.hessian.size(); ++i) {
    const auto& entry = program.hessian[i];
    if (auto found = validate_unknown(at("hessian", i, "row"), program, entry.row)) return found;
    if (auto found = validate_unknown(at("hessian", i, "column"), program, entry.column)) return found;
    if (entry.column > entry.row) return fault(at("hessian", i, "column"), "must not be above row: a lower triangle");
    if (auto found = validate_output(at("hessian", i, "value"), entry.value, first,
                                     static_cast<std::int32_t>(program.op.size()), "operations")) {
      return found;
    }
    if (i > 0 &&
        std::pair(program.hessian[i - 1].row, program.hessian[i - 1].column) >= std::pair(entry.row, entry.column)) {
      return fault(at("hessian", i), "entries go by row, then column, each once");
    }
  }
  return std::nullopt;
}

std::string shortest(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

std::string operand(std::int32_t value) { return '%' + std::to_string(value); }

std::string describe(const Input& input) {
  const auto& kind = info(input.kind);
  std::string text(kind.name);
  if (kind.named) text += ' ' + input.name + std::string(input.derivative, '\'');
  if (kind.indexed) text += ' ' + std::to_string(input.index);
  return text;
}

}  // namespace

const OpInfo& info(Op op) {
  SPACETIME_ASSERT(static_cast<int>(op) < op_count);
  return op_table[static_cast<std::size_t>(op)];
}

std::optional<Op> op_named(std::string_view name) {
  for (int i = 0; i < op_count; ++i) {
    if (op_table[i].name == name) return static_cast<Op>(i);
  }
  return std::nullopt;
}

std::string_view name_of(InputKind kind) { return info(kind).name; }

std::optional<InputKind> input_kind_named(std::string_view name) {
  for (std::size_t i = 0; i < input_kind_table.size(); ++i) {
    if (input_kind_table[i].name == name) return static_cast<InputKind>(i);
  }
  return std::nullopt;
}

std::optional<ProgramFault> validate(const Program& program) {
  if (auto found = validate_inputs(program)) return found;
  if (auto found = validate_operations(program)) return found;
  return validate_outputs(program);
}

// Every list is preceded by its length, so that no two programs feed the same bytes.
std::string hash(const Program& program) {
  Fnv1a sum;
  sum.number(program.inputs.size());
  for (const auto& input : program.inputs) {
    sum.byte(static_cast<std::uint8_t>(input.kind));
    sum.text(input.name);
    sum.index(input.index);
    sum.index(input.derivative);
  }
  sum.number(program.numbers.size());
  for (const double number : program.numbers) sum.number(std::bit_cast<std::uint64_t>(number));
  sum.number(program.op.size());
  for (const auto op : program.op) sum.text(info(op).name);  // the name, so that the enumeration may grow
  for (const auto* column : {&program.a, &program.b, &program.c}) {
    for (const auto index : *column) sum.index(index);
  }
  sum.number(program.values.size());
  for (const auto value : program.values) sum.index(value);
  sum.number(program.jacobian.size());
  for (const auto& entry : program.jacobian) {
    sum.index(entry.row), sum.index(entry.input), sum.index(entry.value);
  }
  sum.number(program.hessian.size());
  for (const auto& entry : program.hessian) {
    sum.index(entry.row), sum.index(entry.column), sum.index(entry.value);
  }
  sum.index(program.value_operations);
  sum.index(program.jacobian_operations);
  return sum.digits();
}

std::string print(const Program& program) {
  std::string out;
  std::int32_t index = 0;
  for (const auto& input : program.inputs) out += operand(index++) + " = " + describe(input) + '\n';
  for (const double number : program.numbers) out += operand(index++) + " = " + shortest(number) + '\n';
  const auto operations = [&](std::int32_t from, std::int32_t to) {
    for (auto i = from; i < to; ++i) {
      const auto& row = info(program.op[i]);
      out += operand(index++) + " = " + std::string(row.name) + ' ' + operand(program.a[i]);
      if (row.arity > 1) out += ' ' + operand(program.b[i]);
      if (row.arity > 2) out += ' ' + operand(program.c[i]);
      out += '\n';
    }
  };
  operations(0, program.value_operations);
  for (std::size_t i = 0; i < program.values.size(); ++i) {
    out += "value " + std::to_string(i) + " = " + operand(program.values[i]) + '\n';
  }
  operations(program.value_operations, program.jacobian_operations);
  for (const auto& entry : program.jacobian) {
    out += "jacobian " + std::to_string(entry.row) + ' ' + operand(entry.input) + " = " + operand(entry.value) + '\n';
  }
  operations(program.jacobian_operations, static_cast<std::int32_t>(program.op.size()));
  for (const auto& entry : program.hessian) {
    out += "hessian " + operand(entry.row) + ' ' + operand(entry.column) + " = " + operand(entry.value) + '\n';
  }
  return out;
}

}  // namespace spacetime
