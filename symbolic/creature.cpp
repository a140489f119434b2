#include "symbolic/creature.h"

#include <algorithm>

#include "common/nearest.h"
#include "symbolic/dof.h"
#include "symbolic/expression.h"
#include "symbolic/link.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

std::vector<std::string> link_names(const Creature& creature) {
  std::vector<std::string> out = creature.links;
  out.emplace_back("ground");
  return out;
}

void add_gravity(Model& model, Creature& creature, const GravityDeclaration& gravity, std::optional<Span>& seen) {
  if (seen)
    return report(model, gravity.span, "a creature has one 'gravity': remove one of them",
                  {{*seen, "the first is here"}});
  seen = gravity.span;
  if (const auto value = elaborate_still_vector(model, gravity.value, "gravity")) creature.linkage.gravity = *value;
}

void add_point(Model& model, Creature& creature, const PointDeclaration& declaration) {
  Point point;
  point.name = declaration.name.text;
  declare_member(model, creature, declaration.name);
  const auto link = find_link(model, creature, declaration.link);
  if (link == -1) report(model, declaration.link.span, "a point sits on a link, not on the ground");
  point.position = elaborate_still_vector(model, declaration.position, "a point's position").value_or(Vector3{});
  point.link = std::max(0, link.value_or(0));
  if (link && *link >= 0)
    creature.points.push_back(point);
  else
    creature.damaged = true;
}

void add_force(Model& model, Creature& creature, const ForceDeclaration& declaration) {
  const auto point = std::find_if(creature.points.begin(), creature.points.end(),
                                  [&](const Point& p) { return p.name == declaration.point.text; });
  if (point == creature.points.end()) {
    std::vector<std::string> names;
    for (const Point& p : creature.points) names.push_back(p.name);
    if (!creature.damaged)
      report(model, declaration.point.span,
             quoted(creature.name) + " has no point " + quoted(declaration.point.text) +
                 suggestion(declaration.point.text, names, "declare it first, with 'point'"));
    return;
  }
  const PointForce force{point->link, point->position, {}};
  const auto value = elaborate_numbers(model, declaration.value, "a force");
  if (!value) return;
  if (value->size() != 3)
    return report(model, model.scene.nodes[declaration.value].span, "a force has 3 components (fx, fy, fz)");
  Creature& now = model.creatures.back();
  now.linkage.forces.push_back({force.link, force.point, {(*value)[0], (*value)[1], (*value)[2]}});
}

}  // namespace

void declare_member(Model& model, Creature& creature, const Name& name) {
  static const std::vector<std::string> taken{"q", "force", "com", "kinetic", "potential", "x", "y", "z"};
  if (std::find(taken.begin(), taken.end(), name.text) != taken.end() || name.text == "ground")
    report(model, name.span, quoted(name.text) + " is taken inside creatures: choose another name");
  if (is_too_long(model, name)) return;
  const auto [it, fresh] = creature.members.try_emplace(name.text, name.span);
  if (!fresh)
    report(model, name.span,
           quoted(name.text) + " is declared twice in " + quoted(creature.name) +
               ": links, degrees of freedom and points share one set of names",
           {{it->second, "it is declared first here"}});
}

std::optional<int> find_link(Model& model, const Creature& creature, const Name& name) {
  if (name.text == "ground") return -1;
  const auto it = std::find(creature.links.begin(), creature.links.end(), name.text);
  if (it != creature.links.end()) return static_cast<int>(it - creature.links.begin());
  if (!creature.damaged)
    report(model, name.span,
           quoted(creature.name) + " has no link " + quoted(name.text) + " so far" +
               suggestion(name.text, link_names(creature), "declare it first, with 'link', or write 'ground'"));
  return std::nullopt;
}

void elaborate_creature(Model& model, const CreatureDeclaration& declaration, const Span& span) {
  const int index = static_cast<int>(model.creatures.size());
  model.creatures.push_back({});
  // Nothing below adds to model.creatures.
  Creature& creature = model.creatures.back();
  creature.name = declaration.name.text;
  creature.damaged = declaration.damaged;
  Symbol symbol;
  symbol.kind = Symbol::Kind::creature;
  symbol.value.kind = Value::Kind::creature;
  symbol.value.creature = index;
  declare(model, declaration.name, symbol);
  std::optional<Span> gravity;
  for (const auto& item : declaration.items) {
    if (const auto* g = std::get_if<GravityDeclaration>(&item)) add_gravity(model, creature, *g, gravity);
    if (const auto* link = std::get_if<LinkDeclaration>(&item)) add_link(model, creature, *link);
    if (const auto* point = std::get_if<PointDeclaration>(&item)) add_point(model, creature, *point);
  }
  // Forces may depend on the creature's own motion, so they come when its links are all there.
  creature.forces_open = true;
  for (const auto& item : declaration.items)
    if (const auto* force = std::get_if<ForceDeclaration>(&item)) add_force(model, creature, *force);
  creature.forces_open = false;
  if (creature.links.empty() && !creature.damaged)
    report(model, span, "creature " + quoted(creature.name) + " has no links: give it at least one");
}

const std::vector<Frame>& frames_of(Model& model, Creature& creature) {
  if (!creature.frames) creature.frames = frames(model.graph, creature.linkage);
  return *creature.frames;
}

const std::vector<Expr>& forces_of(Model& model, Creature& creature) {
  if (!creature.forces) creature.forces = generalised_forces(model.graph, creature.linkage);
  return *creature.forces;
}

bool has_mass(Model& model, const Creature& creature) {
  return std::any_of(creature.linkage.links.begin(), creature.linkage.links.end(),
                     [&](const Link& link) { return model.facts.known(link.mass) != 0.0; });
}

}  // namespace spacetime::symbolic
