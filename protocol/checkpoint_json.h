// A motion's member "checkpoint".
#pragma once

#include "common/motion.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

// The checkpoint of a motion that has one, with its fingerprint.  Numbers that are not finite become null where the
// motion failed.
void write_checkpoint(Writer& to, const Motion& motion);

// The form alone; check.h the rest.  `stamped`: it has a fingerprint, as it must from version 2 of the format on.
Checkpoint checkpoint_from(const Node& node, bool stamped);

// The hash of all numbers that a motion with a checkpoint is gone on with from: equal numbers, equal fingerprint.
std::string fingerprint(const Motion& motion);

}  // namespace spacetime
