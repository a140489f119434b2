// The values of a problem's constants, and of everything that follows from them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"

namespace spacetime {

// By name.
using Constants = std::map<std::string, double>;

// All constants, each evaluated from those before it.  Throws InputError where one is not finite.
Constants evaluate_constants(const Problem& problem);

// A scope's end, a step, a weight, a key: a number or a small program over constants.  `what` names it in the
// InputError thrown where the value is not finite.
double evaluate(const Problem& problem, const Constants& constants, const Quantity& quantity, const std::string& what);

// The times of a scope within the problem's time, in the order of the language (`over [a, b] every h`: a, a+h, ...,
// and always b).  `breakpoints` are the knots that `knots` and `whole` take.  `once` gives one time, not a number.
// Throws InputError where a time lies outside the problem's time, a step is not positive or there are too many.
std::vector<double> scope_times(const Problem& problem, const Constants& constants, const Scope& scope,
                                const std::vector<double>& breakpoints, const std::string& what);

}  // namespace spacetime
