#include "optimizer/server_limits.h"

#include "common/constants.h"
#include "optimizer/refine.h"
#include "protocol/check.h"
#include "protocol/declared.h"
#include "protocol/problem_json.h"

namespace spacetime::optimizer {

double count_unknowns(const Problem& problem) {
  double unknowns = static_cast<double>(problem.parameters.size());
  for (const Dof& dof : problem.dofs) unknowns += dof.basis.size();
  return unknowns;
}

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
  Problem finer = problem;
  Curves flat;
  for (const Dof& dof : problem.dofs) flat.emplace_back(dof.basis.size());
  refine(finer, constants, action, flat);
  if (const auto fault = validate(finer); fault && !validate(problem)) {
    throw protocol::Error(protocol::Code::refused, "the problem would be too large, refine less: " + fault->message);
  }
}

}  // namespace spacetime::optimizer
