// Finer knots for the same motion.
#pragma once

#include <vector>

#include "common/constants.h"
#include "common/problem.h"
#include "optimizer/reshape.h"

namespace spacetime::optimizer {

// Halves the knot spans of the degrees of freedom that overlap the interval in more than a point, `times` times; the
// curves do not change.  Throws InputError where the interval does not meet the time or knots would coincide.
void refine(Problem& problem, const Constants& constants, const Refine& action, Curves& curves);

// The most that a refinement may halve: an automatic one's trial, every span of the degrees of freedom once.
Refine most_of(const Refine& action);

// How many coefficients there are then, told before anything is made.  Throws InputError as `refine` does for the
// interval.
double refined_coefficients(const Problem& problem, const Constants& constants, const Refine& action);

// Halves spans of one degree of freedom, listed by their first knots' times, which rise.
void halve(Basis& basis, const std::vector<double>& spans, std::vector<double>& curve);

// The spans, by their first knot's time, on which two curves of one basis differ by more than the tolerance.
std::vector<double> spans_that_differ(const Basis& basis, const std::vector<double>& a, const std::vector<double>& b,
                                      double tolerance);

}  // namespace spacetime::optimizer
