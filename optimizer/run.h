// Runs a problem's actions and says what came of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::optimizer {

struct RunOptions {
  std::optional<Motion> start;                           // a motion to start from
  std::optional<double> tolerance;                       // in place of the actions' own
  std::optional<int> iterations;                         // likewise
  int threads = 0;                                       // for many starts; as many as there are cores where 0
  double frames_per_second = 0;                          // above 0: the motion has samples
  bool record = false;                                   // the motion has the record of all iterations
  std::function<void(const IterationRecord&)> progress;  // after each iteration
  std::function<bool()> interrupted;                     // asked before each iteration; the motion reached is kept
};

// A problem without actions is solved.  Every outcome leaves a motion.  Throws InputError where the problem makes no
// sense with its constants' values.
Motion run(const Problem& problem, const RunOptions& options);

}  // namespace spacetime::optimizer
