// Names: who has them, and what was meant by the unknown ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "symbolic/model.h"

namespace spacetime::symbolic {

// Enters a name, or reports that it is reserved or already taken.  A lost symbol gives way to any other.
void declare(Model& model, const Name& name, Symbol symbol);

// What a name stands for; reports an unknown one, once.
Value look_up(Model& model, const std::string& name, const Span& span);

// A constraint's or objective term's name: given and entered, or made from its kind and order.
std::string statement_name(Model& model, const std::optional<Name>& name, std::string_view kind, int order,
                           const Named& named);

// The constraint or objective term that an action names; null where there is none, which is reported.
Named* named_statement(Model& model, const Name& name, bool constraints_only = false);

// Every name an expression could use, with creatures' members.
std::vector<std::string> known_names(const Model& model);

// The indices of the degrees of freedom that names mean: a creature means all its own.
std::vector<int> dofs_of(Model& model, const std::vector<Name>& names);
// Their names, each once.
std::vector<std::string> dof_names_of(Model& model, const std::vector<Name>& names);

// Notes where the scene declares what, for advice on use before declaration.
void note_declarations(Model& model);

bool is_reserved(std::string_view name);

// Reports a name that is too long for sentences and documents: a creature's, with a member's and `.force`, must fit
// into the 256 bytes that a document's names have.
inline constexpr std::size_t longest_name = 100;
bool is_too_long(Model& model, const Name& name);

}  // namespace spacetime::symbolic
