// By how much constraints are off along a motion, instance by instance.
#pragma once

#include <vector>

#include "gui/question.h"

namespace spacetime::gui {

struct Residual {
  double time = 0;  // s
  double value =
      0;  // largest component in size; of an inequality what it exceeds its limit by, negative where it holds
};

constexpr double met = 1e-6;  // a violation of no more is none to the eye

// Of each of the question's equations; none where one has no instances in time, or speaks of functionals, whose values
// only the optimizer has.
using Residuals = std::vector<std::vector<Residual>>;
Residuals residuals_of(const Question& question, const Problem& problem, const Curves& curves);

}  // namespace spacetime::gui
