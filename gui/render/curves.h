// Numbers along a motion, by name.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::gui {

struct Curve {
  std::string label;
  std::vector<double> values;  // one a time
};

// What `name` stands for, at these times (s, within the motion's span): a degree of freedom, all of a creature's, or
// either's first or second derivative (arm.elbow', arm''), a named expression of the problem, or one that the motion
// has sampled (then between its samples); one curve a component.  Throws InputError for a name that is none of these.
std::vector<Curve> curves_of(const Motion& motion, const Problem* problem, const std::string& name,
                             std::span<const double> times);

}  // namespace spacetime::gui
