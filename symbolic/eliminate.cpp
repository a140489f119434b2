#include "symbolic/eliminate.h"

#include <algorithm>

#include "common/nearest.h"
#include "symbolic/derivative.h"
#include "symbolic/dof.h"
#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

bool depends_on(const Model& model, Expr e, const std::string& dof) {
  const auto needed = reachable(model.graph, std::vector{e});
  for (std::uint32_t id = 0; id < needed.size(); ++id)
    if (needed[id] && model.graph.node({id}).kind == Graph::Kind::input && model.graph.input_of({id}).name == dof &&
        model.graph.input_of({id}).kind == InputKind::dof)
      return true;
  return false;
}

// Whether the name is a degree of freedom that can still be eliminated; its own expression aside.
bool can_be_eliminated(Model& model, const Name& dof) {
  if (is_eliminated(model, dof.text, dof.span)) return false;
  const auto index = model.dof_index.find(dof.text);
  if (index == model.dof_index.end()) {
    dofs_of(model, {dof});  // reports it, unless it is lost
    if (model.symbols.contains(dof.text) && model.symbols.find(dof.text)->second.kind == Symbol::Kind::creature)
      report(model, dof.span, quoted(dof.text) + " is a creature: eliminate one of its degrees of freedom");
    return false;
  }
  if (const auto& bounds = model.dof_bounds[static_cast<std::size_t>(index->second)]) {
    report(model, dof.span,
           quoted(dof.text) + " has bounds, which only an unknown can keep: take them away, or write a constraint",
           {{*bounds, "the bounds are here"}});
    return false;
  }
  const auto used = model.used.find(dof.text);
  if (used == model.used.end()) return true;
  report(model, dof.span,
         quoted(dof.text) + " is used on line " + std::to_string(used->second.line) +
             ", before it is eliminated: move this line up, right behind the declaration of " + quoted(dof.text),
         {{used->second, "it is used here"}});
  return false;
}

void replace_joint(Model& model, const std::string& dof, const Coordinate& by) {
  const Coordinate own = coordinate_of(model, dof);
  for (Creature& creature : model.creatures)
    for (Joint& joint : creature.joints) {
      if (creature.name + "." + joint.name != dof) continue;
      joint.coordinate = by;
      creature.linkage.links[static_cast<std::size_t>(joint.link)].coordinate = by;
      creature.frames.reset();
      creature.forces.reset();
      for (PointForce& force : creature.linkage.forces)
        for (Expr& e : force.force) e = substitute(model.graph, e, {{own.q, by.q}, {own.v, by.v}, {own.a, by.a}});
    }
}

// Whether this is a degree of freedom of the creature whose declaration is being read: such uses are replaced.
bool inside_own_creature(const Model& model, std::string_view dof) {
  if (model.creatures.empty() || !model.creatures.back().forces_open) return false;
  const std::string& name = model.creatures.back().name;
  return dof.size() > name.size() && dof.starts_with(name) && dof[name.size()] == '.';
}

}  // namespace

void note_uses(Model& model, std::span<const Expr> values, const Span& span) {
  if (model.to_eliminate.empty() || values.empty()) return;
  model.work += static_cast<double>(model.graph.size());
  const auto needed = reachable(model.graph, values);
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id] || model.graph.node({id}).kind != Graph::Kind::input) continue;
    const Input& input = model.graph.input_of({id});
    if (input.kind != InputKind::dof || !model.to_eliminate.contains(input.name)) continue;
    if (!inside_own_creature(model, input.name)) model.used.try_emplace(input.name, span);
  }
}

void note_eliminations(Model& model) {
  for (const Statement& statement : model.scene.statements)
    if (const auto* eliminate = std::get_if<EliminateDeclaration>(&statement.what))
      model.to_eliminate.try_emplace(eliminate->dof.text, statement.span);
}

void elaborate_eliminate(Model& model, const EliminateDeclaration& declaration, const Span& span) {
  const std::string& dof = declaration.dof.text;
  const bool possible = can_be_eliminated(model, declaration.dof);
  const auto e = elaborate_scalar(model, declaration.value, "what takes the place of a degree of freedom");
  model.to_eliminate.erase(dof);
  if (!possible || !e) return;
  const Span& place = model.scene.nodes[declaration.value].span;
  if (depends_on(model, *e, dof)) return report(model, place, quoted(dof) + " cannot be eliminated by means of itself");
  const auto symbol = model.symbols.find(dof);
  const auto rate = time_derivative(model.graph, *e);
  const auto second = rate ? time_derivative(model.graph, *rate) : std::nullopt;
  if (symbol != model.symbols.end()) {
    symbol->second.kind = Symbol::Kind::let;
    symbol->second.value = {Value::Kind::numbers, {*e}};
  } else if (second) {
    replace_joint(model, dof, {*e, *rate, *second});
  } else {
    return report(model, place,
                  "a creature's forces need two time derivatives of this, but trajectories have two in all: "
                  "take away primes");
  }
  model.eliminated.try_emplace(dof, span);
  model.lets.push_back({dof, {*e}});
}

bool is_eliminated(Model& model, const std::string& dof, const Span& span) {
  const auto found = model.eliminated.find(dof);
  if (found == model.eliminated.end()) return false;
  report(
      model, span,
      quoted(dof) + " is eliminated on line " + std::to_string(found->second.line) + ", so it is no unknown any more",
      {{found->second, "it is eliminated here"}});
  return true;
}

void remove_eliminated(Model& model) {
  if (model.eliminated.empty()) return;
  std::vector<Dof> dofs;
  std::size_t kept = 0;
  model.dof_index.clear();
  for (std::size_t i = 0; i < model.problem.dofs.size(); ++i) {
    if (model.eliminated.contains(model.problem.dofs[i].name)) continue;
    model.dof_index.try_emplace(model.problem.dofs[i].name, static_cast<int>(kept));
    model.dof_trajectory[kept] = model.dof_trajectory[i];
    model.dof_span[kept] = model.dof_span[i];
    dofs.push_back(std::move(model.problem.dofs[i]));
    ++kept;
  }
  model.problem.dofs = std::move(dofs);
}

}  // namespace spacetime::symbolic
