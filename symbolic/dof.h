// Degrees of freedom and the bases of their trajectories.
#pragma once

#include <optional>

#include "symbolic/mechanics.h"
#include "symbolic/model.h"

namespace spacetime::symbolic {

// Adds a degree of freedom on the trajectories declared last; its index.
int add_dof(Model& model, const Name& name, std::optional<NodeId> start, const std::optional<Interval>& bounds);

// Its inputs.
Coordinate coordinate_of(Model& model, const std::string& name);

void elaborate_trajectory(Model& model, const TrajectoryDeclaration& declaration, const Span& span);

// When the scene's time is known: every degree of freedom's basis.
void make_bases(Model& model);

}  // namespace spacetime::symbolic
