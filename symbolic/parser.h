// Scene text to a syntax tree, by recursive descent.
#pragma once

#include <string_view>
#include <vector>

#include "common/diagnostic.h"
#include "symbolic/scene.h"

namespace spacetime::symbolic {

// The tree of everything that could be read.  A mistake costs its statement (inside a creature its item) and is
// reported once; the statements after it are read as if it were not there.
Scene parse(std::string_view text, std::vector<Diagnostic>& diagnostics);

}  // namespace spacetime::symbolic
