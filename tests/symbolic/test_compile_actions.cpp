// What actions mean, and declarations that stand behind them.
#include <variant>

#include "tests/symbolic/two_dofs.h"

namespace spacetime::symbolic {
namespace {

TEST(Compile, ActionsInOrder) {
  const Problem problem = problem_of(head + "solve iterations 5 tolerance 1e-6\niterate 0\nsolve method newton\n");
  ASSERT_EQ(problem.actions.size(), 3U);
  EXPECT_EQ(std::get<Solve>(problem.actions[0].action), (Solve{5, 1e-6}));
  EXPECT_EQ(std::get<Iterate>(problem.actions[1].action).iterations, 0);
  EXPECT_EQ(std::get<Solve>(problem.actions[2].action), Solve{});
}

TEST(Compile, EveryAction) {
  const Problem problem = problem_of(head + R"(constant a = 1
constrain goal: x = a at 1
minimize energy: integral(x''^2)
solve method sqp92 linear cg iterations 10 tolerance 1e-6 starts 3
iterate 5
window [a/2, 1] of x, y
window all
refine [0, a] of x times 2
refine auto tolerance a/100
shake amplitude 0.1*a seed 3 of x
filter strength 0.5 of x, x
damp a
adapt tolerance 1e-3 levels 2
lock level 3
set a = a + 1
weight goal = 3*a
weight goal = inf
enable goal
disable energy
replace goal: x = 3 at a weight 2
replace energy: integral(y^2) weight 2
scope goal over [0, a] every a/10
bound x in [-a, a]
key a/2: x = a, y = 2
control x 3 = a
reset
delete goal
)");
  ASSERT_EQ(problem.actions.size(), 24U);
  State now;
  const auto number = [&](const Quantity& q) { return value_of(problem, q, now); };
  const auto action = [&]<class T>(std::size_t i, const T&) { return std::get<T>(problem.actions.at(i).action); };
  const Solve solve = action(0, Solve{});
  EXPECT_EQ(solve, (Solve{10, 1e-6, Solve::Method::sqp92, true, 3}));
  EXPECT_EQ(action(1, Iterate{}).iterations, 5);
  const Window window = action(2, Window{});
  EXPECT_EQ(number(window.interval.value().from), 0.5);
  EXPECT_EQ(window.dofs, (DofNames{"x", "y"}));
  EXPECT_EQ(action(3, Window{}), Window{});
  const Refine refine = action(4, Refine{});
  EXPECT_EQ(number(refine.interval.value().to), 1);
  EXPECT_EQ(refine.times, 2);
  EXPECT_EQ(number(action(5, Refine{}).automatic.value()), 0.01);
  EXPECT_EQ(action(6, Shake{}).seed, 3);
  EXPECT_EQ(number(action(6, Shake{}).amplitude), 0.1);
  EXPECT_EQ(action(7, Smooth{}).dofs, DofNames{"x"});
  EXPECT_EQ(number(action(8, Damp{}).limit), 1);
  EXPECT_EQ(action(9, Adapt{}).levels, 2);
  EXPECT_EQ(action(10, Lock{}).level, 3);
  EXPECT_EQ(action(11, SetConstant{}).constant, "a");
  EXPECT_EQ(number(action(11, SetConstant{}).value), 2);
  now.constants = {{"a", 2}};
  EXPECT_EQ(number(action(12, SetWeight{}).weight.value()), 6);
  EXPECT_FALSE(action(13, SetWeight{}).weight.has_value());
  EXPECT_EQ(action(14, Enable{}).name, "goal");
  EXPECT_EQ(action(15, Disable{}).name, "energy");
  const Constraint& goal = problem.constraints.at(static_cast<std::size_t>(action(16, Replace{}).with));
  EXPECT_TRUE(goal.replacement);
  EXPECT_EQ(goal.name, "goal");
  EXPECT_EQ(goal.since, 16);
  EXPECT_EQ(run(problem, goal.program, state(5, 0, 0)), std::vector{2.0});
  const Term& energy = problem.objective.at(static_cast<std::size_t>(action(17, Replace{}).with));
  EXPECT_TRUE(energy.replacement);
  EXPECT_EQ(energy.weight.number, 2);
  EXPECT_NE(energy.pieces.at(0).program, problem.objective.at(0).pieces.at(0).program);
  EXPECT_EQ(action(18, Rescope{}).scope.kind, Scope::Kind::every);
  EXPECT_EQ(number(action(19, Bound{}).lower), -2);
  const PullKeys keys = action(20, PullKeys{});
  EXPECT_EQ(number(keys.time), 1);
  EXPECT_EQ(keys.keys.at(1), (Key{"y", {2, {}, 0}}));
  EXPECT_EQ(action(21, Control{}).index, 3);
  EXPECT_EQ(action(22, Reset{}), Reset{});
  EXPECT_EQ(action(23, Delete{}).name, "goal");
}

TEST(Compile, KeyframesBehindActionsBeginThere) {
  const Problem problem = problem_of(head + "keyframe 0: x = 1\nsolve\niterate 0\nkeyframe 1: x = 2\nreset\n");
  ASSERT_EQ(problem.keyframes.size(), 2U);
  EXPECT_EQ(problem.keyframes[0].since, 0);
  EXPECT_EQ(problem.keyframes[1].since, 2);
}

TEST(Compile, DeclarationsBehindActionsTakeEffectThere) {
  const Problem problem = problem_of(head + R"(constrain first: x = 0 at 0
solve
constant late = 2
let h = late*x
constrain second: x = late at 1
minimize calm: integral(x''^2)
iterate 3
dof z
constrain x = 0 at 2
minimize integral(x^2)
)");
  EXPECT_EQ(problem.constraints.at(0).since, 0);
  EXPECT_EQ(problem.constraints.at(1).since, 1);
  EXPECT_EQ(problem.constraints.at(2).since, 2);
  EXPECT_EQ(problem.constraints.at(2).name, "constraint 3");
  EXPECT_EQ(problem.objective.at(0).since, 1);
  EXPECT_EQ(problem.objective.at(1).since, 2);
  EXPECT_NE(problem.objective[0].pieces.at(0).program, problem.objective[1].pieces.at(0).program);
  EXPECT_EQ(problem.dofs.size(), 3U);
}

TEST(Compile, ReplacementsDoNotCount) {
  const Problem problem = problem_of(head + "constrain a: x = 0 at 0\nreplace a: x = 1 at 0\nconstrain x = 0 at 1\n");
  EXPECT_EQ(problem.constraints.at(2).name, "constraint 2");
}

TEST(Compile, SetConstantsFollowInLaterStatements) {
  const Problem problem = problem_of(head + R"(constant unused = 7
constant a = 1
constant b = 2*a
constant c = b - unused + 3
set a = 3
iterate a
iterate c + 4
set b = 5
set a = 4
iterate b
)");
  EXPECT_EQ(std::get<Iterate>(problem.actions[1].action).iterations, 3);
  EXPECT_EQ(std::get<Iterate>(problem.actions[2].action).iterations, 6);
  EXPECT_EQ(std::get<Iterate>(problem.actions[5].action).iterations, 5);
}

}  // namespace
}  // namespace spacetime::symbolic
