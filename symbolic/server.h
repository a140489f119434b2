// The compiler as a service: scene text in, problems and diagnostics out.
#pragma once

#include "protocol/service.h"

namespace spacetime::symbolic {

protocol::Service service();

}  // namespace spacetime::symbolic
