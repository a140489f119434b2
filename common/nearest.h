// Guessing what was meant.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spacetime {

// The candidates, at most three, that `wrong` is most likely a slip of: nearest in edit distance (insertions,
// deletions, changes and exchanges of neighbours), or the same but for what stands before the last dot.  Empty where
// none is near.
std::vector<std::string> nearest(std::string_view wrong, std::span<const std::string> candidates);

// ": did you mean 'x' or 'y'?" or, where nothing is near, ": " and what else to do.
std::string suggestion(std::string_view wrong, std::span<const std::string> candidates, std::string_view otherwise,
                       char quote = '\'');
// "it is 'a', 'b' or 'c'" for a short list.
std::string one_of(std::span<const std::string> candidates);

}  // namespace spacetime
