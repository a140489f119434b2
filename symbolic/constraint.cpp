#include <algorithm>

#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

using Components = std::vector<Expr>;

struct Side {
  Components components;
  Expr operator[](std::size_t i) const { return components[components.size() == 1 ? 0 : i]; }
};

// The values that are to be 0, or at most 0: left side minus right side of '=' and '<=', by components, a scalar
// standing for a tuple of its like; lo - x and x - hi, component by component, of a chain.
std::optional<Components> residual(Model& model, const Relation& relation) {
  std::vector<Side> sides;
  bool lost = false;
  const auto add = [&](NodeId id, std::string_view what) {
    auto components = elaborate_numbers(model, id, what);
    lost = lost || !components;
    if (components) sides.push_back({std::move(*components)});
  };
  add(relation.left, "the left side of a relation");
  add(relation.right, relation.third ? "the middle of a chain" : "the right side of a relation");
  if (relation.third) add(*relation.third, "the right side of a relation");
  if (lost) return std::nullopt;
  std::size_t size = 1;
  for (const Side& side : sides) {
    const std::size_t n = side.components.size();
    if (n != size && n != 1 && size != 1) {
      report(model, relation.span,
             "the left side has " + std::to_string(size) + " components and the right side " + std::to_string(n) +
                 ": both must have as many, or one of them one");
      return std::nullopt;
    }
    size = std::max(size, n);
  }
  // `>=` is `<=` with its sides exchanged.
  if (relation.kind == Relation::Kind::greater_equal) std::reverse(sides.begin(), sides.end());
  Components out;
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t k = 0; k + 1 < sides.size(); ++k)
      out.push_back(model.graph.subtract(sides[k][i], sides[k + 1][i]));
  return out;
}

// `when`: a condition of time, the motion, constants and parameters.
std::optional<Expr> elaborate_condition(Model& model, NodeId root) {
  const Value value = elaborate(model, root);
  const Span& span = model.scene.nodes[root].span;
  if (value.kind == Value::Kind::lost) return std::nullopt;
  if (value.kind != Value::Kind::condition) {
    report(model, span, "'when' takes a condition, such as 't < 1', but this is " + article(value));
    return std::nullopt;
  }
  if (model.facts.has_functional(value.components[0])) {
    report(model, span, "a condition holds or not at each time: it cannot be made of integral( ) or at( )");
    return std::nullopt;
  }
  return value.components[0];
}

// Without a scope: the whole time, or, where nothing depends on time outside a functional, one instance; that is an
// ordinary one where the functionals are all values at one time.
Scope scope_of(Model& model, Components& values, const std::optional<Expr>& condition) {
  Scope out;
  if (condition && model.facts.timed(*condition)) return out;
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

Constraint constraint_of(Model& model, const ConstrainDeclaration& declaration, const Span& span, Named& named) {
  Constraint out;
  out.place = place_of(span);
  out.since = static_cast<int>(model.problem.actions.size());
  if (declaration.relation.kind != Relation::Kind::equal) out.relation = Constraint::Relation::at_most;
  auto values = residual(model, declaration.relation);
  if (values) named.residuals = *values;
  std::optional<Scope> scope;
  std::optional<Expr> condition;
  if (declaration.scope) scope = elaborate_scope(model, *declaration.scope);
  if (declaration.when) condition = elaborate_condition(model, *declaration.when);
  out.weight = elaborate_weight(model, declaration.weight, true);
  if (condition) out.condition = Condition{add_program(model, std::vector{*condition}, Derivatives::none), 0};
  if (values && (scope || !declaration.scope)) {
    out.scope = scope ? *scope : scope_of(model, *values, condition);
    out.program = add_program(model, place(model, *values), Derivatives::second);
  }
  named.own_times = !declaration.scope && out.scope.kind != Scope::Kind::whole;
  return out;
}

void elaborate_constraint(Model& model, const ConstrainDeclaration& declaration, const Span& span) {
  Named named;
  named.span = declaration.name ? declaration.name->span : span;
  Constraint out = constraint_of(model, declaration, span, named);
  out.name = statement_name(model, declaration.name, "constraint", ++model.constraints, named);
  note_stated(model, {out.name, true, out.relation, std::move(named.residuals)});
  model.problem.constraints.push_back(std::move(out));
}

void note_stated(Model& model, Stated stated) {
  const auto before = std::ranges::find(model.stated, stated.name, &Stated::name);
  if (before != model.stated.end())
    *before = std::move(stated);
  else
    model.stated.push_back(std::move(stated));
}

}  // namespace spacetime::symbolic
