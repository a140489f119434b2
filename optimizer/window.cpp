#include "optimizer/window.h"

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {
namespace {

// Calls visit(unknown of the part, unknown of the whole) for all that the part has.
template <typename Visit>
void for_each_unknown(const Transcription& whole, const Transcription& part, Visit visit) {
  for (int dof = 0; dof < part.dofs(); ++dof) {
    for (int u = part.first[dof]; u < part.first[dof + 1]; ++u) {
      visit(u, u - part.origin(dof) + whole.origin(dof));
    }
  }
  for (int u = part.first_functional(); u < part.unknowns(); ++u) {
    visit(u, u - part.first_functional() + whole.first_functional());
  }
}

}  // namespace

std::vector<double> taken(const Transcription& whole, const Transcription& part, const std::vector<double>& x) {
  std::vector<double> result(part.unknowns());
  for_each_unknown(whole, part, [&](int u, int of_whole) { result[u] = x[of_whole]; });
  return result;
}

void put_back(const Transcription& whole, const Transcription& part, const std::vector<double>& of_part,
              std::vector<double>& x) {
  for_each_unknown(whole, part, [&](int u, int of_whole) {
    if (!part.fixed[u]) x[of_whole] = of_part[u];
  });
}

void settle_elsewhere(const Transcription& whole, Transcription& part, const std::vector<double>& x) {
  const auto local = taken(whole, part, x);
  Workspace workspace;
  part.elsewhere.assign(part.functionals(), 0.0);
  const Values values = evaluate(part, local, workspace);
  for (int k = 0; k < part.functionals(); ++k) {
    if (part.functional_row[k] >= 0) part.elsewhere[k] = values.residual[part.functional_row[k]];
  }
}

}  // namespace spacetime::optimizer
