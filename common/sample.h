// Sampling a motion: named expressions and body poses at given times.
#pragma once

#include <span>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime {

// Every plot and body pose of the problem along the motion, at `times` (s, within the motion's span).  `functionals`
// has the value of each of the problem's functionals.
Samples sample(const Problem& problem, const Motion& motion, std::span<const double> functionals,
               std::span<const double> times);

// 0, 1/rate, 2/rate, ... from start, and always end.  Rate in 1/s, positive.
std::vector<double> frame_times(double start, double end, double rate);

}  // namespace spacetime
