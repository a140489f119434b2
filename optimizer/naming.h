// How messages speak of statements and times.
#pragma once

#include <string>
#include <vector>

#include "common/problem.h"
#include "optimizer/transcription.h"

namespace spacetime::optimizer {

// "'goal' (line 12)".
std::string named(const std::string& name, int line);

// "0.5 s"; "0, 0.1 and 0.2 s"; of many the first and the last: "0, 0.1, ..., 1.1 s (12 times)".  Times that are no
// numbers (relations without one) are left out; empty where none is left.
std::string seconds(std::vector<double> times);

// "a", "a and b", "a, b and c", with the last joined by `word`.
std::string listed(const std::vector<std::string>& parts, const std::string& word = "and");

}  // namespace spacetime::optimizer
