#include "optimizer/server_limits.h"

#include "common/constants.h"
#include "optimizer/numerics.h"
#include "optimizer/refine.h"
#include "protocol/check.h"
#include "protocol/problem_json.h"

namespace spacetime::optimizer {

Problem checked_problem(const Node& node, const protocol::Allowance& allowance) {
  Problem problem = problem_from(node);
  double operations = 0;
  for (const auto& [name, program] : problem.programs) operations += static_cast<double>(program.op.size());
  if (operations > allowance.operations) throw beyond("operations", allowance, operations);
  if (const double unknowns = count_unknowns(problem); unknowns > allowance.unknowns) {
    throw beyond("unknowns", allowance, unknowns);
  }
  if (const auto fault = validate(problem)) {
    throw DocumentError("params", "/problem" + fault->path, fault->message);
  }
  return problem;
}

void require_room(const Problem& problem, const Refine& action, const protocol::Allowance& allowance) {
  const Constants constants = evaluate_constants(problem);
  const double unknowns =
      refined_coefficients(problem, constants, action) + static_cast<double>(problem.parameters.size());
  if (unknowns > allowance.unknowns) throw beyond("unknowns", allowance, unknowns);
}

}  // namespace spacetime::optimizer
