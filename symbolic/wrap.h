// Long lines of scene text, broken where the language lets a line go on.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace spacetime::symbolic {

// `line` in lines of at most `width` columns where it can be so broken: behind operators and commas, outside of
// brackets rather than inside.  Further lines are indented by four.
std::string wrapped(std::string_view line, std::size_t width);

}  // namespace spacetime::symbolic
