#include "symbolic/command.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "symbolic/colour.h"

namespace spacetime::symbolic {
namespace {

bool is_coloured() {
  const char* plain = std::getenv("NO_COLOR");
  return (!plain || *plain == '\0') && isatty(STDERR_FILENO) == 1;
}

}  // namespace

std::string shown(const std::string& file) { return file == "-" ? "<standard input>" : file; }

void print(const std::vector<Diagnostic>& diagnostics, const std::string& file, std::string_view text) {
  // Columns do not count a byte-order mark.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const bool coloured = is_coloured();
  for (const Diagnostic& diagnostic : diagnostics)
    std::cerr << (coloured ? render_coloured(diagnostic, file, text) : render(diagnostic, file, text));
}

}  // namespace spacetime::symbolic
