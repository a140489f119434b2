// Programs, splines' bases, curves and bodies to draw in documents.  The layout is explained in README.md.
#pragma once

#include <map>
#include <string>

#include "common/problem.h"
#include "common/trajectory.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime {

void write(Writer& to, const Program& program);
void write(Writer& to, const Basis& basis);
void write(Writer& to, const Body& body);
void write_programs(Writer& to, const std::map<std::string, Program>& programs);  // the member "programs"
void write(Writer& to, const Trajectory& dof);

// These check the form alone; check.h the rest.
Program program_from(const Node& node);
Basis basis_from(const Node& node);
Body body_from(const Node& node);
std::map<std::string, Program> programs_from(const Node& node);
Trajectory trajectory_from(const Node& node);

}  // namespace spacetime
