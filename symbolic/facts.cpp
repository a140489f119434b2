#include "symbolic/facts.h"

#include "symbolic/value.h"

namespace spacetime::symbolic {

Facts::Fact Facts::fact_of_input(const Input& input) const {
  switch (input.kind) {
    case InputKind::constant:
      return {constant, constants_.at(input.name)};
    case InputKind::dof:
    case InputKind::signal:
      return {motion, 0};
    case InputKind::time:
      return {clock, 0};
    case InputKind::functional:
      return {functional, 0};
    case InputKind::parameter:
      return {parameter, 0};
    case InputKind::multiplier:
      break;
  }
  return {unknown, 0};
}

const Facts::Fact& Facts::of(Expr e) {
  for (auto id = static_cast<std::uint32_t>(facts_.size()); id <= e.id; ++id) {
    const auto& node = graph_.node({id});
    Fact fact;
    if (node.kind == Graph::Kind::input) {
      fact = fact_of_input(graph_.input_of({id}));
    } else if (node.kind == Graph::Kind::operation) {
      // Operands that an operation does not use are node 0, the number 0.
      const Fact &a = facts_[node.a.id], &b = facts_[node.b.id], &c = facts_[node.c.id];
      fact.uses = a.uses | b.uses | c.uses;
      if ((fact.uses & ~constant) == 0) fact.value = apply<double>(node.op, a.value, b.value, c.value);
    } else {
      fact.value = *graph_.constant({id});
    }
    facts_.push_back(fact);
  }
  return facts_[e.id];
}

std::optional<double> Facts::known(Expr e) {
  const Fact& fact = of(e);
  if ((fact.uses & ~constant) != 0) return std::nullopt;
  return fact.value;
}

}  // namespace spacetime::symbolic
