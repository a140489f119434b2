// What statements a text has and where each stands, for whoever shows or edits it statement by statement.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "symbolic/scene.h"

namespace spacetime::symbolic {

struct Outlined {
  std::string word;          // that it begins with
  std::string name;          // what it declares or changes; of unnamed constraints and terms "constraint 3"; or empty
  int line = 0, column = 0;  // of its first character, as a span's
  std::size_t begin = 0,
              end = 0;  // bytes of the text, from its first character to behind its last; no comment behind it
  bool action = false;
  bool operator==(const Outlined&) const = default;
};

// In the order of the text; damaged statements too, as far as they reach before the parser goes on.
std::vector<Outlined> outline(const Scene& scene);

}  // namespace spacetime::symbolic
