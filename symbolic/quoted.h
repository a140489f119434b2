// Names as messages write them.
#pragma once

#include <string>
#include <string_view>

namespace spacetime::symbolic {

inline std::string quoted(std::string_view name) {
  std::string out(1, '\'');
  out.append(name);
  out.push_back('\'');
  return out;
}

}  // namespace spacetime::symbolic
