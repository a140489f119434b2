// A motion's member "checkpoint".
#pragma once

#include "common/checkpoint.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

// Numbers that are not finite become null where the motion failed.
void write(Writer& to, const Checkpoint& checkpoint, bool failed);

// The form alone; check.h the rest.
Checkpoint checkpoint_from(const Node& node);

}  // namespace spacetime
