// The method "sample": numbers of a motion at given times.
#pragma once

#include "optimizer/session.h"
#include "protocol/allowance.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime::optimizer {

// Named expressions, poses of bodies and degrees of freedom with their derivatives.  Throws DocumentError where a time
// is outside the problem's or a name stands for nothing, and the limit's error where it would be too many numbers.
void answer_sample(const Node& params, const Session& session, const protocol::Allowance& allowance, Writer& result);

}  // namespace spacetime::optimizer
