// Actions: what a scene, or a message, asks the optimizer to do.
#pragma once

#include <optional>
#include <variant>

namespace spacetime {

// Iterate to convergence.
struct Solve {
  std::optional<int> iterations;  // at most; the optimizer's own limit where absent
  double tolerance = 1e-8;        // largest violation in its own units; relative gradient of the Lagrangian
  bool operator==(const Solve&) const = default;
};

// Exactly this many iterations, or fewer where the tolerance is reached; 0 judges the motion without moving it.
struct Iterate {
  int iterations = 1;
  bool operator==(const Iterate&) const = default;
};

using Action = std::variant<Solve, Iterate>;

}  // namespace spacetime
