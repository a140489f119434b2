// The optimizer as a service: problems in, motions and iterates out.
#pragma once

#include "protocol/service.h"

namespace spacetime::optimizer {

protocol::Service service();

}  // namespace spacetime::optimizer
