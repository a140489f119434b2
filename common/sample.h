// Sampling a motion: named expressions and body poses at given times.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/evaluate.h"
#include "common/motion.h"
#include "common/problem.h"

namespace spacetime {

// A program's values along a motion: one row an output, one column a time.
struct Rows {
  std::vector<double> data;
  std::size_t samples = 0;
  double operator()(int output, std::size_t sample) const { return data[output * samples + sample]; }
};

// The program's values at `times` (s, within the motion's span), the evaluator being the program's.  The motion has the
// trajectories that the program takes; `functionals` the values of the problem's functionals, if it takes any.
Rows along(const Program& program, const Evaluator& evaluator, const Motion& motion,
           std::span<const double> functionals, std::span<const double> times);

// Every plot and body pose of the problem, or those whose names are wanted, along the motion, at `times` (s, within the
// motion's span).  `functionals` has the value of each of the problem's functionals.
Samples sample(const Problem& problem, const Motion& motion, std::span<const double> functionals,
               std::span<const double> times, const std::set<std::string>* wanted = nullptr);

// `count` times from start to end, both among them.
std::vector<double> even_times(double start, double end, int count);

// A row of a table of the samples' at a time, on the line between its neighbours; that of the nearest end outside.
std::vector<double> between(const Samples& samples, const std::vector<std::vector<double>>& rows, double time);

// 0, 1/rate, 2/rate, ... from start, and always end.  Rate in 1/s, positive.
std::vector<double> frame_times(double start, double end, double rate);

}  // namespace spacetime
