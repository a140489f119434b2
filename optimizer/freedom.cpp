#include "optimizer/freedom.h"

#include <fmt/format.h>

#include "common/diagnostic.h"
#include "optimizer/batch.h"

namespace spacetime::optimizer {
namespace {

// Ends of a window that miss a knot by rounding alone, in fractions of the animation's time, count as on it.
constexpr double same_time = 1e-12;

}  // namespace

Freedom all_of(const Problem& problem) {
  Freedom freedom;
  for (const Dof& dof : problem.dofs) freedom.dofs.push_back({0, dof.basis.size()});
  return freedom;
}

Freedom within(const Problem& problem, const Constants& constants, const Window& window) {
  Freedom freedom = all_of(problem);
  if (!window.interval && window.dofs.empty()) return freedom;
  freedom.whole = false;
  const auto [a, b] = span_of(problem, constants, window.interval, "window");
  const auto named = named_dofs(problem, window.dofs);
  const double margin = same_time * (problem.end - problem.start);
  bool any = false;
  for (std::size_t k = 0; k < named.size(); ++k) {
    const auto& knots = problem.dofs[k].basis.knots;
    auto& [from, to] = freedom.dofs[k];
    while (from < to && knots[from] < a - margin) ++from;
    while (from < to && knots[to + 3] > b + margin) --to;
    if (!named[k]) to = from;
    any |= from < to;
  }
  if (!any) {
    throw InputError(
        fmt::format("nothing is free in the window [{}, {}]: no coefficient has its whole support of four knot "
                    "spans inside. Widen the window, or `refine` inside it",
                    a, b));
  }
  return freedom;
}

}  // namespace spacetime::optimizer
