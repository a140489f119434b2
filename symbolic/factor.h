// Sums of terms: like terms added, common factors collected, sorted.
#pragma once

#include <vector>

#include "symbolic/reading_items.h"

namespace spacetime::symbolic {

// The sum of `terms` as one term: a product where all of it could be collected, else a sum (whose sign and common
// number stand outside).
//
//   a x + b x + c   ->  (a + b) x + c       the factor that most terms share first, and all that those terms share
//   x^2 + x         stays: polynomials are read by their powers, so a factor is collected from terms that have as many
Term sum_of(ReadingItems& items, std::vector<Term> terms);

}  // namespace spacetime::symbolic
