// Many starts, over the cores, and the distinct minima they end in.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "optimizer/newton.h"

namespace spacetime::optimizer {

// How one start ended.  The state is without derivatives, which Newton::complete adds.
struct Ending {
  NewtonState state;
  StepResult result = StepResult::stepped;  // `stepped`: the iterations allowed were used up, or it was cut off
  bool cut = false;                         // all was stopped before it ended by itself
};

// Who does the work.
struct Crew {
  int threads = 1;
  // Called in each thread with what is to be done there, where it is not empty.
  std::function<void(const std::function<void()>& work)> around;
};

// Solves from each start by itself, some at a time in threads of their own.  The endings do not depend on how many
// threads there are.  `wait` is called in this thread, again and again, with what has ended so far: the first starts up
// to the first that has not, so that what is told of them does not depend on the threads either.  Once it returns false
// the others end where they are, and those that had not begun are left out, at the end.  What is thrown in a thread
// ends all and is thrown here.
std::vector<Ending> solve_from(const Transcription& transcription, const Layout& layout,
                               const std::vector<std::vector<double>>& starts, int iterations, double tolerance,
                               const Crew& crew, const std::function<bool(std::span<const Ending> ended)>& wait);

// Whether the first is the better end: feasible before not, converged before not, then the smaller objective.
bool better(const Ending& a, const Ending& b, double tolerance);

// Starts that ended at the same minimum, best first: their indices.  Two are the same where their objectives agree to
// a millionth and their unknowns to a hundredth.
std::vector<std::vector<int>> distinct(const std::vector<Ending>& endings, double tolerance);

}  // namespace spacetime::optimizer
