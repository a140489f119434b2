#include "symbolic/eliminate.h"
#include "symbolic/expression.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

// "arm.elbow" where the node is a name with or without dots; empty for everything else.
std::string dotted(const Scene& scene, NodeId id) {
  std::string tail;
  while (scene.nodes[id].kind == Node::Kind::member) {
    tail = "." + scene.nodes[id].text + tail;
    id = scene.nodes[id].operands[0];
  }
  return scene.nodes[id].kind == Node::Kind::name ? scene.nodes[id].text + tail : std::string();
}

bool names_eliminated(Model& model, NodeId target) {
  for (NodeId id = model.scene.nodes[target].first; id <= target; ++id)
    if (is_eliminated(model, dotted(model.scene, id), model.scene.nodes[id].span)) return true;
  return false;
}

// The degrees of freedom that stand on the left of a key: one, or a tuple of them.
std::optional<std::vector<std::string>> keyed_dofs(Model& model, NodeId target) {
  if (names_eliminated(model, target)) return std::nullopt;
  const auto components = elaborate_numbers(model, target, "what is keyed");
  if (!components) return std::nullopt;
  std::vector<std::string> out;
  for (const Expr e : *components) {
    const auto& node = model.graph.node(e);
    const bool dof = node.kind == Graph::Kind::input && model.graph.input_of(e).kind == InputKind::dof &&
                     model.graph.input_of(e).derivative == 0;
    if (!dof) {
      report(model, model.scene.nodes[target].span, "only a degree of freedom can be keyed");
      return std::nullopt;
    }
    out.push_back(model.graph.input_of(e).name);
  }
  return out;
}

void add_key(Model& model, const Assignment& assignment, std::optional<double> time, Keyed& keyed,
             std::vector<Key>& keys) {
  const auto dofs = keyed_dofs(model, assignment.target);
  const auto values = elaborate_numbers(model, assignment.value, "a key's value");
  if (!dofs || !values) return;
  const Span& span = model.scene.nodes[assignment.target].span;
  if (values->size() != 1 && values->size() != dofs->size())
    return report(model, model.scene.nodes[assignment.value].span,
                  std::to_string(dofs->size()) + " degrees of freedom are keyed, but here are " +
                      std::to_string(values->size()) + " values");
  for (std::size_t i = 0; i < dofs->size(); ++i) {
    const Expr value = (*values)[values->size() == 1 ? 0 : i];
    if (!model.facts.known(value))
      return report(model, model.scene.nodes[assignment.value].span,
                    "a key's value must be made of numbers and constants");
    keys.push_back({(*dofs)[i], quantity(model, value)});
    if (!time) continue;
    const auto [it, fresh] = keyed.try_emplace({(*dofs)[i], *time}, span);
    if (!fresh)
      report(model, span, quoted((*dofs)[i]) + " has two keys at this time: remove one of them",
             {{it->second, "the other is here"}});
  }
}

}  // namespace

std::vector<Key> elaborate_keys(Model& model, const std::vector<Assignment>& assignments, std::optional<double> time,
                                Keyed& keyed) {
  std::vector<Key> out;
  for (const Assignment& assignment : assignments) add_key(model, assignment, time, keyed, out);
  return out;
}

void elaborate_keyframe(Model& model, const KeyframeDeclaration& declaration, const Span& span) {
  Keyframe out;
  out.place = place_of(span);
  out.since = static_cast<int>(model.problem.actions.size());
  std::optional<double> now;
  if (const auto time = elaborate_time(model, declaration.time, "the keyframe's time")) {
    out.time = *time;
    now = model.time_checks.back().time;
  }
  out.keys = elaborate_keys(model, declaration.keys, now, model.keyed);
  model.problem.keyframes.push_back(std::move(out));
}

}  // namespace spacetime::symbolic
