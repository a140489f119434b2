// What each statement does to the problem.
#pragma once

#include "symbolic/model.h"

namespace spacetime::symbolic {

void elaborate_constraint(Model& model, const ConstrainDeclaration& declaration, const Span& span);  // constraint.cpp
void elaborate_objective(Model& model, const MinimizeDeclaration& declaration, const Span& span);    // objective.cpp
void finish_objective(Model& model);  // the programs that terms share; when all bases are known
void elaborate_keyframe(Model& model, const KeyframeDeclaration& declaration, const Span& span);  // keyframe.cpp
void elaborate_script(Model& model, const ScriptDeclaration& declaration, const Span& span);      // script.cpp
void add_plots(Model& model);                                                                     // plot.cpp
void add_bodies(Model& model);                                                                    // plot.cpp

// A constraint without its name; tells what actions can do with it.
Constraint constraint_of(Model& model, const ConstrainDeclaration& declaration, const Span& span, Named& named);
// Adds a term that has its name and place.
void add_term(Model& model, const MinimizeDeclaration& declaration, Term term);
// Notes what a constraint or an objective term says, in place of what another of this name said before.
void note_stated(Model& model, Stated stated);
void elaborate_let(Model& model, const LetDeclaration& declaration);  // elaborate.cpp
// "name = value, ..." at a time, where that is known; `keyed` tells what has a key already.
std::vector<Key> elaborate_keys(Model& model, const std::vector<Assignment>& assignments, std::optional<double> time,
                                Keyed& keyed);

// A weight, or nothing for a hard constraint.
std::optional<Quantity> elaborate_weight(Model& model, const std::optional<WeightClause>& clause, bool of_constraint);

// Everything, top to bottom, then what has to wait for the end.
void elaborate_scene(Model& model);  // elaborate.cpp

}  // namespace spacetime::symbolic
