// The times at which a statement holds.
#pragma once

#include <optional>

#include "symbolic/model.h"

namespace spacetime::symbolic {

std::optional<Scope> elaborate_scope(Model& model, const ScopeClause& clause);

// A time made of constants, to be checked against the scene's.
std::optional<Quantity> elaborate_time(Model& model, NodeId root, std::string_view what);

// What a window or a refinement spans, to be checked to meet the scene's time.
std::optional<spacetime::Interval> elaborate_window(Model& model, const Interval& interval, std::string_view what);

// When the scene's time is known: reports the times outside it.
void check_times(Model& model);

}  // namespace spacetime::symbolic
