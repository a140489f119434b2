// Names of numbered files.
#pragma once

#include <optional>
#include <string>

namespace spacetime::gui {

// "frames/%04d.png": what stands before and behind the number, and how many digits it has at least.
struct Pattern {
  std::string before, behind;
  int digits = 4;
  std::string file(int number) const;
};

// Nothing for a name without '%'.  Throws InputError for anything but exactly one %d or %0Nd, N from 1 to 9.
std::optional<Pattern> pattern_of(const std::string& name);

}  // namespace spacetime::gui
