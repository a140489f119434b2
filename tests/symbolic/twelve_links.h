// An arm of twelve links that throws, for measuring and counting what compiling does.
#pragma once

#include <sstream>
#include <string>

namespace spacetime::symbolic {

inline std::string twelve_links(const std::string& goal = "at(arm.hand.x, 1) + at(arm.hand.x', 1)*0.6 = 2.5") {
  std::ostringstream out;
  out << "time [0, 2]\nconstant g = 9.81\ntrajectory bspline spans 64\ncreature arm {\n  gravity (0, -g, 0)\n";
  for (int i = 0; i < 12; ++i)
    out << "  link l" << i << " { revolute q" << i << "; " << (i == 0 ? "offset -pi/2; " : "")
        << "a 0.3; mass 1.0; rod }\n";
  out << "  point hand on l11 (0, 0, 0)\n}\n"
         "constrain rest: (arm.q, arm.q') = 0 at 0, 2\n"
         "constrain reach: -2 <= arm.q11 <= 2 over [0, 2]\n"
         "constrain throw: "
      << goal << "\nminimize energy: integral(dot(arm.force, arm.force))\nkeyframe 1: arm.q0 = 0.8\nsolve\n";
  return out.str();
}

}  // namespace spacetime::symbolic
