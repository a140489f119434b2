// Which part of spacetime may move, and the data between the whole and such a part.
#pragma once

#include <vector>

#include "common/constants.h"
#include "common/problem.h"

namespace spacetime::optimizer {

// Which part of spacetime is free.
struct Freedom {
  struct Range {
    int from = 0, to = 0;  // coefficients [from, to)
  };
  std::vector<Range> dofs;  // one a degree of freedom
  bool whole = true;        // all of it, parameters among it

  bool has(int dof, int coefficient) const { return dofs[dof].from <= coefficient && coefficient < dofs[dof].to; }
};

// Everything.
Freedom all_of(const Problem& problem);
// The coefficients whose whole support lies within the window's time, of the degrees of freedom it names.  Throws
// InputError where the window does not meet the problem's time or leaves nothing free.
Freedom within(const Problem& problem, const Constants& constants, const Window& window);

}  // namespace spacetime::optimizer
