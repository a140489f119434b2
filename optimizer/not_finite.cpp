#include "optimizer/not_finite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "optimizer/infix.h"
#include "optimizer/naming.h"

namespace spacetime::optimizer {
namespace {

// The part of a program that `depth` runs, with every value an output.
Program with_all_values(const Program& program, Depth depth) {
  Program all = program;
  const auto operations = depth == Depth::values     ? program.value_operations
                          : depth == Depth::jacobian ? program.jacobian_operations
                                                     : static_cast<std::int32_t>(program.op.size());
  for (auto* column : {&all.a, &all.b, &all.c}) column->resize(operations);
  all.op.resize(operations);
  all.value_operations = all.jacobian_operations = operations;
  all.jacobian.clear();
  all.hessian.clear();
  all.values.resize(all.value_count());
  for (std::int32_t k = 0; k < all.value_count(); ++k) all.values[k] = k;
  return all;
}

class Search {
 public:
  Search(const Transcription& t, std::span<const double> x, std::span<const double> multipliers,
         std::span<const char> active)
      : t_(t), x_(x), multipliers_(multipliers), active_(active) {}

  std::string derivatives_and_values() const {
    for (const Depth depth : {Depth::values, Depth::jacobian, Depth::hessian}) {
      for (const Batch& batch : t_.batches) {
        for (int s = 0; s < batch.samples(); ++s) {
          if (!batch.summed() && !active_.empty() && !active_[batch.first_row + s * batch.outputs()]) continue;
          if (auto text = at(batch, s, depth); !text.empty()) return text;
        }
      }
    }
    return "";
  }

  std::string conditions() const {
    for (const Conditional& conditional : t_.conditionals) {
      const Batch& batch = conditional.condition;
      const Program all = with_all_values(*batch.program, Depth::values);
      for (int s = 0; s < batch.samples(); ++s) {
        const auto values = evaluate_once(all, Depth::values, inputs(batch, s));
        for (std::size_t k = 0; k < all.op.size(); ++k) {
          if (all.op[k] != Op::less && all.op[k] != Op::less_equal) continue;
          const int operand = std::isnan(values[all.a[k]]) ? all.a[k] : all.b[k];
          if (!std::isnan(values[operand])) continue;
          const Constraint& constraint = t_.problem->constraints[t_.rows[conditional.first_row].statement];
          return sentence(batch, s, values, cause(all, values, operand), "in the condition of ",
                          named(constraint.name, constraint.place.line)) +
                 " So the condition counts as not holding.";
        }
      }
    }
    return "";
  }

 private:
  // What the program's inputs are at a sample.
  std::vector<double> inputs(const Batch& batch, int s) const {
    std::vector<double> result;
    for (const Input& input : batch.program->inputs) {
      switch (input.kind) {
        case InputKind::dof: {
          const auto slot = std::ranges::find_if(
              batch.slots, [&](const Slot& one) { return t_.problem->dofs[one.dof].name == input.name; });
          const BasisValues& basis = batch.basis(*slot, s);
          double sum = 0;
          for (int k = 0; k < 4; ++k) {
            sum += basis.b[input.derivative][k] * x_[t_.origin(slot->dof) + basis.first + k];
          }
          result.push_back(sum);
          break;
        }
        case InputKind::time:
          result.push_back(batch.times[s]);
          break;
        case InputKind::constant:
          result.push_back(t_.constants.at(input.name));
          break;
        case InputKind::functional:
          result.push_back(x_[t_.first_functional() + input.index]);
          break;
        case InputKind::parameter: {
          const auto found = std::ranges::find(t_.problem->parameters, input.name, &Parameter::name);
          result.push_back(x_[t_.first_parameter() + (found - t_.problem->parameters.begin())]);
          break;
        }
        case InputKind::multiplier:
          result.push_back(multiplier(batch, s, input.index));
          break;
        case InputKind::signal:
          result.push_back(0);  // no problem that is read has any
          break;
      }
    }
    return result;
  }

  double multiplier(const Batch& batch, int s, int output) const {
    if (batch.summed()) {
      const Target& target = batch.targets[output];
      return target.kind == Target::Kind::nowhere ? 0 : target.factor;
    }
    if (multipliers_.empty()) return 1;
    return multipliers_[batch.first_row + s * batch.outputs() + output];
  }

