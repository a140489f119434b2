// Guessing what was meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace spacetime::symbolic {

// The candidate that `wrong` is most likely a slip of: near in edit distance (insertions, deletions, changes and
// exchanges of neighbours), or the same but for what stands before its last dot.  Empty where none is near.
std::string nearest(std::string_view wrong, std::span<const std::string> candidates);

// ": did you mean 'x'?" or, where nothing is near, ": " and what else to do.
std::string suggestion(std::string_view wrong, std::span<const std::string> candidates, std::string_view otherwise);
// "it is 'a', 'b' or 'c'" for a short list.
std::string one_of(std::span<const std::string> candidates);

}  // namespace spacetime::symbolic
