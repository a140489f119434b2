// Scene text in its canonical layout.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/diagnostic.h"

namespace spacetime::symbolic {

// The same statements and comments, one statement a line: two spaces inside braces, links on one line where they fit,
// spaces around operators but * / ^, lines broken behind commas and operators, neighbours of one kind in columns, at
// most one blank line at a time.  It depends on the tokens, the comments and the paragraphs alone, not on how they were
// laid out.  Numbers and comments stay as they were written.  Nothing, and diagnostics, where the text has mistakes in
// its form; what it means is not looked at.
struct Formatted {
  std::optional<std::string> text;
  std::vector<Diagnostic> diagnostics;
};
Formatted format(std::string_view text);

}  // namespace spacetime::symbolic
