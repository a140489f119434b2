// Programs and splines' bases in documents.  The layout is explained in README.md.
#pragma once

#include "common/problem.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

void write(Writer& to, const Program& program);
void write(Writer& to, const Basis& basis);

// These check the form alone; check.h the rest.
Program program_from(const Node& node);
Basis basis_from(const Node& node);

}  // namespace spacetime
