// What a peer's problem may be, checked before anything is made of it.
#pragma once

#include "common/action.h"
#include "common/problem.h"
#include "protocol/allowance.h"
#include "protocol/strict.h"

namespace spacetime::optimizer {

// Throws the limit's error, or DocumentError where the problem is not in order.
Problem checked_problem(const Node& node, const protocol::Allowance& allowance);

// A refinement's unknowns are counted before anything is made.
void require_room(const Problem& problem, const Refine& action, const protocol::Allowance& allowance);

}  // namespace spacetime::optimizer
