// Actions that change the problem between iterations: pure functions on a Problem.
#pragma once

#include <set>
#include <string>

#include "common/problem.h"

namespace spacetime::optimizer {

// A problem as it stands after some edits, and the names that are switched off for now.
struct Edited {
  Problem problem;
  std::set<std::string> disabled;
};

// Each throws InputError where a name does not exist, a constant is frozen, or a value makes no sense.
void apply(Edited& edited, const SetConstant& set);
void apply(Edited& edited, const SetWeight& weight);
void apply(Edited& edited, const Enable& enable);
void apply(Edited& edited, const Disable& disable);
void apply(Edited& edited, const Delete& remove);
void apply(Edited& edited, const Replace& replace);
void apply(Edited& edited, const Rescope& scope);
void apply(Edited& edited, const Bound& bound);

// What counts just before action number `action`: declared by then, not a replacement in waiting, not switched off.
Problem in_effect(const Edited& edited, int action);

}  // namespace spacetime::optimizer
