// Lines of formatted text: cells, set in columns with those of the lines beside them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spacetime::symbolic {

inline constexpr std::size_t line_width = 100;  // characters, comments left out: a line, and a margin for them

struct Cell {
  int column = 0;       // those of one column stand below one another; of a line's first cell it says nothing
  std::size_t gap = 0;  // spaces between it and the cell before, at least
  std::string text;
};

struct Line {
  std::size_t indent = 0;  // spaces
  std::string_view word;   // what its statement begins with: neighbours with one word share columns; empty: none do
  std::vector<Cell> cells;
  std::string_view comment{};
  bool blank_before = false;
};

std::string set_in_columns(std::vector<Line> lines);

}  // namespace spacetime::symbolic
