// Guessing what was meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spacetime::symbolic {

// The candidate that `wrong` is most likely a slip of: near in edit distance (insertions, deletions, changes and
// exchanges of neighbours), or the same but for what stands before its last dot.  Empty where none is near.
std::string nearest(std::string_view wrong, std::span<const std::string> candidates);

// ": did you mean 'x'?" or nothing.
std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

}  // namespace spacetime::symbolic
