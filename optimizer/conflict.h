// Why there is no feasible motion near: small sets of constraints that cannot hold together.
//
// At the point where restoration found no descent, the violations themselves are multipliers that prove the linearised
// relations A d + c = 0 (<= 0) contradictory: A^T c = 0.  Of the violated relations, statements and then single
// instances are left out as long as what remains is still contradictory within reach of small changes d; what is left
// cannot spare any of its members.  (A deletion filter: Chinneck and Dravnieks 1991.)
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {

// A statement's part in a conflict.
struct Member {
  std::string name;
  int line = 0;
  std::vector<double> times;  // s, of the instances concerned; empty where the relation has none
  double give = 0;            // by how much it would have to give way for the others to hold; its own units, linearised
  bool operator==(const Member&) const = default;
};

struct Conflict {
  std::vector<Member> members;  // no proper subset is contradictory
  std::vector<Member> bounds;   // of degrees of freedom and parameters, that are in the way; `give` is 0
  bool operator==(const Conflict&) const = default;
};

// The conflicts at x, the worst first; a few at most.  `sizes`: by which rows' violations were divided, in KKT
// positions.  Empty where the violated relations are too many or the linearisation does not show the contradiction.
std::vector<Conflict> conflicts(const Transcription& transcription, const Layout& layout, std::span<const double> x,
                                const Values& values, const BorderedMatrix& jacobian, const Eigen::VectorXd& sizes);

// One sentence.
std::string sentence(const Conflict& conflict);

}  // namespace spacetime::optimizer
