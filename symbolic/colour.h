// Diagnostics for a terminal: what `render` writes, with the place in bold, `error` in red and the mark in green.
#pragma once

#include <string>
#include <string_view>

#include "common/diagnostic.h"

namespace spacetime::symbolic {

std::string render_coloured(const Diagnostic& diagnostic, std::string_view file, std::string_view text);

}  // namespace spacetime::symbolic
