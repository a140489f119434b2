// Which items of a reading get names.
#pragma once

#include "symbolic/reading.h"

namespace spacetime::symbolic {

void choose_parts(Reading& reading);

}  // namespace spacetime::symbolic
