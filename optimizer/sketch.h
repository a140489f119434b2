// Where a solve starts: keyframes, declared values, or another motion.
#pragma once

#include <span>
#include <vector>

#include "common/constants.h"
#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::optimizer {

// Coefficients of all degrees of freedom, one after another: a keyed one is the smooth curve through its keys, fitted
// onto its basis; one without keys keeps its declared start.  Throws InputError where a key lies outside the time or
// two keys of one degree of freedom stand at one time.
std::vector<double> sketch(const Problem& problem, const Constants& constants);

// The same from a motion, degree of freedom by degree of freedom and by name: its coefficients where the bases agree,
// else its curve fitted onto the basis.  What the motion does not have keeps the sketch.  Throws InputError where
// coefficients and basis do not match in number.
std::vector<double> sketch_from(const Problem& problem, const Constants& constants, const Motion& motion);

// The monotone cubic through (times, values), constant outside [Fritsch and Butland 1984]: C1, and between two keys
// never beyond them.  Times must rise.
double through_keys(std::span<const double> times, std::span<const double> values, double t);

}  // namespace spacetime::optimizer
