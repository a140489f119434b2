#include "symbolic/written_number.h"

#include <array>
#include <charconv>
#include <cmath>

namespace spacetime::symbolic {
namespace {

constexpr std::size_t few_digits = 7;  // a decimal of so many characters is as good as a fraction
constexpr double largest_above = 99, largest_below = 9999;

}  // namespace

std::string written(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

Fraction fraction_of(double number) {
  if (written(number).size() <= few_digits) return {number, 1};
  for (double above = 1; above <= largest_above; ++above) {
    const double below = std::round(above / number);
    if (below < 2 || below > largest_below || (1 / below) * above != number) continue;
    return {above, below};
  }
  return {number, 1};
}

}  // namespace spacetime::symbolic
