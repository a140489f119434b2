// What each statement does to the problem.
#pragma once

#include "symbolic/model.h"

namespace spacetime::symbolic {

void elaborate_constraint(Model& model, const ConstrainDeclaration& declaration, const Span& span);  // constraint.cpp
void elaborate_objective(Model& model, const MinimizeDeclaration& declaration, const Span& span);    // objective.cpp
void finish_objective(Model& model);  // the programs that terms share; when all bases are known
void elaborate_keyframe(Model& model, const KeyframeDeclaration& declaration, const Span& span);  // keyframe.cpp
void elaborate_action(Model& model, const Statement& statement);                                  // action.cpp
void add_plots(Model& model);                                                                     // plot.cpp
void add_bodies(Model& model);                                                                    // plot.cpp

// A weight, or nothing for a hard constraint.
std::optional<Quantity> elaborate_weight(Model& model, const std::optional<WeightClause>& clause, bool of_constraint);

// Everything, top to bottom, then what has to wait for the end.
void elaborate_scene(Model& model);  // elaborate.cpp

}  // namespace spacetime::symbolic
