// A window's unknowns among those of the whole.  [Cohen92 §3, §4.2]
#pragma once

#include <vector>

#include "optimizer/transcription.h"

namespace spacetime::optimizer {

// `part` is the transcription of a window, `whole` that of all of the same problem, x the unknowns of the whole.

// The unknowns of the part.
std::vector<double> taken(const Transcription& whole, const Transcription& part, const std::vector<double>& x);

// Puts the part's free unknowns back in their places; nothing else is touched.
void put_back(const Transcription& whole, const Transcription& part, const std::vector<double>& of_part,
              std::vector<double>& x);

// Sets what of each functional lies outside the window.  x must have its functionals settled.
void settle_elsewhere(const Transcription& whole, Transcription& part, const std::vector<double>& x);

}  // namespace spacetime::optimizer
