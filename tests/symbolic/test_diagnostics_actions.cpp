// Wrong actions.
#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "tests/symbolic/wrong.h"

namespace spacetime::symbolic {
namespace {

TEST(Diagnostics, Actions) {
  const std::string goal =
      head + "constant a = 1\nconstrain goal: x = a at 1\nminimize energy: integral(x''^2)\n";  // six lines
  for (const Wrong& wrong : std::vector<Wrong>{
           {goal + "solve method sqp92 linear", 7, 26, "'cg'"},
           {goal + "solve method bfgs linear cg", 7, 14, "'sqp92' alone"},
           {goal + "solve starts 0", 7, 14, "from 1"},
           {goal + "solve iterations 5 iterations 6", 7, 20, "stands twice"},
           {goal + "iterate x", 7, 9, "depends on the motion"},
           {goal + "window [3, 4]", 7, 8, "[3, 4] does not meet the scene's time [0, 2]"},
           {goal + "window [-1, 0]", 7, 8, "does not meet"},
           {goal + "window [1, 0]", 7, 8, "later than its first"},
           {goal + "window [0, 1] of y", 7, 18, "no degree of freedom 'y'"},
           {goal + "window 1", 7, 8, "an interval such as [0, 1]"},
           {goal + "refine [2, 3]", 7, 8, "does not meet"},
           {goal + "refine [0, 1] times 0", 7, 21, "from 1"},
           {goal + "refine auto", 7, 12, "expected 'tolerance'"},
           {goal + "refine auto tolerance 0", 7, 23, "greater than 0"},
           {goal + "shake 0.1", 7, 7, "expected 'amplitude'"},
           {goal + "shake amplitude -1", 7, 17, "greater than 0"},
           {goal + "shake amplitude 1 seed 0.5", 7, 24, "a whole number"},
           {goal + "filter strength 0", 7, 17, "greater than 0"},
           {goal + "damp 0", 7, 6, "greater than 0"},
           {goal + "damp x", 7, 6, "depends on the motion"},
           {goal + "adapt tolerance 0", 7, 17, "greater than 0"},
           {goal + "adapt tolerance 1 levels 0", 7, 26, "from 1"},
           {goal + "lock level -1", 7, 12, "a whole number"},
           {goal + "lock 3", 7, 6, "expected 'level'"},
           {goal + "set b = 1", 7, 5, "no constant 'b' so far"},
           {goal + "constant gravity = 9.81\nset gravty = 1", 8, 5, "did you mean 'gravity'?"},
           {goal + "set x = 1", 7, 5, "'x' is no constant"},
           {goal + "set a = x", 7, 9, "depends on the motion"},
           {goal + "set a = 1/0", 7, 10, "division by zero"},
           {goal + "set a = 3\nconstrain x = 0 at a", 8, 20, "is 3, which lies outside"},
           {goal + "set a = 0\nlet y = x/a", 8, 10, "division by zero"},
           {goal + "constant c = 1/(a + 1)\nset a = -1", 8, 5, "'c', which follows from it, has no finite value"},
           {goal + "weight gaol = 3", 7, 8, "did you mean 'goal'?"},
           {goal + "weight goal = -3", 7, 15, "cannot be negative"},
           {goal + "weight energy = inf", 7, 17, "write a number"},
           {goal + "weight x = 3", 7, 8, "there is no constraint or objective term 'x'"},
           {goal + "enable gaol", 7, 8, "did you mean 'goal'?"},
           {goal + "disable enrgy", 7, 9, "did you mean 'energy'?"},
           {goal + "delete goal\nenable goal", 8, 8, "'goal' has been deleted (line 7)"},
           {goal + "delete goal\nreplace goal: x = 0 at 1", 8, 9, "has been deleted"},
           {goal + "solve\nconstrain late: x = 0 at 1\nminimize late: integral(x)", 9, 10, "names two statements"},
           {head + "enable late\nconstrain late: x = 0 at 1", 4, 8, "no constraint or objective term 'late' so far"},
           {goal + "replace goal: integral(x)", 7, 9, "only a relation can take its place"},
           {goal + "replace energy: x = 0 at 1", 7, 9, "only a functional can take its place"},
           {goal + "replace goal: x = 0 at 5", 7, 24, "outside the scene's time"},
           {goal + "replace nobody: x = 0 at 1", 7, 9, "'nobody'"},
           {goal + "replace goal x = 0", 7, 14, "':' and what replaces it"},
           {goal + "scope goal at 5", 7, 15, "outside the scene's time"},
           {goal + "scope energy at 1", 7, 7, "an objective term, which has no scope"},
           {goal + "scope goal", 7, 11, "a scope: 'at' and times"},
           {goal + "constrain c: at(x, 1) = 3\nscope c at 1.5", 8, 7, "stand inside it"},
           {goal + "bound y in [0, 1]", 7, 7, "no degree of freedom 'y'"},
           {goal + "bound x in [1, 0]", 7, 12, "upper bound must be greater"},
           {goal + "bound x [0, 1]", 7, 9, "expected 'in'"},
           {goal + "key 3: x = 1", 7, 5, "outside the scene's time"},
           {goal + "key 1: x = 1, x = 2", 7, 15, "two keys at this time"},
           {goal + "key 1: x' = 1", 7, 8, "only a degree of freedom can be keyed"},
           {goal + "key 1: x = t", 7, 12, "numbers and constants"},
           {goal + "control y 1 = 0", 7, 9, "no degree of freedom 'y'"},
           {goal + "control x 11 = 0", 7, 11, "'x' has 11 coefficients, numbered from 0"},
           {goal + "control x 1.5 = 0", 7, 11, "a whole number"},
           {goal + "control x 1 = t", 7, 15, "depends on time"},
           {goal + "reset x", 7, 7, "expected the end of the statement"},
           {"trajectory bspline spans 4\nsolve\ntime [0, 2]", 3, 1, "must stand before the first action"},
           {goal + "solve\ntrajectory bspline spans 4 for x", 8, 1, "must stand before the first action"}})
    expect_one(wrong);
}

TEST(Diagnostics, FrozenConstantsNameTheLineThatFrozeThem) {
  for (const auto& [text, line, what] : std::vector<std::tuple<std::string, int, std::string>>{
           {"constant T = 2\ntime [0, T]\ntrajectory bspline spans 8\ndof x\nset T = 3", 2, "'time' on line 2"},
           {"constant a = 1\nconstant T = 2*a\ntime [0, T]\ntrajectory bspline spans 8\ndof x\nset a = 3", 3,
            "'time' on line 3"},
           {"constant n = 8\ntime [0, 1]\ntrajectory bspline spans n\ndof x\nset n = 3", 3, "'trajectory' on line 3"},
           {"constant u = 0.5\ntime [0, 1]\ntrajectory bspline knots [0, u, 1]\ndof x\nset u = 0.3", 3,
            "'trajectory' on line 3"},
           {"constant n = 8\n" + head + "constrain x = 0 over [0, 2] count n\nsolve\nset n = 3", 5,
            "'count' on line 5"}}) {
    const int last = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    expect_one({text, last, 5, what});
    EXPECT_EQ(compile(text).diagnostics.at(0).notes.at(0).span.line, line);
  }
}

}  // namespace
}  // namespace spacetime::symbolic
