#include "gui/question.h"

#include <algorithm>

#include "common/bspline.h"
#include "common/constants.h"

namespace spacetime::gui {
namespace {

Equation equation_of(const Constraint& constraint) {
  Equation out;
  out.name = constraint.name;
  out.scope = constraint.scope;
  out.line = constraint.place.line;
  out.relation = constraint.relation;
  out.program = constraint.program;
  out.conditional = constraint.condition.has_value();
  return out;
}

Equation equation_of(const Term& term) {
  Equation out;
  out.name = term.name;
  out.objective = true;
  out.line = term.place.line;
  return out;
}

// Names with a space are the system's own, by kind and order ("constraint 3").
bool is_given(const std::string& name) { return name.find(' ') == std::string::npos; }

class Asking {
 public:
  explicit Asking(const Problem& problem) : problem_(problem) {
    out_.constants = evaluate_constants(problem);
    for (const Dof& dof : problem.dofs) {
      Freedom freedom;
      freedom.name = dof.name;
      if (dof.lower) freedom.lower = number(*dof.lower);
      if (dof.upper) freedom.upper = number(*dof.upper);
      out_.dofs.push_back(freedom);
    }
    for (const Constraint& constraint : problem.constraints) {
      if (constraint.replacement) continue;
      out_.equations.push_back(equation_of(constraint));
      if (constraint.weight) out_.equations.back().weight = number(*constraint.weight);
    }
    for (const Term& term : problem.objective) {
      if (term.replacement) continue;
      out_.equations.push_back(equation_of(term));
      out_.equations.back().weight = number(term.weight);
    }
  }

  void after(const PlacedAction& placed) { std::visit(*this, placed.action); }

  void operator()(const SetConstant& set) { out_.constants[set.constant] = number(set.value); }
  void operator()(const SetWeight& set) {
    if (Equation* equation = named(set.name))
      equation->weight = set.weight ? std::optional(number(*set.weight)) : std::nullopt;
  }
  void operator()(const Enable& enable) {
    if (Equation* equation = named(enable.name)) equation->enabled = true;
  }
  void operator()(const Disable& disable) {
    if (Equation* equation = named(disable.name)) equation->enabled = false;
  }
  void operator()(const Delete& away) {
    std::erase_if(out_.equations, [&](const Equation& e) { return e.name == away.name; });
  }
  void operator()(const Replace& replace) {
    Equation* equation = named(replace.name);
    if (!equation) return;
    const auto with = static_cast<std::size_t>(replace.with);
    const bool enabled = equation->enabled;
    std::optional<Quantity> weight;
    if (equation->objective) {
      *equation = equation_of(problem_.objective[with]);
      weight = problem_.objective[with].weight;
    } else {
      *equation = equation_of(problem_.constraints[with]);
      weight = problem_.constraints[with].weight;
    }
    equation->name = replace.name;
    equation->enabled = enabled;
    if (weight) equation->weight = number(*weight);
  }
  void operator()(const Rescope& rescope) {
    if (Equation* equation = named(rescope.name)) equation->scope = rescope.scope;
  }
  void operator()(const Bound& bound) {
    for (Freedom& dof : out_.dofs) {
      if (dof.name != bound.dof) continue;
      dof.lower = number(bound.lower);
      dof.upper = number(bound.upper);
    }
  }
  void operator()(const Damp& damp) {
    for (Freedom& dof : out_.dofs)
      if (is_among(damp.dofs, dof.name)) dof.damping = number(damp.limit);
  }
  void operator()(const Window& window) {
    out_.window.reset();
    if (window.interval) out_.window = {number(window.interval->from), number(window.interval->to)};
    for (Freedom& dof : out_.dofs) dof.in_window = is_among(window.dofs, dof.name);
  }
  template <class Other>
  void operator()(const Other&) {}

  Question take() { return std::move(out_); }

 private:
  static bool is_among(const DofNames& names, const std::string& name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
  }
  double number(const Quantity& quantity) const { return value_of(quantity, problem_, out_.constants); }
  Equation* named(const std::string& name) {
    const auto found = std::ranges::find(out_.equations, name, &Equation::name);
    return found == out_.equations.end() ? nullptr : &*found;
  }

  const Problem& problem_;
  Question out_;
};

}  // namespace

double value_of(const Quantity& quantity, const Problem& problem, const std::map<std::string, double>& constants) {
  return evaluate(problem, constants, quantity, "a number of the scene");
}

Question question_of(const Scene& scene) {
  if (!scene.problem) return {};
  Asking asking(*scene.problem);
  for (const PlacedAction& action : scene.problem->actions) asking.after(action);
  Question question = asking.take();
  for (Equation& equation : question.equations) {
    equation.named = is_given(equation.name);
    const auto statement =
        std::ranges::find_if(scene.outline, [&](const Statement& s) { return s.line == equation.line; });
    if (statement != scene.outline.end()) equation.text = statement->text;
  }
  return question;
}

std::vector<double> times_of(const Scope& scope, const Problem& problem, const std::map<std::string, double>& constants,
                             const Basis& basis) {
  if (scope.kind == Scope::Kind::once) return {};
  return scope_times(problem, constants, scope, breakpoints(basis), "a scope");
}

}  // namespace spacetime::gui
