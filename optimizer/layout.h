// Where each unknown and each row stands in the KKT matrix.
//
// Unknowns and rows are interleaved in time, a row in the middle of the coefficients it touches: smallest band, and
// pivots that need no exchange.  What couples distant times (functionals, their rows, rows without a time) stands in
// the border.  [design, "The step" and "The border"]
#pragma once

#include <vector>

#include "optimizer/transcription.h"

namespace spacetime::optimizer {

struct Layout {
  int n = 0;                            // size of the band
  int width = 0;                        // its half-width: entries lie at most this far below the diagonal
  int border = 0;                       // positions n ... n + border - 1
  std::vector<int> of_unknown, of_row;  // positions

  int size() const { return n + border; }
};

// Throws InputError where the border would be too wide to be eliminated.
Layout arrange(const Transcription& transcription);

}  // namespace spacetime::optimizer
