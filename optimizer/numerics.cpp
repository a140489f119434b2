#include "optimizer/numerics.h"

#include <algorithm>

#include "optimizer/batch.h"
#include "optimizer/sketch.h"
#include "optimizer/window.h"

namespace spacetime::optimizer {

Numerics::Numerics(Problem p, const Setting& setting)
    : problem(std::move(p)),
      whole(transcribe(problem)),
      freedom(within(problem, whole.constants, setting.window)),
      part(freedom.whole ? std::nullopt : std::optional(transcribe(problem, freedom))),
      layout(arrange(t())),
      newton(t(), layout) {
  Transcription& iterated = part ? *part : whole;
  for (int dof = 0; dof < iterated.dofs(); ++dof) {
    const auto limit = setting.damping.find(problem.dofs[dof].name);
    if (limit == setting.damping.end()) continue;
    std::fill_n(iterated.most_change.begin() + iterated.first[dof], iterated.first[dof + 1] - iterated.first[dof],
                limit->second);
  }
}

std::vector<double> Numerics::open(std::vector<double>& x) {
  if (!part) return x;
  Workspace workspace;
  settle_functionals(whole, x, workspace);
  settle_elsewhere(whole, *part, x);
  return taken(whole, *part, x);
}

void Numerics::close(const std::vector<double>& own, std::vector<double>& x) const {
  if (part) {
    put_back(whole, *part, own, x);
  } else {
    x = own;
  }
}

double count_unknowns(const Problem& problem) {
  double unknowns = static_cast<double>(problem.parameters.size());
  for (const Dof& dof : problem.dofs) unknowns += dof.basis.size();
  return unknowns;
}

std::vector<double> start_of(const Problem& problem, const Transcription& t, const Motion* from) {
  auto x = from ? sketch_from(problem, t.constants, *from) : sketch(problem, t.constants);
  x.resize(t.unknowns(), 0.0);
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    const Parameter& parameter = problem.parameters[k];
    double& p = x[t.first_parameter() + k];
    p = evaluate(problem, t.constants, parameter.start, "the start of " + parameter.name);
    if (!from) continue;
    for (const auto& [name, value] : from->parameters) {
      if (name == parameter.name) p = value;
    }
  }
  return x;
}

Curves curves_of(const Transcription& whole, const std::vector<double>& x) {
  Curves curves;
  for (int dof = 0; dof < whole.dofs(); ++dof) {
    curves.emplace_back(x.begin() + whole.first[dof], x.begin() + whole.first[dof + 1]);
  }
  return curves;
}

}  // namespace spacetime::optimizer
