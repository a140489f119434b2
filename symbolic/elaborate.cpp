#include "symbolic/action.h"
#include "symbolic/define.h"
#include "symbolic/dof.h"
#include "symbolic/eliminate.h"
#include "symbolic/expression.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

void elaborate_time_span(Model& model, const TimeDeclaration& declaration, const Span& span) {
  if (model.time)
    return report(model, span, "a scene has one 'time': remove one of them", {{*model.time, "the first is here"}});
  model.time = span;
  const auto from = elaborate_fixed(model, declaration.time.from, "the time's start");
  const auto to = elaborate_fixed(model, declaration.time.to, "the time's end");
  if (!from || !to) return;
  if (!(from->value < to->value)) return report(model, declaration.time.span, "the time must end later than it starts");
  freeze(model, from->expr, span, "time");
  freeze(model, to->expr, span, "time");
  model.problem.start = from->value;
  model.problem.end = to->value;
  model.time_known = true;
}

void elaborate_constant(Model& model, const ConstantDeclaration& declaration) {
  const auto value = elaborate_fixed(model, declaration.value, "a constant");
  Symbol symbol;
  if (value) {
    model.problem.constants.push_back(
        {declaration.name.text, quantity(model, value->expr), place_of(declaration.name.span)});
    model.facts.set_constant(declaration.name.text, value->value);
    model.constants.emplace_back(declaration.name.text, value->expr);
    symbol.kind = Symbol::Kind::constant;
    symbol.value = {Value::Kind::numbers, {model.graph.input({InputKind::constant, declaration.name.text, 0, 0})}};
  }
  declare(model, declaration.name, symbol);
}

void elaborate_parameter(Model& model, const ParameterDeclaration& declaration) {
  Parameter out;
  out.name = declaration.name.text;
  out.place = place_of(declaration.name.span);
  const auto start = elaborate_fixed(model, declaration.start, "a parameter's start value");
  if (declaration.bounds)
    if (const auto bounds = elaborate_bounds(model, *declaration.bounds, start))
      out.lower = bounds->lower, out.upper = bounds->upper;
  Symbol symbol;
  if (start) {
    const Expr input = model.graph.input({InputKind::parameter, declaration.name.text, 0, 0});
    out.start = quantity(model, start->expr);
    model.parameter_starts.try_emplace(input, start->expr);
    symbol.kind = Symbol::Kind::parameter;
    symbol.value = {Value::Kind::numbers, {input}};
  }
  model.problem.parameters.push_back(std::move(out));
  declare(model, declaration.name, symbol);
}

void elaborate_dof(Model& model, const DofDeclaration& declaration) {
  const bool fresh = !model.dof_index.contains(declaration.name.text);
  if (fresh) add_dof(model, declaration.name, declaration.start, declaration.bounds);
  Symbol symbol;
  symbol.kind = Symbol::Kind::dof;
  symbol.value = {Value::Kind::numbers, {coordinate_of(model, declaration.name.text).q}};
  declare(model, declaration.name, symbol);
}

void damaged(Model& model, const Statement& statement, const Damaged& what) {
  // What it would have set counts as set, so that its slip is reported once.
  if (statement.word == "time" && !model.time) model.time = statement.span;
  if (statement.word == "trajectory") {
    model.trajectory = static_cast<int>(model.trajectories.size());
    model.trajectories.push_back({statement.span, 1, {}});
  }
  if (what.statement) {
    Named named;
    named.span = what.statement->span;
    named.lost = true;
    model.statement_names.try_emplace(what.statement->text, named);
  }
  if (what.name && !model.symbols.contains(what.name->text) && !is_reserved(what.name->text))
    declare(model, *what.name, {});
}

struct Elaborator {
  Model& model;
  const Statement& statement;

  void operator()(const Damaged& d) const { damaged(model, statement, d); }
  void operator()(const TimeDeclaration& d) const { elaborate_time_span(model, d, statement.span); }
  void operator()(const ConstantDeclaration& d) const { elaborate_constant(model, d); }
  void operator()(const ParameterDeclaration& d) const { elaborate_parameter(model, d); }
  void operator()(const TrajectoryDeclaration& d) const { elaborate_trajectory(model, d, statement.span); }
  void operator()(const DofDeclaration& d) const { elaborate_dof(model, d); }
  void operator()(const LetDeclaration& d) const { elaborate_let(model, d); }
  void operator()(const DefineDeclaration& d) const { elaborate_define(model, d); }
  void operator()(const EliminateDeclaration& d) const { elaborate_eliminate(model, d, statement.span); }
  void operator()(const CreatureDeclaration& d) const { elaborate_creature(model, d, statement.span); }
  void operator()(const ScriptDeclaration& d) const { elaborate_script(model, d, statement.span); }
  void operator()(const ConstrainDeclaration& d) const { elaborate_constraint(model, d, statement.span); }
  void operator()(const MinimizeDeclaration& d) const { elaborate_objective(model, d, statement.span); }
  void operator()(const KeyframeDeclaration& d) const { elaborate_keyframe(model, d, statement.span); }
  template <class Syntax>
  void operator()(const Syntax& syntax) const {
    if (!model.first_action) model.first_action = statement.span;
    if (auto action = action_of(model, syntax))
      model.problem.actions.push_back({std::move(*action), place_of(statement.span)});
  }
};

// What the first action already needs cannot come behind it.
void check_order(Model& model, const Statement& statement) {
  if (!model.first_action) return;
  const auto* trajectory = std::get_if<TrajectoryDeclaration>(&statement.what);
  const bool bases = trajectory && !trajectory->names.empty();
  if (bases || (std::holds_alternative<TimeDeclaration>(statement.what) && !model.time))
    report(model, statement.span,
           quoted(statement.word) + (bases ? " of degrees of freedom that are there already" : std::string()) +
               " must stand before the first action: move it up",
           {{*model.first_action, "the first action is here"}});
}

void note_frozen(Model& model) {
  for (Constant& constant : model.problem.constants) {
    const auto frozen = model.frozen.find(constant.name);
    if (frozen != model.frozen.end()) constant.frozen = place_of(frozen->second.span);
  }
}

}  // namespace

void elaborate_let(Model& model, const LetDeclaration& declaration) {
  Symbol symbol;
  if (auto components = elaborate_numbers(model, declaration.value, "a 'let'")) {
    symbol.kind = Symbol::Kind::let;
    model.lets.emplace_back(declaration.name.text, *components);
    symbol.value = {Value::Kind::numbers, std::move(*components)};
  }
  declare(model, declaration.name, symbol);
}

void elaborate_scene(Model& model) {
  note_declarations(model);
  note_eliminations(model);
  for (const Statement& statement : model.scene.statements) {
    check_order(model, statement);
    std::visit(Elaborator{model, statement}, statement.what);
  }
  if (!model.time) {
    report(model, model.scene.statements.front().span,
           "the scene has no time: begin it with a line such as 'time [0, 2]'");
    return;
  }
  remove_eliminated(model);
  make_bases(model);
  if (model.time_known) check_times(model);
  if (model.diagnostics.empty()) check_coefficients(model);
  if (!model.diagnostics.empty()) return;
  note_frozen(model);
  finish_objective(model);
  add_plots(model);
  add_bodies(model);
}

}  // namespace spacetime::symbolic
