#include "optimizer/edit.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/constants.h"
#include "common/diagnostic.h"
#include "optimizer/batch.h"

namespace spacetime::optimizer {
namespace {

template <class List>
auto* find(List& list, const std::string& name) {
  const auto found = std::ranges::find_if(list, [&](const auto& s) { return s.name == name && !s.replacement; });
  return found == list.end() ? nullptr : &*found;
}

[[noreturn]] void unknown(const std::string& name) {
  throw InputError(fmt::format("there is no constraint and no objective term '{}'", name));
}

void require_statement(const Problem& problem, const std::string& name) {
  if (!find(problem.constraints, name) && !find(problem.objective, name)) unknown(name);
}

}  // namespace

void apply(Edited& edited, const SetConstant& set) {
  Problem& problem = edited.problem;
  const auto found = std::ranges::find(problem.constants, set.constant, &Constant::name);
  if (found == problem.constants.end()) throw InputError(fmt::format("there is no constant '{}'", set.constant));
  if (found->frozen) {
    throw InputError(
        fmt::format("'{}' cannot be set: line {} froze it, because the number of unknowns or instances "
                    "follows from it. Edit the scene instead",
                    set.constant, found->frozen->line));
  }
  found->value = {evaluate(problem, evaluate_constants(problem), set.value, "set " + set.constant), {}, 0};
}

void apply(Edited& edited, const SetWeight& weight) {
  if (Constraint* constraint = find(edited.problem.constraints, weight.name)) {
    constraint->weight = weight.weight;
  } else if (Term* term = find(edited.problem.objective, weight.name)) {
    if (!weight.weight)
      throw InputError(fmt::format("the weight of the objective term '{}' must be finite", weight.name));
    term->weight = *weight.weight;
  } else {
    unknown(weight.name);
  }
}

void apply(Edited& edited, const Enable& enable) {
  require_statement(edited.problem, enable.name);
  edited.disabled.erase(enable.name);
}

void apply(Edited& edited, const Disable& disable) {
  require_statement(edited.problem, disable.name);
  edited.disabled.insert(disable.name);
}

void apply(Edited& edited, const Delete& remove) {
  require_statement(edited.problem, remove.name);
  const auto is_it = [&](const auto& statement) { return statement.name == remove.name && !statement.replacement; };
  // Replacements in waiting are found by index: what stands before them must keep its place.
  for (auto& constraint : edited.problem.constraints) {
    if (is_it(constraint)) constraint.replacement = true;
  }
  for (auto& term : edited.problem.objective) {
    if (is_it(term)) term.replacement = true;
  }
}

void apply(Edited& edited, const Replace& replace) {
  const auto put = [&](auto& list) {
    auto* old = find(list, replace.name);
    if (!old) return false;
    const auto place = *old;
    *old = list.at(replace.with);
    old->name = place.name;
    old->since = place.since;
    old->replacement = false;
    return true;
  };
  if (!put(edited.problem.constraints) && !put(edited.problem.objective)) unknown(replace.name);
}

void apply(Edited& edited, const Rescope& scope) {
  Constraint* constraint = find(edited.problem.constraints, scope.name);
  if (!constraint) throw InputError(fmt::format("there is no constraint '{}'", scope.name));
  constraint->scope = scope.scope;
}

void apply(Edited& edited, const Bound& bound) {
  Dof& dof = edited.problem.dofs[require_dof(edited.problem, bound.dof)];
  dof.lower = bound.lower;
  dof.upper = bound.upper;
}

bool apply_edit(Edited& edited, const Action& action) {
  const auto apply_to = [&](const auto& edit) {
    if constexpr (requires { apply(edited, edit); }) {
      apply(edited, edit);
      return true;
    }
    return false;
  };
  return std::visit(apply_to, action);
}

bool apply_where_it_fits(Edited& edited, const Action& action) {
  if (const auto* replace = std::get_if<Replace>(&action)) {
    const auto fits = [&](const auto& list) {
      return static_cast<std::size_t>(replace->with) < list.size() && list[replace->with].replacement &&
             list[replace->with].name == replace->name;
    };
    if (!fits(edited.problem.constraints) && !fits(edited.problem.objective)) return false;
  }
  try {
    return apply_edit(edited, action);
  } catch (const InputError&) {
    return false;
  }
}

bool replaces(const Action& edit, const Action& before) {
  if (edit.index() != before.index()) return false;
  if (const auto* set = std::get_if<SetConstant>(&edit)) {
    return set->constant == std::get<SetConstant>(before).constant && set->value.program.empty();
  }
  if (const auto* weight = std::get_if<SetWeight>(&edit)) return weight->name == std::get<SetWeight>(before).name;
  if (const auto* bound = std::get_if<Bound>(&edit)) return bound->dof == std::get<Bound>(before).dof;
  return false;
}

Problem in_effect(const Edited& edited, int action) {
  Problem problem = edited.problem;
  const auto out = [&](const auto& s) { return s.replacement || s.since > action || edited.disabled.contains(s.name); };
  std::erase_if(problem.constraints, out);
  std::erase_if(problem.objective, out);
  std::erase_if(problem.keyframes, [&](const Keyframe& keyframe) { return keyframe.since > action; });
  return problem;
}

}  // namespace spacetime::optimizer
