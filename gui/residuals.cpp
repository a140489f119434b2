#include "gui/residuals.h"

#include <algorithm>
#include <cmath>

#include "common/sample.h"

namespace spacetime::gui {
namespace {

// None where the constraint has no instances in time, or speaks of functionals, whose values only the optimizer has.
std::vector<Residual> residuals_of(const Equation& equation, const Problem& problem, const Motion& motion,
                                   const std::map<std::string, double>& constants) {
  const auto program = problem.programs.find(equation.program);
  if (program == problem.programs.end() || motion.dofs.empty()) return {};
  const auto is_functional = [](const Input& input) { return input.kind == InputKind::functional; };
  if (std::ranges::any_of(program->second.inputs, is_functional)) return {};
  const std::vector<double> times = times_of(equation.scope, problem, constants, motion.dofs);
  if (times.empty()) return {};
  const Rows rows = along(program->second, Evaluator(program->second), motion, {}, times);
  const std::size_t outputs = program->second.values.size();
  std::vector<Residual> residuals;
  for (std::size_t s = 0; s < times.size(); ++s) {
    double worst = rows(0, s);
    for (std::size_t output = 1; output < outputs; ++output) {
      const double value = rows(static_cast<int>(output), s);
      const bool equal = equation.relation == Constraint::Relation::equal;
      if (equal ? std::abs(value) > std::abs(worst) : value > worst) worst = value;
    }
    residuals.push_back({times[s], worst});
  }
  return residuals;
}

}  // namespace

Residuals residuals_of(const Question& question, const Problem& problem, const Curves& curves) {
  Motion motion;
  motion.dofs = curves.dofs;
  motion.constants.assign(question.constants.begin(), question.constants.end());
  motion.parameters = curves.parameters;
  Residuals out;
  for (const Equation& equation : question.equations)
    out.push_back(equation.objective ? std::vector<Residual>{}
                                     : residuals_of(equation, problem, motion, question.constants));
  return out;
}

}  // namespace spacetime::gui
