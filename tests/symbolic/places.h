// A problem as if it had not been written anywhere: what two layouts of one scene have in common.
#pragma once

#include "common/problem.h"

namespace spacetime::symbolic {

inline Problem without_places(Problem problem) {
  const auto forget = [](auto& list) {
    for (auto& one : list) one.place = {};
  };
  forget(problem.constants);
  forget(problem.parameters);
  forget(problem.dofs);
  forget(problem.constraints);
  forget(problem.objective);
  forget(problem.keyframes);
  forget(problem.actions);
  for (Constant& constant : problem.constants)
    if (constant.frozen) constant.frozen = Place{};
  return problem;
}

}  // namespace spacetime::symbolic
