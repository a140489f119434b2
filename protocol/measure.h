// Numbers of a motion that may be none, and numbers by name.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

// What was measured along the motion: a number, or null where the motion failed and there is none.
struct Measures {
  Writer& to;
  bool failed;

  void value(double measure) const {
    if (failed && !std::isfinite(measure)) {
      to.null();
    } else {
      to.number(measure);
    }
  }
  void member(std::string_view name, double measure) const {
    to.key(name);
    value(measure);
  }
  void member(std::string_view name, const std::vector<double>& measures) const {
    to.key(name);
    to.list_of(measures, [&](double measure) { value(measure); });
  }
};

inline double measure_from(const Node& node) {
  return node.is_null() ? std::numeric_limits<double>::quiet_NaN() : node.number();
}

using Named = std::vector<std::pair<std::string, double>>;

inline void member(Writer& to, std::string_view name, const Named& numbers) {
  to.key(name);
  to.object([&] {
    for (const auto& [key, number] : numbers) to.member(key, number);
  });
}

inline Named named(const Node& node, double (*value)(const Node&)) {
  Named result;
  node.members([&](const std::string& name, const Node& number) { result.emplace_back(name, value(number)); });
  return result;
}
inline Named named_numbers(const Node& node) {
  return named(node, [](const Node& number) { return number.number(); });
}

}  // namespace spacetime
