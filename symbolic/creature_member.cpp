// What a creature gives: arm.q, arm.elbow, arm.elbow.force, arm.force, arm.hand, arm.fore, arm.com, arm.kinetic,
// arm.potential.
#include <algorithm>

#include "common/nearest.h"
#include "symbolic/creature.h"
#include "symbolic/model.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

Value numbers(std::vector<Expr> components) { return {Value::Kind::numbers, std::move(components)}; }
Value vector_value(const Vector3& v) { return numbers({v[0], v[1], v[2]}); }

std::pair<Value, bool> refused(Model& model, const Span& span, std::string message) {
  report(model, span, std::move(message));
  return {Value{}, true};
}

std::pair<Value, bool> force(Model& model, Creature& creature, int joint, const Span& span) {
  if (creature.forces_open)
    return refused(model, span,
                   "the joint forces of " + quoted(creature.name) +
                       " follow from its outside forces: these cannot be made from them");
  if (creature.joints.empty())
    return refused(model, span, quoted(creature.name) + " has no degrees of freedom, so it has no forces");
  const auto& forces = forces_of(model, creature);
  if (joint < 0) return {numbers(forces), true};
  return {numbers({forces[static_cast<std::size_t>(joint)]}), true};
}

}  // namespace

std::pair<Value, bool> creature_member(Model& model, int index, int joint, std::string_view name, const Span& span) {
  Creature& creature = model.creatures[static_cast<std::size_t>(index)];
  if (joint >= 0) {
    if (name == "force") return force(model, creature, joint, span);
    return {Value{}, false};
  }
  for (std::size_t i = 0; i < creature.joints.size(); ++i)
    if (creature.joints[i].name == name) {
      Value value = numbers({creature.joints[i].coordinate.q});
      value.creature = index;
      value.joint = static_cast<int>(i);
      return {value, true};
    }
  for (const Point& point : creature.points)
    if (point.name == name) {
      const Frame& frame = frames_of(model, creature)[static_cast<std::size_t>(point.link)];
      return {vector_value(transform(model.graph, frame, point.position)), true};
    }
  for (std::size_t i = 0; i < creature.links.size(); ++i)
    if (creature.links[i] == name) return {vector_value(frames_of(model, creature)[i].position), true};
  if (creature.damaged) return {Value{}, true};
  if (name == "force") return force(model, creature, -1, span);
  if (name == "q") {
    std::vector<Expr> q;
    for (const Joint& j : creature.joints) q.push_back(j.coordinate.q);
    if (q.empty()) return refused(model, span, quoted(creature.name) + " has no degrees of freedom");
    return {numbers(std::move(q)), true};
  }
  if (name == "com") {
    if (!has_mass(model, creature))
      return refused(model, span, quoted(creature.name) + " has no mass, so it has no centre of mass");
    return {vector_value(centre_of_mass(model.graph, creature.linkage, frames_of(model, creature))), true};
  }
  if (name == "kinetic") return {numbers({kinetic_energy(model.graph, creature.linkage)}), true};
  if (name == "potential")
    return {numbers({potential_energy(model.graph, creature.linkage, frames_of(model, creature))}), true};
  if (creature.damaged) return {Value{}, true};
  Symbol missing;  // so that its other uses are not reported too
  missing.declared = false;
  if (!model.symbols.try_emplace(creature.name + "." + std::string(name), missing).second) return {Value{}, true};
  return refused(
      model, span,
      quoted(creature.name) + " has no member " + quoted(name) +
          suggestion(name, member_names(creature),
                     "it has its links, points and degrees of freedom, and q, force, com, kinetic and potential"));
}

std::vector<std::string> member_names(const Creature& creature) {
  std::vector<std::string> out{"q", "force", "com", "kinetic", "potential"};
  for (const auto& [name, span] : creature.members) out.push_back(name);
  for (const Joint& joint : creature.joints) out.push_back(joint.name + ".force");
  return out;
}

}  // namespace spacetime::symbolic
