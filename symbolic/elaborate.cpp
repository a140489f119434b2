#include "symbolic/dof.h"
#include "symbolic/expression.h"
#include "symbolic/names.h"
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
    symbol.kind = Symbol::Kind::constant;
    symbol.value = {Value::Kind::numbers, {model.graph.input({InputKind::constant, declaration.name.text, 0, 0})}};
  }
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

void elaborate_let(Model& model, const LetDeclaration& declaration) {
  Symbol symbol;
  if (auto components = elaborate_numbers(model, declaration.value, "a 'let'")) {
    symbol.kind = Symbol::Kind::let;
    symbol.value = {Value::Kind::numbers, std::move(*components)};
    model.lets.push_back(declaration.name.text);
  }
  declare(model, declaration.name, symbol);
}

void refuse(Model& model, const Statement& statement, const Name& name, std::string message) {
  report(model, statement.span, std::move(message));
  declare(model, name, {});
}

void damaged(Model& model, const Statement& statement, const Damaged& what) {
  // What it would have set counts as set, so that its slip is reported once.
  if (statement.word == "time" && !model.time) model.time = statement.span;
  if (statement.word == "trajectory") {
    model.trajectory = static_cast<int>(model.trajectories.size());
    model.trajectories.push_back({statement.span, 1, {}});
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
  void operator()(const ParameterDeclaration& d) const {
    refuse(model, statement, d.name,
           "parameters are not built yet: write 'constant', or 'dof' for what changes in time");
  }
  void operator()(const TrajectoryDeclaration& d) const { elaborate_trajectory(model, d, statement.span); }
  void operator()(const DofDeclaration& d) const { elaborate_dof(model, d); }
  void operator()(const LetDeclaration& d) const { elaborate_let(model, d); }
  void operator()(const DefineDeclaration& d) const {
    refuse(model, statement, d.name,
           "functions of one's own are not built yet: write the expression out, or use 'let'");
  }
  void operator()(const EliminateDeclaration&) const {
    report(model, statement.span, "'eliminate' is not built yet: constrain the degree of freedom instead");
  }
  void operator()(const CreatureDeclaration& d) const { elaborate_creature(model, d, statement.span); }
  void operator()(const ScriptDeclaration& d) const {
    refuse(model, statement, d.name, "scripted bodies are not built yet: write the motion as expressions of t");
  }
  void operator()(const ConstrainDeclaration& d) const { elaborate_constraint(model, d, statement.span); }
  void operator()(const MinimizeDeclaration& d) const { elaborate_objective(model, d, statement.span); }
  void operator()(const KeyframeDeclaration& d) const { elaborate_keyframe(model, d, statement.span); }
  template <class Action>
  void operator()(const Action&) const {
    elaborate_action(model, statement);
  }
};

bool is_declaration(const Statement& statement) { return statement.what.index() >= 1 && statement.what.index() <= 13; }

// Actions come last: the problem holds one set of declarations for all of them.
void check_order(Model& model, const Statement& statement) {
  if (std::holds_alternative<Damaged>(statement.what)) return;
  if (!is_declaration(statement)) {
    if (!model.first_action) model.first_action = statement.span;
  } else if (model.first_action && !model.misplaced) {
    model.misplaced = true;
    report(model, statement.span, "declarations after an action are not built yet: move this one up",
           {{*model.first_action, "the first action is here"}});
  }
}

}  // namespace

void elaborate_scene(Model& model) {
  note_declarations(model);
  for (const Statement& statement : model.scene.statements) {
    check_order(model, statement);
    std::visit(Elaborator{model, statement}, statement.what);
  }
  if (!model.time) {
    report(model, model.scene.statements.front().span,
           "the scene has no time: begin it with a line such as 'time [0, 2]'");
    return;
  }
  make_bases(model);
  if (model.time_known) check_times(model);
  if (!model.diagnostics.empty()) return;
  finish_objective(model);
  add_plots(model);
  add_bodies(model);
}

}  // namespace spacetime::symbolic
