// What random problems and motions are made of.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "tests/protocol/examples.h"

namespace spacetime::examples {

inline int below(std::mt19937& random, int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); }
inline bool coin(std::mt19937& random) { return below(random, 2) == 0; }

inline Quantity number(double value) { return {value, {}, 0}; }

// Of a cubic basis on [start, end].
std::vector<double> random_knots(std::mt19937& random, double start, double end);
// Names that a writer must escape, and names in other scripts, now and then.
std::string random_name(std::mt19937& random, const char* prefix, std::size_t index);

}  // namespace spacetime::examples
