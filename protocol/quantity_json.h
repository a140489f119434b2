// Quantities, the times they make, and places in the scene's text, in documents.  The layout is explained in README.md.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "common/quantity.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

void write(Writer& to, const Quantity& quantity);
void write(Writer& to, const Scope& scope);

// Name and value in one; nothing at all for a quantity that is absent.
void member(Writer& to, std::string_view name, const Quantity& quantity);
void member(Writer& to, std::string_view name, const std::optional<Quantity>& quantity);
void member(Writer& to, std::string_view name, const std::vector<Quantity>& quantities);

// These check the form alone; check.h the rest.
Quantity quantity_from(const Node& node);
std::optional<Quantity> optional_quantity(const Node& node, std::string_view name);
Scope scope_from(const Node& node);

// Two optional members, "line" and "column", of what was written there.
void write_place(Writer& to, const Place& place);
Place place_from(const Node& node);

}  // namespace spacetime
