// Where each unknown and each row stands in the KKT matrix.
//
// Unknowns and rows are interleaved in time, a row in the middle of the coefficients it touches: smallest band, and
// pivots that need no exchange.  A coefficient that is much wider than others at its time stands where its support
// ends, so that its row alone is long.  Limits and soft rows have a pivot of their own and stand beside the band.
// What couples distant times (functionals, their rows, rows without a time) stands in the border.
// [design, "The step" and "The border"; optimizer/README.md says where we do otherwise, and why]
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "optimizer/banded.h"
#include "optimizer/transcription.h"

namespace spacetime::optimizer {

struct Layout {
  std::shared_ptr<const Pattern> pattern;
  std::vector<int> of_unknown, of_row;  // positions; -1 for an unknown that is fixed
  std::vector<int> free;                // the unknowns that are not

  int size() const { return pattern->size(); }
};

// How far a direction, in positions, may be gone without any unknown changing by more than it may in one iteration
// (`damp`); infinite where nothing limits it.
double most_length(const Transcription& transcription, const Layout& layout, const Eigen::VectorXd& direction);

// Throws InputError where the matrix would be too large to be factored.
Layout arrange(const Transcription& transcription);

}  // namespace spacetime::optimizer
