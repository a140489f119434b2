// The names a text declares, as far as it can be read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "symbolic/complete.h"

namespace spacetime::symbolic {

// A name, and the text that declares it.  Creatures' members stand under dotted names: "arm", "arm.elbow", "arm.hand".
struct Visible {
  std::string name;
  Completion::Kind kind = Completion::Kind::let;
  std::string declaration;
};

std::vector<Visible> visible_names(std::string_view text);

}  // namespace spacetime::symbolic
