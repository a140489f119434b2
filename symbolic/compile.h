// From scene text to a problem, or to diagnostics: a pure function of the text.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "common/diagnostic.h"
#include "common/problem.h"
#include "symbolic/outline.h"

namespace spacetime::symbolic {

struct Statistics {
  double tree_nodes = 0;         // of everything emitted, counted as a tree
  std::size_t shared_nodes = 0;  // the same, shared
  std::size_t operations = 0;    // in all programs
  std::size_t programs = 0;
  std::size_t derived = 0;  // of these, emitted anew (by a Compiler that remembers the others)
  struct {
    double parse = 0, build = 0, differentiate = 0, emit = 0, total = 0;
  } milliseconds;
};

struct Compilation {
  std::optional<Problem> problem;       // only without diagnostics
  std::vector<Diagnostic> diagnostics;  // in the order of the text
  std::vector<Outlined> outline;        // of what could be read
  Statistics statistics;
};

// In bytes: far above anything written by hand or recorded.  A larger text is refused unread.
inline constexpr std::size_t largest_scene = std::size_t{16} << 20;

Compilation compile(std::string_view text);

}  // namespace spacetime::symbolic
