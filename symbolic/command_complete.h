// The command that tells editors what could be written.
#pragma once

#include "symbolic/command.h"

namespace spacetime::symbolic {

Command add_complete(CLI::App& app);

}  // namespace spacetime::symbolic
