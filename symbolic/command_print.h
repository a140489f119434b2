// The commands that show what a scene's expressions are.
#pragma once

#include "symbolic/command.h"

namespace spacetime::symbolic {

Command add_print(CLI::App& app);
Command add_count(CLI::App& app);

}  // namespace spacetime::symbolic
