// What a peer's problem may be, checked before anything is made of it.
#pragma once

#include "common/action.h"
#include "common/problem.h"
#include "protocol/allowance.h"
#include "protocol/strict.h"

namespace spacetime::optimizer {

double count_unknowns(const Problem& problem);

// Throws the limit's error, or DocumentError where the problem is not in order.
Problem checked_problem(const Node& node, const protocol::Allowance& allowance);

// What a refinement would make is held to what a problem may be.
void require_room(const Problem& problem, const Refine& action, const protocol::Allowance& allowance);

}  // namespace spacetime::optimizer
