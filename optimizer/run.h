// Runs a problem's actions and says what came of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::optimizer {

// One line of the live table.
struct Progress {
  int iteration = 0;  // summed over all actions
  double objective = 0;
  double violation = 0;     // largest, in its own units
  double stationarity = 0;  // of the Lagrangian, relative
  double step = 0;          // largest change of a coefficient
  double shift = 0;         // inertia correction
  double seconds = 0;       // since the problem was loaded
};

struct RunOptions {
  std::optional<Motion> start;                    // a motion to start from
  std::optional<double> tolerance;                // in place of the actions' own
  std::optional<int> iterations;                  // likewise
  double frames_per_second = 0;                   // above 0: the motion has samples
  std::function<void(const Progress&)> progress;  // after each iteration
  std::function<bool()> interrupted;              // asked before each iteration; the motion reached is kept
};

// A problem without actions is solved.  Every outcome leaves a motion.  Throws InputError where the problem makes no
// sense with its constants' values.
Motion run(const Problem& problem, const RunOptions& options);

}  // namespace spacetime::optimizer
