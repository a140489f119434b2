#include <algorithm>

#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

// Left side minus right side, by components; a scalar stands for a tuple of its like.
std::optional<std::vector<Expr>> residual(Model& model, const Relation& relation) {
  const auto left = elaborate_numbers(model, relation.left, "the left side of a relation");
  const auto right = elaborate_numbers(model, relation.right, "the right side of a relation");
  if (!left || !right) return std::nullopt;
  const std::size_t n = left->size(), m = right->size();
  if (n != m && n != 1 && m != 1) {
    report(model, relation.span,
           "the left side has " + std::to_string(n) + " components and the right side " + std::to_string(m) +
               ": both must have as many, or one of them one");
    return std::nullopt;
  }
  std::vector<Expr> out;
  for (std::size_t i = 0; i < std::max(n, m); ++i)
    out.push_back(model.graph.subtract((*left)[n == 1 ? 0 : i], (*right)[m == 1 ? 0 : i]));
  return out;
}

// Without a scope: the whole time, or, where nothing depends on time outside a functional, one instance; that is an
// ordinary one where the functionals are all values at one time.
Scope scope_of(Model& model, std::vector<Expr>& values) {
  Scope out;
  if (std::any_of(values.begin(), values.end(), [&](Expr e) { return model.facts.timed(e); })) return out;
  const std::vector<int> functionals = functionals_in(model, values);
  const auto time = common_time(model, functionals);
  out.kind = Scope::Kind::once;
  if (!time) return out;
  out.kind = Scope::Kind::times;
  out.times.push_back(quantity(model, *time));
  for (Expr& e : values) e = take_out(model, e, functionals);
  return out;
}

}  // namespace

std::optional<Quantity> elaborate_weight(Model& model, const std::optional<WeightClause>& clause, bool of_constraint) {
  if (!clause) return std::nullopt;
  if (!clause->value) {
    if (!of_constraint) report(model, clause->span, "an objective cannot weigh 'inf': write a number");
    return std::nullopt;
  }
  const auto weight = elaborate_fixed(model, *clause->value, "a weight");
  if (!weight) return std::nullopt;
  if (of_constraint && weight->value < 0)
    report(model, model.scene.nodes[*clause->value].span, "a constraint's weight cannot be negative");
  return quantity(model, weight->expr);
}

void elaborate_constraint(Model& model, const ConstrainDeclaration& declaration, const Span& span) {
  Constraint out;
  out.place = place_of(span);
  out.name = statement_name(model, declaration.name, "constraint", model.problem.constraints.size() + 1);
  auto values = residual(model, declaration.relation);
  if (declaration.relation.third) elaborate_numbers(model, *declaration.relation.third, "the right side of a relation");
  if (declaration.relation.kind != Relation::Kind::equal)
    report(model, declaration.relation.span, "inequalities are not built yet: only '=' can be solved so far");
  if (declaration.when)
    report(model, model.scene.nodes[*declaration.when].span, "'when' is not built yet: leave the condition out");
  std::optional<Scope> scope;
  if (declaration.scope) scope = elaborate_scope(model, *declaration.scope);
  out.weight = elaborate_weight(model, declaration.weight, true);
  if (values && (scope || !declaration.scope)) {
    out.scope = scope ? *scope : scope_of(model, *values);
    out.program = add_program(model, place(model, *values), Derivatives::second);
  }
  model.problem.constraints.push_back(std::move(out));
}

}  // namespace spacetime::symbolic
