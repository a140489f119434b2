// JSON pointers (RFC 6901): where in a document a value stands.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace spacetime {

// `path` one member further down, its name escaped as RFC 6901 asks, or one element.
std::string below(std::string_view path, std::string_view member);
std::string below(std::string_view path, std::size_t index);

}  // namespace spacetime
