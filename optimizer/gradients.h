// The Jacobian by rows, for what is asked after an iteration rather than in it.
#pragma once

#include <utility>
#include <vector>

#include "optimizer/banded.h"
#include "optimizer/layout.h"
#include "optimizer/transcription.h"

namespace spacetime::optimizer {

// Entries (position of an unknown, derivative), by rising position; those that vanish are left out.
using Gradient = std::vector<std::pair<int, double>>;

// One a row of the transcription.
std::vector<Gradient> gradients(const Transcription& transcription, const Layout& layout,
                                const BorderedMatrix& jacobian);

double dot(const Gradient& a, const Gradient& b);

}  // namespace spacetime::optimizer
