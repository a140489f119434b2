// Scenes about two degrees of freedom, x and y, and states of them.
#pragma once

#include <string>

#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {

inline const std::string head = "time [0, 2]\ntrajectory bspline spans 8\ndof x\ndof y\n";

inline State state(double x, double vx, double ax, double y = 0, double vy = 0, double ay = 0) {
  State out;
  out.dofs = {{{"x", 0}, x}, {{"x", 1}, vx}, {{"x", 2}, ax}, {{"y", 0}, y}, {{"y", 1}, vy}, {{"y", 2}, ay}};
  return out;
}

}  // namespace spacetime::symbolic
