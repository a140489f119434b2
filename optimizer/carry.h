// The dual point across an edit: multipliers and slacks of limits go to the nearest instance of the same constraint.
#pragma once

#include <vector>

#include "optimizer/newton.h"

namespace spacetime::optimizer {

// What the state of one problem says of the rows and unknowns of another that has the same degrees of freedom by name.
Carried carried(const Transcription& from, const Layout& layout, const NewtonState& state, const Transcription& to);

}  // namespace spacetime::optimizer
