// The curve of one degree of freedom.
#pragma once

#include <string>
#include <vector>

#include "common/problem.h"

namespace spacetime {

struct Trajectory {
  std::string name;  // of the degree of freedom
  Basis basis;
  std::vector<double> coefficients;
  bool operator==(const Trajectory&) const = default;
};

}  // namespace spacetime
