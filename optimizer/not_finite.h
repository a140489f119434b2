// Where numbers stop being numbers: which expression of which statement, at which time, and what it was applied to.
#pragma once

#include <span>
#include <string>

#include "optimizer/transcription.h"

namespace spacetime::optimizer {

// One sentence on the first value at x that is not finite, or the first derivative where all values are: "sqrt(x - 1)
// is not a number at 0.25 s, in 'goal' (line 12): x - 1 is -0.3 there."  `multipliers`: one a row, or none known;
// `active`: rows that count, or all.  Empty where every sample is finite by itself (a sum of them may still overflow).
std::string why_not_finite(const Transcription& transcription, std::span<const double> x,
                           std::span<const double> multipliers, std::span<const char> active);

// One sentence on the first condition that compares what is no number, and so counts as not holding; or nothing.
std::string undecided_condition(const Transcription& transcription, std::span<const double> x);

}  // namespace spacetime::optimizer
