// By how much constraints are off along a motion, instance by instance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gui/question.h"

namespace spacetime::gui {

struct Residual {
  double time = 0;  // s
  double value =
      0;  // largest component in size; of an inequality what it exceeds its limit by, negative where it holds
};

// None where the constraint has no instances in time, or speaks of functionals, whose values only the optimizer has.
std::vector<Residual> residuals_of(const Equation& equation, const Problem& problem, const Curves& curves,
                                   const std::map<std::string, double>& constants);

// Of each of the question's equations.
using Residuals = std::vector<std::vector<Residual>>;
Residuals residuals_of(const Question& question, const Problem& problem, const Curves& curves);

}  // namespace spacetime::gui
