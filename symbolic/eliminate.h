// Degrees of freedom that are no unknowns any more: expressions stand in their place.
#pragma once

#include <span>
#include <string>

#include "symbolic/model.h"

namespace spacetime::symbolic {

// Which degrees of freedom the scene is going to eliminate, so that their use before that can be noticed.
void note_eliminations(Model& model);

void elaborate_eliminate(Model& model, const EliminateDeclaration& declaration, const Span& span);

// Notes what is used of the degrees of freedom that are to be eliminated further down.
void note_uses(Model& model, std::span<const Expr> values, const Span& span);

// Reports a degree of freedom that is eliminated, for statements that need an unknown.
bool is_eliminated(Model& model, const std::string& dof, const Span& span);

// When everything has been read: takes them out of the problem.
void remove_eliminated(Model& model);

}  // namespace spacetime::symbolic
