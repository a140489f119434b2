// Runs a problem's actions and says what came of them.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::optimizer {

struct RunOptions {
  std::optional<Motion> start;                           // a motion to start from, or its checkpoint to resume from
  std::optional<double> tolerance;                       // in place of the actions' own
  std::optional<int> iterations;                         // likewise
  int threads = 0;                                       // for many starts; as many as there are cores where 0
  double frames_per_second = 0;                          // above 0: the motion has samples
  bool record = false;                                   // the motion has the record of all iterations
  bool checkpoint = false;                               // ... and a checkpoint (without the problem's fingerprint)
  std::function<void(const IterationRecord&)> progress;  // after each iteration
  std::function<bool()> interrupted;                     // asked before each iteration; the motion reached is kept
};

// A problem without actions is solved.  Every outcome leaves a motion.  A run that was interrupted, or allowed fewer
// iterations, and is resumed from its checkpoint with the other options as they were leaves the motion of one that
// never was, bit for bit but for seconds; a `solve` from many starts is resumed at its beginning, and the motion that
// is left is the one from before it.  Throws InputError where the problem makes no sense with its constants' values, or
// the checkpoint none with the problem.
Motion run(const Problem& problem, const RunOptions& options);

}  // namespace spacetime::optimizer
