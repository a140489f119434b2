// Posing a figure by pulling at it: damped least squares (Buss, "Introduction to inverse kinematics", 2004, section 5;
// Wampler 1986).
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/evaluate.h"
#include "common/motion.h"
#include "common/problem.h"

namespace spacetime::gui {

// Values of degrees of freedom, constants and parameters at one moment, by name.
struct Moment {
  std::map<std::string, double> dofs, constants, parameters;
  double time = 0;
};

// Of a motion at a time (s), with these constants.
Moment moment_of(const Motion& motion, const std::map<std::string, double>& constants, double time);

// A body's pose, its program prepared once.  The problem has to outlive it.
class BodyPose {
 public:
  BodyPose(const Problem& problem, const Body& body);
  // Where a point of the body (in its own axes, metres) is in the world.
  glm::dvec3 place(const Moment& moment, const glm::dvec3& point) const;

 private:
  const Program& program_;
  const std::vector<int>& outputs_;
  Evaluator evaluator_;
};

// The degrees of freedom that the body's pose depends on: those of the joints before it.
std::set<std::string> moving(const Problem& problem, const Body& body);

// The degrees of freedom of `moment` changed so that the point comes as near to `target` as those in `free` allow;
// bounds of the degrees of freedom are kept.
std::map<std::string, double> reach(const Problem& problem, const Body& body, Moment moment, const glm::dvec3& point,
                                    const glm::dvec3& target, const std::vector<std::string>& free,
                                    const std::map<std::string, std::pair<double, double>>& bounds = {});

}  // namespace spacetime::gui
