#include "gui/question.h"

#include <algorithm>

#include "common/bspline.h"
#include "common/constants.h"
#include "gui/words.h"
#include "protocol/action_json.h"
#include "protocol/json.h"

namespace spacetime::gui {
namespace {

Equation equation_of(const Constraint& constraint) {
  Equation out;
  out.name = constraint.name;
  out.scope = constraint.scope;
  out.line = constraint.place.line;
  out.relation = constraint.relation;
  out.program = constraint.program;
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
    for (const Constant& constant : problem.constants)
      if (const auto value = number(constant.value)) out_.constants[constant.name] = *value;
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

  void after(const Action& action) { std::visit(*this, action); }

  void operator()(const SetConstant& set) {
    if (const auto value = number(set.value)) out_.constants[set.constant] = *value;
  }
  void operator()(const SetWeight& set) {
    if (Equation* equation = named(set.name)) equation->weight = set.weight ? number(*set.weight) : std::nullopt;
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
    if (with >= (equation->objective ? problem_.objective.size() : problem_.constraints.size())) return;
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
    Equation* equation = named(rescope.name);
    if (!equation) return;
    equation->scope = rescope.scope;
    equation->rescoped = true;
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
      if (is_meant(damp.dofs, dof.name)) dof.damping = number(damp.limit);
  }
  void operator()(const Window& window) {
    out_.window.reset();
    if (window.interval)
      out_.window = {number(window.interval->from).value_or(problem_.start),
                     number(window.interval->to).value_or(problem_.end)};
    for (Freedom& dof : out_.dofs) dof.in_window = is_meant(window.dofs, dof.name);
  }
  template <class Other>
  void operator()(const Other&) {}

  Question take() { return std::move(out_); }

 private:
  // No names: all of them.
  static bool is_meant(const DofNames& names, const std::string& name) {
    return names.empty() || is_among(names, name);
  }
  std::optional<double> number(const Quantity& quantity) const { return value_of(quantity, problem_, out_.constants); }
  Equation* named(const std::string& name) {
    const auto found = std::ranges::find(out_.equations, name, &Equation::name);
    return found == out_.equations.end() ? nullptr : &*found;
  }

  const Problem& problem_;
  Question out_;
};

ReadActions read_actions(const State& state) {
  ReadActions out(static_cast<std::size_t>(std::max(0, state.present + 1)));
  for (std::size_t entry = 1; entry < out.size(); ++entry) {
    for (const std::string& text : state.log[entry].actions) {
      out[entry].emplace_back();
      try {
        const Json json = parse(text, "action");
        out[entry].back() = action_from(Node(json, "action")).action;
      } catch (const InputError&) {
        // The optimizer has understood it, so a newer version of this program will.
      }
    }
  }
  return out;
}

}  // namespace

std::string creature_of(const std::string& name) { return name.substr(0, name.find('.')); }

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::optional<double> value_of(const Quantity& quantity, const Problem& problem,
                               const std::map<std::string, double>& constants) {
  try {
    return evaluate(problem, constants, quantity, "a number of the scene");
  } catch (const std::exception&) {
    return std::nullopt;  // a constant that it needs has made it no number, or has no number itself
  }
}

Question question_of(const State& state) {
  if (!state.scene || !state.scene->problem) return {};
  Asking asking(*state.scene->problem);
  // The problem may be of an earlier text: actions that declare nothing leave it as it is.  The log has them all.
  const ReadActions actions = read_actions(state);
  for (std::size_t entry = 1; entry < actions.size(); ++entry)
    for (const std::optional<Action>& action : actions[entry])
      if (action) asking.after(*action);
  Question question = asking.take();
  question.keys = key_marks(state, actions, question.constants);
  for (Equation& equation : question.equations) {
    equation.named = is_given(equation.name);
    const auto statement =
        std::ranges::find_if(state.scene->outline, [&](const Statement& s) { return s.line == equation.line; });
    if (statement != state.scene->outline.end()) equation.text = statement->text;
  }
  return question;
}

std::string scope_text(const Equation& equation, const Problem& problem, const std::map<std::string, double>& constants,
                       std::optional<double> from, std::optional<double> to) {
  const Scope& scope = equation.scope;
  const auto number = [&](const Quantity& quantity) {
    return number_text(value_of(quantity, problem, constants).value_or(0));
  };
  std::string first = number(scope.from), second = number(scope.to), rest;
  if (scope.kind == Scope::Kind::every) rest = " every " + number(scope.step);
  if (scope.kind == Scope::Kind::count) rest = " count " + std::to_string(scope.count);
  // As it was written, constants by their names.
  const std::size_t over = equation.text.rfind("over [");
  if (!equation.rescoped && over != std::string::npos) {
    const std::size_t begin = over + 6;
    std::size_t comma = std::string::npos, end = begin;
    for (int depth = 0; end < equation.text.size() && (depth > 0 || equation.text[end] != ']'); ++end) {
      if (equation.text[end] == '(' || equation.text[end] == '[') ++depth;
      if (equation.text[end] == ')' || equation.text[end] == ']') --depth;
      if (equation.text[end] == ',' && depth == 0) comma = end;
    }
    if (comma != std::string::npos && end < equation.text.size()) {
      first = trimmed(equation.text.substr(begin, comma - begin));
      second = trimmed(equation.text.substr(comma + 1, end - comma - 1));
    }
  }
  if (from) first = number_text(*from);
  if (to) second = number_text(*to);
  return "over [" + first + ", " + second + "]" + rest;
}

std::vector<double> times_of(const Scope& scope, const Problem& problem, const std::map<std::string, double>& constants,
                             const std::vector<Trajectory>& dofs) {
  if (scope.kind == Scope::Kind::once) return {};
  const auto knots = [](const Trajectory& dof) { return dof.basis.knots.size(); };
  const auto finest = std::ranges::max_element(dofs, {}, knots);
  try {
    return scope_times(
        problem, constants, scope,
        finest == dofs.end() ? std::vector<double>{problem.start, problem.end} : breakpoints(finest->basis), "a scope");
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace spacetime::gui
