// Links of a creature.
#pragma once

#include <optional>

#include "symbolic/creature.h"
#include "symbolic/model.h"

namespace spacetime::symbolic {

// Adds a link, with its degree of freedom where it has one.
void add_link(Model& model, Creature& creature, const LinkDeclaration& declaration);

// Enters a name among the creature's, or reports that it is taken.
void declare_member(Model& model, Creature& creature, const Name& name);

// A link's index, -1 for the ground; reports an unknown one.
std::optional<int> find_link(Model& model, const Creature& creature, const Name& name);

}  // namespace spacetime::symbolic
