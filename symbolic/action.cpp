#include <cmath>

#include "symbolic/expression.h"
#include "symbolic/nearest.h"
#include "symbolic/quoted.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

constexpr int most_iterations = 1000000000;

std::optional<Solve> solve_of(Model& model, const SolveAction& action) {
  Solve out;
  const std::size_t mistakes = model.diagnostics.size();
  if (action.method && action.method->text != "newton") {
    static const std::vector<std::string> methods{"newton", "sqp92", "bfgs"};
    const std::string& name = action.method->text;
    report(model, action.method->span,
           name == "sqp92" || name == "bfgs"
               ? "the method " + quoted(name) + " is not built yet: use 'newton', or leave the method out"
               : "there is no method " + quoted(name) + suggestion(name, methods));
  }
  if (action.iterations)
    out.iterations = elaborate_count(model, *action.iterations, "the number of iterations", 0, most_iterations);
  if (action.tolerance) {
    const auto tolerance = elaborate_fixed(model, *action.tolerance, "the tolerance");
    if (tolerance && !(tolerance->value > 0))
      report(model, model.scene.nodes[*action.tolerance].span, "a tolerance must be greater than 0");
    if (tolerance) out.tolerance = tolerance->value;
  }
  if (action.starts)
    report(model, model.scene.nodes[*action.starts].span, "'starts' is not built yet: solve from the one start");
  if (model.diagnostics.size() != mistakes) return std::nullopt;
  return out;
}

}  // namespace

void elaborate_action(Model& model, const Statement& statement) {
  const Place place = place_of(statement.span);
  if (const auto* solve = std::get_if<SolveAction>(&statement.what)) {
    if (const auto action = solve_of(model, *solve)) model.problem.actions.push_back({*action, place});
  } else if (const auto* iterate = std::get_if<IterateAction>(&statement.what)) {
    if (const auto n = elaborate_count(model, iterate->count, "the number of iterations", 0, most_iterations))
      model.problem.actions.push_back({Iterate{*n}, place});
  } else {
    report(model, statement.span,
           "the action " + quoted(statement.word) + " is not built yet: only 'solve' and 'iterate' are");
  }
}

}  // namespace spacetime::symbolic
