// Actions that change the problem between iterations, or move the motion by hand.
#include <cmath>

#include "common/nearest.h"
#include "symbolic/action.h"
#include "symbolic/eliminate.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

constexpr int most_coefficients = 1 << 24;  // of one degree of freedom; far above what fits into a problem

// A degree of freedom that is an unknown.
bool is_dof(Model& model, const Name& name) {
  const std::size_t mistakes = model.diagnostics.size();
  const std::size_t dofs = dofs_of(model, {name}).size();
  if (model.diagnostics.size() != mistakes || dofs == 0) return false;
  if (model.dof_index.contains(name.text)) return true;
  report(model, name.span, quoted(name.text) + " is a creature: name one of its degrees of freedom");
  return false;
}

bool is_constant(Model& model, const Name& name) {
  const auto symbol = model.symbols.find(name.text);
  if (symbol != model.symbols.end() && symbol->second.kind == Symbol::Kind::constant) return true;
  if (symbol != model.symbols.end() && symbol->second.kind == Symbol::Kind::lost) return false;
  std::vector<std::string> names;
  for (const auto& [constant, value] : model.constants) names.push_back(constant);
  if (symbol != model.symbols.end())
    report(model, name.span, quoted(name.text) + " is no constant, so it cannot be set",
           {{symbol->second.span, "it is declared here"}});
  else
    report(model, name.span,
           "there is no constant " + quoted(name.text) + " so far" +
               suggestion(name.text, names, "declare it first, with 'constant'"));
  return false;
}

bool is_frozen(Model& model, const Name& name) {
  const auto frozen = model.frozen.find(name.text);
  if (frozen == model.frozen.end()) return false;
  const auto& [span, what] = frozen->second;
  report(model, name.span,
         quoted(name.text) + " cannot be set, because " + quoted(what) + " on line " + std::to_string(span.line) +
             " has built in its value: change its declaration and compile again",
         {{span, "its value is built in here"}});
  return true;
}

// From here on the constant is worth this, and what follows from it follows.  A constant's input is younger than what
// it follows from, so one pass in the order of declaration finds each when its facts are not known yet.
void change(Model& model, const Name& name, double value) {
  model.set_constants.insert(name.text);
  model.work += 8.0 * static_cast<double>(model.graph.size());
  model.facts.forget();
  model.facts.change_constant(name.text, value);
  for (const auto& [constant, e] : model.constants) {
    if (model.set_constants.contains(constant)) continue;
    const double follows = *model.facts.known(e);
    if (!std::isfinite(follows))
      return report(model, name.span,
                    "with this value of " + quoted(name.text) + ", " + quoted(constant) +
                        ", which follows from it, has no finite value");
    model.facts.change_constant(constant, follows);
  }
}

}  // namespace

std::optional<Action> action_of(Model& model, const SetAction& action) {
  const bool possible = is_constant(model, action.constant) && !is_frozen(model, action.constant);
  const auto value = elaborate_fixed(model, action.value, "a constant");
  if (!possible || !value) return std::nullopt;
  SetConstant out{action.constant.text, quantity(model, value->expr)};
  change(model, action.constant, value->value);
  return out;
}

std::optional<Action> action_of(Model& model, const WeightAction& action) {
  const Named* named = named_statement(model, action.name);
  const auto weight = elaborate_weight(model, action.weight, !named || named->is_constraint);
  if (!named) return std::nullopt;
  return SetWeight{action.name.text, weight};
}

std::optional<Action> action_of(Model& model, const ToggleAction& action) {
  Named* named = named_statement(model, action.name);
  if (!named) return std::nullopt;
  if (action.kind == ToggleAction::Kind::enable) return Enable{action.name.text};
  if (action.kind == ToggleAction::Kind::disable) return Disable{action.name.text};
  named->deleted = action.name.span;
  return Delete{action.name.text};
}

std::optional<Action> action_of(Model& model, const ReplaceAction& action) {
  Named* named = named_statement(model, action.name);
  const auto* constraint = std::get_if<ConstrainDeclaration>(&action.by);
  if (named && named->is_constraint != (constraint != nullptr)) {
    report(model, action.name.span,
           quoted(action.name.text) + (named->is_constraint
                                           ? " is a constraint: only a relation can take its place"
                                           : " is an objective term: only a functional can take its place"),
           {{named->span, "it is declared here"}});
    return std::nullopt;
  }
  Replace out{action.name.text, 0};
  if (constraint) {
    Named replaced = named ? *named : Named{};
    Constraint by = constraint_of(model, *constraint, action.name.span, replaced);
    by.name = action.name.text;
    by.replacement = true;
    note_stated(model, {by.name, true, by.relation, std::move(replaced.residuals)});
    out.with = static_cast<int>(model.problem.constraints.size());
    model.problem.constraints.push_back(std::move(by));
    if (named) *named = replaced;
  } else {
    Term by;
    by.name = action.name.text;
    by.place = place_of(action.name.span);
    by.since = static_cast<int>(model.problem.actions.size());
    by.replacement = true;
    out.with = static_cast<int>(model.problem.objective.size());
    add_term(model, std::get<MinimizeDeclaration>(action.by), std::move(by));
  }
  if (!named) return std::nullopt;
  return out;
}

std::optional<Action> action_of(Model& model, const ScopeAction& action) {
  Named* named = named_statement(model, action.name, true);
  const auto scope = elaborate_scope(model, action.scope);
  if (!named || !scope) return std::nullopt;
  if (named->own_times) {
    report(model, action.name.span,
           "the times of " + quoted(action.name.text) + " stand inside it, in at( ) or integral( ): use 'replace'",
           {{named->span, "it is declared here"}});
    return std::nullopt;
  }
  return Rescope{action.name.text, *scope};
}

std::optional<Action> action_of(Model& model, const BoundAction& action) {
  const bool possible = is_dof(model, action.dof);
  const auto bounds = elaborate_bounds(model, action.bounds);
  if (!possible || !bounds) return std::nullopt;
  return Bound{action.dof.text, bounds->lower, bounds->upper};
}

std::optional<Action> action_of(Model& model, const KeyAction& action) {
  PullKeys out;
  std::optional<double> now;
  if (const auto time = elaborate_time(model, action.time, "the key's time")) {
    out.time = *time;
    now = model.time_checks.back().time;
  }
  Keyed keyed;
  out.keys = elaborate_keys(model, action.keys, now, keyed);
  return out;
}

std::optional<Action> action_of(Model& model, const ControlAction& action) {
  const bool possible = is_dof(model, action.dof);
  const auto index = elaborate_count(model, action.index, "the coefficient's number", 0, most_coefficients);
  const auto value = elaborate_fixed(model, action.value, "a coefficient");
  if (!possible || !index || !value) return std::nullopt;
  if (!model.refined)
    model.coefficient_checks.push_back({model.scene.nodes[action.index].span, action.dof.text, index->value});
  return Control{action.dof.text, index->value, quantity(model, value->expr)};
}

void check_coefficients(Model& model) {
  for (const CoefficientCheck& check : model.coefficient_checks) {
    const Dof& dof = model.problem.dofs[static_cast<std::size_t>(model.dof_index.find(check.dof)->second)];
    if (check.index >= dof.basis.size())
      report(model, check.span,
             quoted(check.dof) + " has " + std::to_string(dof.basis.size()) + " coefficients, numbered from 0");
  }
}

}  // namespace spacetime::symbolic
