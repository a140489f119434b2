// What every method of stepping has in common: where it stands after a step, and what it cannot do.
//
// A method is a class with `start(x)`, which makes a state, and `step(state, tolerance)`, one accepted step.  Newton is
// ours; the papers' own methods (sqp92, bfgs) take the same transcription and the same measures.
#pragma once

#include <string_view>
#include <vector>

#include "common/motion.h"
#include "optimizer/newton.h"

namespace spacetime::optimizer {

// What is told of a step, whatever the method.
struct Standing {
  std::vector<double> x;
  Values values;
  std::vector<double> multipliers;  // one a row, in the sense of  gradient + A^T multipliers = 0; 0 where not known
  Measures measures;
  double step = 0;   // largest change of a coefficient
  double shift = 0;  // correction of the Hessian
  Seconds seconds;   // evaluating and factoring so far
};

// Neither of the papers' methods knows `when`, nor the one of 1992 inequalities.  Both throw InputError, naming the
// first constraint, or bounded degree of freedom or parameter, that is in the way.
void refuse_conditions(const Transcription& transcription, std::string_view method);
void refuse_limits(const Transcription& transcription, std::string_view method);

}  // namespace spacetime::optimizer
