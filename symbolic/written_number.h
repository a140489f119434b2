// Numbers as they are written: as short as they can be and still be the same numbers.
#pragma once

#include <string>

namespace spacetime::symbolic {

std::string written(double number);

// above/below, where that is shorter to write than the number's digits: 1/3 for 0.3333333333333333.  `above` times
// the reciprocal of `below` is the number to the last bit; below is 1 where there is no such fraction.
struct Fraction {
  double above = 1, below = 1;
};
Fraction fraction_of(double number);

}  // namespace spacetime::symbolic
