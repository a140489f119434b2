// What declarations mean: constants, bases, bounds, parameters, and what is eliminated.
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/symbolic/two_dofs.h"

namespace spacetime::symbolic {
namespace {

TEST(Compile, ConstantsAreInputsAndFollow) {
  const Problem problem = problem_of(head + R"(constant a = 2
constant b = a^2 + 1
constrain c: x = b at a/2, 0.5 weight 3*a
constrain d: x = 0 over [0, b/5] every a/4
minimize x2: b*integral(x^2, 0, a - 1) weight a
keyframe a/2: x = b
)");
  EXPECT_EQ(problem.constants[0].value.number, 2);
  EXPECT_TRUE(problem.constants[0].value.program.empty());
  State now, later;
  later.constants = {{"a", 3}};
  EXPECT_EQ(value_of(problem, problem.constants[1].value, now), 5);
  EXPECT_EQ(value_of(problem, problem.constants[1].value, later), 10);
  const Constraint& c = problem.constraints[0];
  EXPECT_EQ(value_of(problem, c.scope.times[0], now), 1);
  EXPECT_EQ(value_of(problem, c.scope.times[0], later), 1.5);
  EXPECT_EQ(c.scope.times[1], (Quantity{0.5, {}, 0}));
  EXPECT_EQ(value_of(problem, *c.weight, later), 9);
  const Scope& d = problem.constraints[1].scope;
  EXPECT_EQ(d.kind, Scope::Kind::every);
  EXPECT_EQ(value_of(problem, d.to, later), 2);
  EXPECT_EQ(value_of(problem, d.step, later), 0.75);
  const Term& term = problem.objective[0];
  EXPECT_EQ(value_of(problem, term.weight, later), 3);
  EXPECT_EQ(value_of(problem, *term.pieces.at(0).to, later), 2);
  State x3 = state(3, 0, 0);
  EXPECT_EQ(run(problem, term.pieces[0].program, x3), std::vector{45.0});
  x3.constants = {{"a", 3}};
  EXPECT_EQ(run(problem, term.pieces[0].program, x3), std::vector{90.0});
  EXPECT_EQ(value_of(problem, problem.keyframes[0].time, later), 1.5);
  EXPECT_EQ(value_of(problem, problem.keyframes[0].keys[0].value, later), 10);
}

TEST(Compile, BasesAreThoseOfTheStatementBeforeOrTheOneThatNames) {
  const Problem problem = problem_of(R"(constant T = 4
time [1, T]
trajectory bspline spans 3*T
dof a
trajectory bspline knots [1, 1.5, T]
dof b
creature arm { link one { revolute c; a 1 }; link two { revolute d; a 1 } }
trajectory bspline spans 2 for a, arm.d
dof f
trajectory bspline spans 5 for arm
)");
  const auto basis = [&](std::size_t i) { return problem.dofs.at(i).basis; };
  EXPECT_EQ(problem.start, 1);
  EXPECT_EQ(basis(0), uniform_basis(1, 4, 2));
  EXPECT_EQ(basis(1), basis_on(std::vector{1.0, 1.5, 4.0}));
  EXPECT_EQ(problem.dofs[2].name, "arm.c");
  EXPECT_EQ(basis(2), uniform_basis(1, 4, 5));
  EXPECT_EQ(basis(3), uniform_basis(1, 4, 5));
  EXPECT_EQ(basis(4), basis(1));
}

TEST(Compile, BoundsFollowConstants) {
  const Problem problem = problem_of(R"(time [0, 1]
trajectory bspline spans 4
constant a = 2
dof x = 1 in [-a, a]
creature arm { link one { revolute c in [0, 1]; a 1 } }
parameter m = 3 in [a, 4]
dof free
)");
  State later;
  later.constants = {{"a", 3}};
  EXPECT_EQ(value_of(problem, problem.dofs[0].lower.value(), later), -3);
  EXPECT_EQ(value_of(problem, problem.dofs[0].upper.value()), 2);
  EXPECT_EQ(problem.dofs[1].upper, (Quantity{1, {}, 0}));
  EXPECT_FALSE(problem.dofs[2].lower.has_value());
  EXPECT_EQ(value_of(problem, problem.parameters.at(0).lower.value(), later), 3);
  EXPECT_EQ(problem.parameters[0].upper, (Quantity{4, {}, 0}));
}

TEST(Compile, ParametersAreUnknowns) {
  const Problem problem = problem_of(head + R"(constant k = 2
parameter m = 3*k
constrain m*x = m^2 at 1
constrain 1 <= m
minimize energy: m*integral(x^2) + (m - 1)^2
let h = m*x
creature cart { link body { prismatic X axis (1, 0, 0); mass m; sphere m/10 } }
)");
  EXPECT_EQ(problem.parameters.at(0).name, "m");
  EXPECT_EQ(value_of(problem, problem.parameters[0].start), 6);
  State at = state(3, 0, 0);
  at.parameters = {{"m", 5}};
  EXPECT_EQ(run(problem, problem.constraints[0].program, at), std::vector{15.0 - 25});
  EXPECT_EQ(problem.programs.at(problem.constraints[0].program).jacobian.size(), 2U);
  EXPECT_EQ(problem.constraints[1].scope.kind, Scope::Kind::once);
  EXPECT_EQ(run(problem, problem.constraints[1].program, at), std::vector{-4.0});
  const auto& pieces = problem.objective.at(0).pieces;
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(run(problem, pieces[0].program, at), std::vector{45.0});
  EXPECT_EQ(run(problem, pieces[1].program, at), std::vector{16.0});
  EXPECT_EQ(plotted(problem, "h", at), std::vector{15.0});
  at.dofs[{"cart.X", 0}] = at.dofs[{"cart.X", 1}] = 0;
  at.dofs[{"cart.X", 2}] = 7;
  EXPECT_EQ(plotted(problem, "cart.force", at), std::vector{35.0});
  EXPECT_DOUBLE_EQ(value_of(problem, problem.bodies.at(0).size.at(0)), 0.6);  // drawn as it starts
}

TEST(Compile, WhatIsEliminatedIsNoUnknown) {
  const Problem problem = problem_of(head + R"(dof z
eliminate x = sin(y) + t
let h = x''
constrain x' = 1 at 1
minimize integral(x^2 + z^2)
)");
  ASSERT_EQ(problem.dofs.size(), 2U);
  EXPECT_EQ(problem.dofs[0].name, "y");
  EXPECT_EQ(problem.dofs[1].name, "z");
  for (const auto& [key, program] : problem.programs)
    for (const Input& input : program.inputs) EXPECT_NE(input.name, "x");
  State at = state(99, 99, 99, 0.9, 0.2, -0.4);
  at.time = 0.5;
  EXPECT_DOUBLE_EQ(plotted(problem, "x", at).at(0), std::sin(0.9) + 0.5);
  EXPECT_DOUBLE_EQ(plotted(problem, "h", at).at(0), std::cos(0.9) * -0.4 - std::sin(0.9) * 0.2 * 0.2);
  EXPECT_DOUBLE_EQ(run(problem, problem.constraints[0].program, at).at(0), std::cos(0.9) * 0.2);
}

// A pendulum whose second link is kept at a right angle in the world is one whose angle is given.
TEST(Compile, JointsMayBeEliminated) {
  const std::string links = R"(time [0, 2]
trajectory bspline spans 8
creature arm {
  gravity (0, -9.81, 0)
  link a { revolute p; a 1; mass 1; rod }
  link b { revolute r; a 0.5; mass 2; rod }
  point hand on b (0.1, 0, 0)
  force on hand = (-arm.hand.x', arm.r, 0)
}
)";
  const Problem whole = problem_of(links);
  const Problem reduced = problem_of(links + "eliminate arm.r = pi/2 - arm.p^2\nkeyframe 1: arm.p = 1\n");
  ASSERT_EQ(reduced.dofs.size(), 1U);
  const double p = 0.4, v = -0.7, a = 1.3;
  State at, both;
  at.dofs = {{{"arm.p", 0}, p}, {{"arm.p", 1}, v}, {{"arm.p", 2}, a}};
  both.dofs = at.dofs;
  both.dofs[{"arm.r", 0}] = std::numbers::pi / 2 - p * p;
  both.dofs[{"arm.r", 1}] = -2 * p * v;
  both.dofs[{"arm.r", 2}] = -2 * (p * a + v * v);
  for (const std::string name : {"arm.hand", "arm.force", "arm.kinetic", "arm.r.force", "arm.potential", "arm.com"}) {
    const auto expected = plotted(whole, name, both), found = plotted(reduced, name, at);
    ASSERT_EQ(expected.size(), found.size()) << name;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << name;
  }
  EXPECT_DOUBLE_EQ(plotted(reduced, "arm.r", at).at(0), std::numbers::pi / 2 - p * p);
}

TEST(Compile, KeysOfTuplesAndNames) {
  const Problem problem =
      problem_of(head + "keyframe 1: (x, y) = (3, 4)\nkeyframe 2: (x, y) = 0\nkeyframe 0: y = 5, x = 6\n");
  EXPECT_EQ(problem.keyframes[0].keys, (std::vector<Key>{{"x", {3, {}, 0}}, {"y", {4, {}, 0}}}));
  EXPECT_EQ(problem.keyframes[1].keys, (std::vector<Key>{{"x", {0, {}, 0}}, {"y", {0, {}, 0}}}));
  EXPECT_EQ(problem.keyframes[2].keys, (std::vector<Key>{{"y", {5, {}, 0}}, {"x", {6, {}, 0}}}));
}

TEST(Compile, FrozenConstantsSayWhere) {
  const Problem problem = problem_of(
      "constant a = 1\nconstant T = 2*a\nconstant free = 3\ntime [0, T]\ntrajectory bspline spans 8\ndof x\n");
  EXPECT_EQ(problem.constants[0].frozen, (Place{4, 1}));
  EXPECT_EQ(problem.constants[1].frozen, (Place{4, 1}));
  EXPECT_FALSE(problem.constants[2].frozen.has_value());
}

}  // namespace
}  // namespace spacetime::symbolic
