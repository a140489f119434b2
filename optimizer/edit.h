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

// Applies whichever of these an action is; false where it is none.
bool apply_edit(Edited& edited, const Action& action);

// The same on a problem that need not be the one it was made for; false, too, where it makes no sense there.
bool apply_where_it_fits(Edited& edited, const Action& action);

// Whether an edit leaves nothing of the one before it, so that a value that is dragged is kept once.
bool replaces(const Action& edit, const Action& before);

// What counts just before action number `action`: declared by then, not a replacement in waiting, not switched off.
Problem in_effect(const Edited& edited, int action);

}  // namespace spacetime::optimizer
