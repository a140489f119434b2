#include "optimizer/method.h"

#include <fmt/format.h>

#include "common/diagnostic.h"

namespace spacetime::optimizer {

void refuse_conditions(const Transcription& t, std::string_view method) {
  for (const Conditional& conditional : t.conditionals) {
    const Constraint& constraint = t.problem->constraints[t.rows[conditional.first_row].statement];
    throw InputError(
        fmt::format("the method '{}' knows no conditions on the motion, and '{}' (line {}) has one. Leave out the "
                    "`when`, disable the constraint, or use the method 'newton'",
                    method, constraint.name, constraint.place.line));
  }
}

void refuse_limits(const Transcription& t, std::string_view method) {
  for (const Row& row : t.rows) {
    if (row.kind != Row::Kind::hard || !row.at_most) continue;
    const Constraint& constraint = t.problem->constraints[row.statement];
    throw InputError(
        fmt::format("the method '{}' knows equations only, and '{}' (line {}) is an inequality. Give it a weight, "
                    "disable it, or use the method 'newton'",
                    method, constraint.name, constraint.place.line));
  }
  const auto refuse = [&](const auto& all) {
    for (const auto& unknown : all) {
      if (!unknown.lower && !unknown.upper) continue;
      throw InputError(
          fmt::format("the method '{}' knows no bounds, and '{}' (line {}) has some. Use the method 'newton'", method,
                      unknown.name, unknown.place.line));
    }
  };
  refuse(t.problem->dofs);
  refuse(t.problem->parameters);
}

}  // namespace spacetime::optimizer
