#include "symbolic/expression.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

// The degrees of freedom that stand on the left of a key: one, or a tuple of them.
std::optional<std::vector<std::string>> keyed_dofs(Model& model, NodeId target) {
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

void add_key(Model& model, const Assignment& assignment, std::optional<double> time, Keyframe& keyframe) {
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
    keyframe.keys.push_back({(*dofs)[i], quantity(model, value)});
    if (!time) continue;
    const auto [it, fresh] = model.keyed.try_emplace({(*dofs)[i], *time}, span);
    if (!fresh)
      report(model, span, quoted((*dofs)[i]) + " has two keys at this time: remove one of them",
             {{it->second, "the other is here"}});
  }
}

}  // namespace

void elaborate_keyframe(Model& model, const KeyframeDeclaration& declaration, const Span& span) {
  Keyframe out;
  out.place = place_of(span);
  const auto time = elaborate_time(model, declaration.time, "the keyframe's time");
  if (time) out.time = *time;
  std::optional<double> now;
  if (time) now = model.time_checks.back().time;
  for (const Assignment& assignment : declaration.keys) add_key(model, assignment, now, out);
  model.problem.keyframes.push_back(std::move(out));
}

}  // namespace spacetime::symbolic