  std::string at(const Batch& batch, int s, Depth depth) const {
    const auto in = inputs(batch, s);
    std::vector<const double*> pointers;
    for (const double& value : in) pointers.push_back(&value);
    const std::vector<std::uint8_t> uniform(in.size(), 1);
    std::vector<double> out(batch.evaluator->outputs(depth));
    batch.evaluator->run(depth, 1, pointers, uniform, out.data(), 1);
    const std::size_t values = batch.program->values.size(), entries = batch.program->jacobian.size();
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (std::isfinite(out[k])) continue;
      if (k < values && ignored(batch, static_cast<int>(k))) continue;
      const Program all = with_all_values(*batch.program, depth);
      const auto every = evaluate_once(all, Depth::values, in);
      int value = 0, output = -1;
      std::string where = "in ";
      if (k < values) {
        value = batch.program->values[k];
        output = static_cast<int>(k);
      } else if (k < values + entries) {
        value = batch.program->jacobian[k - values].value;
        output = batch.program->jacobian[k - values].row;
        where = "in the derivative of ";
      } else {
        value = batch.program->hessian[k - values - entries].value;
        where = "in the second derivative of ";
      }
      if (output >= 0 && ignored(batch, output)) continue;
      return sentence(batch, s, every, cause(all, every, value), where, statements(batch, output));
    }
    return "";
  }

  // Of programs that statements share, a value may be wanted elsewhere only.
  static bool ignored(const Batch& batch, int output) {
    return batch.summed() && batch.targets[output].kind == Target::Kind::nowhere;
  }

  // From a value that is not finite back to the operation that first made it so.  Through `if` only what was chosen.
  static int cause(const Program& program, const std::vector<double>& values, int value) {
    while (value >= program.first_operation()) {
      const int k = value - program.first_operation();
      std::vector<int> operands{program.a[k], program.b[k], program.c[k]};
      operands.resize(info(program.op[k]).arity);
      if (program.op[k] == Op::select) operands = {values[program.a[k]] != 0 ? program.b[k] : program.c[k]};
      const auto found = std::ranges::find_if(operands, [&](int one) { return !std::isfinite(values[one]); });
      if (found == operands.end()) break;
      value = *found;
    }
    return value;
  }

  std::string sentence(const Batch& batch, int s, const std::vector<double>& values, int value,
                       const std::string& where, const std::string& whose) const {
    const Program& program = *batch.program;
    std::string text = fmt::format("{} is {}", infix(*t_.problem, program, value),
                                   std::isnan(values[value]) ? "not a number" : "beyond every number");
    if (!std::isnan(batch.times[s])) text += " at " + seconds({batch.times[s]});
    text += ", " + where + whose;
    const int k = value - program.first_operation();
    if (k < 0) return text + ".";
    std::vector<std::string> operands;
    const std::vector<int> all{program.a[k], program.b[k], program.c[k]};
    for (int i = 0; i < info(program.op[k]).arity; ++i) {
      const bool number = all[i] >= static_cast<int>(program.inputs.size()) && all[i] < program.first_operation();
      if (number || std::find(all.begin(), all.begin() + i, all[i]) != all.begin() + i) continue;
      operands.push_back(fmt::format("{} is {:.4g}", infix(*t_.problem, program, all[i]), values[all[i]]));
    }
    return text + (operands.empty() ? "." : ": " + listed(operands) + " there.");
  }

  // Who wants this output of a batch; any of its outputs where it is -1.
  std::string statements(const Batch& batch, int output) const {
    const Problem& problem = *t_.problem;
    if (!batch.summed()) {
      const Constraint& constraint = problem.constraints[t_.rows[batch.first_row].statement];
      return named(constraint.name, constraint.place.line);
    }
    std::vector<std::string> names;
    for (int o = 0; o < batch.outputs(); ++o) {
      if (output >= 0 && o != output) continue;
      const Target& target = batch.targets[o];
      if (target.kind == Target::Kind::objective) {
        names.push_back(named(problem.objective[target.index].name, problem.objective[target.index].place.line));
      } else if (target.kind == Target::Kind::functional) {
        names.push_back(user_of(target.index));
      }
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return listed(names);
  }

  // The first statement that a functional's value goes into.
  std::string user_of(int functional) const {
    const Problem& problem = *t_.problem;
    const bool integral = problem.functionals[functional].kind == Functional::Kind::integral;
    const std::string kind = integral ? "an integral of " : "an 'at' of ";
    const auto uses = [&](const std::string& hash) {
      return std::ranges::any_of(problem.programs.at(hash).inputs, [&](const Input& input) {
        return input.kind == InputKind::functional && input.index == functional;
      });
    };
    for (const Constraint& constraint : problem.constraints) {
      if (uses(constraint.program)) return kind + named(constraint.name, constraint.place.line);
    }
    for (const Term& term : problem.objective) {
      for (const Piece& piece : term.pieces) {
        if (uses(piece.program)) return kind + named(term.name, term.place.line);
      }
    }
    return kind + "another";
  }

  const Transcription& t_;
  std::span<const double> x_, multipliers_;
  std::span<const char> active_;
};

}  // namespace

std::string why_not_finite(const Transcription& t, std::span<const double> x, std::span<const double> multipliers,
                           std::span<const char> active) {
  return Search(t, x, multipliers, active).derivatives_and_values();
}

std::string undecided_condition(const Transcription& t, std::span<const double> x) {
  return Search(t, x, {}, {}).conditions();
}

}  // namespace spacetime::optimizer
