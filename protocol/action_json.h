// Actions in documents and messages: {"action": "solve", "tolerance": 1e-8}.
#pragma once

#include "common/problem.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

void write(Writer& to, const PlacedAction& action);

// The form alone; check.h the rest.
PlacedAction action_from(const Node& node);

// The member "keys" of a keyframe or of the action `key`.
void write_keys(Writer& to, const std::vector<Key>& keys);
std::vector<Key> keys_from(const Node& node);

}  // namespace spacetime
