// The command that lays scenes out.
#pragma once

#include "symbolic/command.h"

namespace spacetime::symbolic {

Command add_format(CLI::App& app);

}  // namespace spacetime::symbolic
