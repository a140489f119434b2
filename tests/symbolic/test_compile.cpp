// What scenes mean, looked at through the programs that they become.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {
namespace {

const std::string head = "time [0, 2]\ntrajectory bspline spans 8\ndof x\ndof y\n";

State state(double x, double vx, double ax, double y = 0, double vy = 0, double ay = 0) {
  State out;
  out.dofs = {{{"x", 0}, x}, {{"x", 1}, vx}, {{"x", 2}, ax}, {{"y", 0}, y}, {{"y", 1}, vy}, {{"y", 2}, ay}};
  return out;
}

double let(const std::string& expression, const State& at = state(0.3, -0.7, 1.1, 0.9, 0.2, -0.4)) {
  const auto values = plotted(problem_of(head + "let value = " + expression), "value", at);
  EXPECT_EQ(values.size(), 1U) << expression;
  return values.at(0);
}

TEST(Compile, DoubleIntegrator) {
  const Problem problem = problem_of(file_text("examples/double_integrator.scene"));
  EXPECT_EQ(problem.start, 0);
  EXPECT_EQ(problem.end, 1);
  ASSERT_EQ(problem.dofs.size(), 1U);
  EXPECT_EQ(problem.dofs[0].basis, uniform_basis(0, 1, 64));
  ASSERT_EQ(problem.constraints.size(), 2U);
  EXPECT_EQ(problem.constraints[1].name, "goal");
  EXPECT_EQ(problem.constraints[1].scope.kind, Scope::Kind::times);
  EXPECT_EQ(problem.constraints[1].scope.times[0].number, 1);
  EXPECT_EQ(run(problem, problem.constraints[1].program, state(1.5, 0.25, 9)), (std::vector{0.5, 0.25}));
  ASSERT_EQ(problem.objective.size(), 1U);
  const Piece& piece = problem.objective[0].pieces.at(0);
  EXPECT_EQ(piece.kind, Piece::Kind::integral);
  EXPECT_FALSE(piece.from.has_value());
  EXPECT_EQ(run(problem, piece.program, state(0, 0, 3)), std::vector{9.0});
  EXPECT_EQ(problem.programs.at(piece.program).hessian.size(), 1U);
  ASSERT_EQ(problem.actions.size(), 1U);
  EXPECT_EQ(std::get<Solve>(problem.actions[0].action), Solve{});
  EXPECT_EQ(problem.actions[0].place, (Place{12, 1}));
}

TEST(Compile, ExpressionsMeanWhatTheySay) {
  const double x = 0.3, v = -0.7, y = 0.9;
  EXPECT_DOUBLE_EQ(let("x + 2*y - x/y"), x + 2 * y - x / y);
  EXPECT_DOUBLE_EQ(let("-x^2"), -x * x);
  EXPECT_DOUBLE_EQ(let("y^x'"), std::pow(y, v));
  EXPECT_DOUBLE_EQ(let("2^-2"), 0.25);
  for (const auto& [text, value] :
       std::vector<std::pair<std::string, double>>{{"sin(x)", std::sin(x)},
                                                   {"cos(x)", std::cos(x)},
                                                   {"tan(x)", std::tan(x)},
                                                   {"asin(x)", std::asin(x)},
                                                   {"acos(x)", std::acos(x)},
                                                   {"atan(x)", std::atan(x)},
                                                   {"sinh(x)", std::sinh(x)},
                                                   {"cosh(x)", std::cosh(x)},
                                                   {"tanh(x)", std::tanh(x)},
                                                   {"exp(x)", std::exp(x)},
                                                   {"log(x)", std::log(x)},
                                                   {"sqrt(x)", std::sqrt(x)},
                                                   {"abs(x')", 0.7},
                                                   {"sign(x')", -1},
                                                   {"atan2(x', x)", std::atan2(v, x)},
                                                   {"min(x, y)", x},
                                                   {"max(x, y)", y},
                                                   {"if(x < y, 1, 2)", 1},
                                                   {"if(x >= y, 1, 2)", 2},
                                                   {"if(not x > y and (x <= 0 or y > 0), 1, 2)", 1},
                                                   {"if(0 <= x <= 0.2, 1, 2)", 2},
                                                   {"dot((x, y), (2, 3))", 2 * x + 3 * y},
                                                   {"norm((3*x, 4*x))", 5 * x},
                                                   {"cross((1, 0, 0), (x, y, 2)).z", y},
                                                   {"cross((x, y, 2), (1, 0, 0)).y", 2},
                                                   {"((x, y)*2).y", 2 * y},
                                                   {"(2*(x, y)/4).x", x / 2},
                                                   {"(-(x, y)).y", -y},
                                                   {"((x, y) - (1, 2)).y", y - 2},
                                                   {"((x, (y, 1)), 5).z", 1},
                                                   {"if(x < y, (1, 2), (3, 4)).y", 2},
                                                   {"deg(30)", std::numbers::pi / 6},
                                                   {"e", std::numbers::e},
                                                   {"pi*2", 2 * std::numbers::pi}})
    EXPECT_NEAR(let(text), value, 4e-16 * std::max(1.0, std::abs(value))) << text;
}

TEST(Compile, PiStaysExact) {
  EXPECT_EQ(let("cos(pi/2)"), 0);
  EXPECT_EQ(let("sin(deg(180))"), 0);
}

TEST(Compile, PrimesAreTotalTimeDerivatives) {
  const double x = 0.3, v = -0.7, a = 1.1, t = 1.5;
  State at = state(x, v, a);
  at.time = t;
  EXPECT_DOUBLE_EQ(let("sin(x)'", at), std::cos(x) * v);
  EXPECT_NEAR(let("sin(x)''", at), std::cos(x) * a - std::sin(x) * v * v, 1e-15);
  EXPECT_NEAR(let("(t^2*x)'", at), 2 * t * x + t * t * v, 1e-15);
  EXPECT_NEAR(let("(x, t*x).y'", at), x + t * v, 1e-15);
  const auto h = plotted(problem_of(head + "let h = sin(x)\nlet k = h'"), "k", at);
  EXPECT_DOUBLE_EQ(h.at(0), std::cos(x) * v);
}

TEST(Compile, WhatIsNotChosenDoesNotSpoil) { EXPECT_EQ(let("if(x < 1, 2, sqrt(x - 1))"), 2); }

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

TEST(Compile, ScopesOfEveryKind) {
  const Problem problem = problem_of(head + R"(constrain x = 0 at 0, 1, 2
constrain x = 0 over [0, 1] every 0.25
constrain x = 0 over [0, 1] count 5
constrain x = 0 over [0, 1]
constrain x = 0
constrain t*x = 0
)");
  using Kind = Scope::Kind;
  const Kind expected[] = {Kind::times, Kind::every, Kind::count, Kind::knots, Kind::whole, Kind::whole};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(problem.constraints[i].scope.kind, expected[i]) << i;
  EXPECT_EQ(problem.constraints[0].scope.times.size(), 3U);
  EXPECT_EQ(problem.constraints[2].scope.count, 5);
}

TEST(Compile, UnnamedStatementsAreCalledByKindAndOrder) {
  const Problem problem = problem_of(head +
                                     "constrain x = 0 at 0\nconstrain a: x = 0 at 1\nconstrain x = 0 at 2\n"
                                     "minimize b: integral(x)\nminimize integral(y)\n");
  EXPECT_EQ(problem.constraints[0].name, "constraint 1");
  EXPECT_EQ(problem.constraints[2].name, "constraint 3");
  EXPECT_EQ(problem.objective[1].name, "objective 2");
}

TEST(Compile, AScalarStandsForATupleOfItsLike) {
  const Problem problem = problem_of(head + "constrain (x, y) = 1 at 0\nconstrain 2 = (x, y, x) at 0\n");
  EXPECT_EQ(run(problem, problem.constraints[0].program, state(3, 0, 0, 5)), (std::vector{2.0, 4.0}));
  EXPECT_EQ(run(problem, problem.constraints[1].program, state(3, 0, 0, 5)), (std::vector{-1.0, -3.0, -1.0}));
}

TEST(Compile, WeightsMakeConstraintsSoft) {
  const Problem problem =
      problem_of(head + "constrain x = 0 at 0 weight 2\nconstrain x = 0 at 1 weight inf\nconstrain x = 1 at 2\n");
  EXPECT_EQ(problem.constraints[0].weight, (Quantity{2, {}, 0}));
  EXPECT_FALSE(problem.constraints[1].weight.has_value());
  EXPECT_FALSE(problem.constraints[2].weight.has_value());
}

TEST(Compile, ARelationAtOneTimeIsAnOrdinaryInstance) {
  const Problem problem = problem_of(head + "constant s = 1\nconstrain at(x, s) + at(x', s)*0.5 = at(y, s) + 2\n");
  EXPECT_TRUE(problem.functionals.empty());
  const Constraint& constraint = problem.constraints[0];
  EXPECT_EQ(constraint.scope.kind, Scope::Kind::times);
  EXPECT_EQ(value_of(problem, constraint.scope.times.at(0)), 1);
  EXPECT_DOUBLE_EQ(run(problem, constraint.program, state(3, 4, 0, 7)).at(0), 3 + 4 * 0.5 - 7 - 2);
}

TEST(Compile, RelationsOverSeveralTimesUseFunctionals) {
  const Problem problem = problem_of(head + R"(constrain at(x, 0) = at(x, 2)
constrain integral(x) + integral(x, 0, 1)*at(x, 2) = 3
constrain x = at(y, 1) over [0, 1] count 3
constrain at(x*integral(y^2), 1) = integral(x)
)");
  ASSERT_EQ(problem.functionals.size(), 7U);
  EXPECT_EQ(problem.constraints[0].scope.kind, Scope::Kind::once);
  EXPECT_EQ(problem.constraints[1].scope.kind, Scope::Kind::once);
  EXPECT_EQ(problem.constraints[2].scope.kind, Scope::Kind::count);
  State at;
  at.functionals = {1, 2, 4, 8, 16, 32, 64};
  EXPECT_EQ(run(problem, problem.constraints[0].program, at), std::vector{-1.0});
  // at(x, 2) is the second functional, shared by both statements.
  EXPECT_EQ(problem.functionals[1].kind, Functional::Kind::at);
  EXPECT_EQ(problem.functionals[1].from->number, 2);
  EXPECT_EQ(run(problem, problem.constraints[1].program, at), std::vector{4.0 + 8.0 * 2.0 - 3.0});
  EXPECT_EQ(problem.functionals[3].to->number, 1);
  State moving = state(3, 0, 0);
  moving.functionals = at.functionals;
  EXPECT_EQ(run(problem, problem.constraints[2].program, moving), std::vector{3.0 - 16.0});
  // The inner integral stands before the value that is made with it.
  moving = state(3, 0, 0, 5);
  moving.functionals = at.functionals;
  EXPECT_EQ(run(problem, problem.functionals[5].program, moving), std::vector{25.0});
  EXPECT_EQ(run(problem, problem.functionals[6].program, moving), std::vector{3.0 * 32.0});
  EXPECT_EQ(run(problem, problem.constraints[3].program, at), std::vector{64.0 - 4.0});
}

TEST(Compile, NestedFunctionalsAtOneTimeAreTakenOut) {
  const Problem problem = problem_of(head + "constrain at(x*integral(y), 1) = 2\n");
  ASSERT_EQ(problem.functionals.size(), 1U);
  EXPECT_EQ(problem.constraints[0].scope.kind, Scope::Kind::times);
  State at = state(3, 0, 0);
  at.functionals = {4};
  EXPECT_EQ(run(problem, problem.constraints[0].program, at), std::vector{10.0});
}

TEST(Compile, ObjectivesAreTakenApartIntoPieces) {
  const Problem problem = problem_of(head + R"(constant k = 2
minimize a: k*integral(x^2) - integral(y)/4 + 3*at(x, 1) + integral(x, 0, 1) + 5
minimize b: at(x, 1)^2*at(y, 1)
minimize c: integral(x)^2 + 2*integral(y)
minimize d: integral(x + y)
minimize z: 0
)");
  const auto& a = problem.objective[0].pieces;
  ASSERT_EQ(a.size(), 4U);
  EXPECT_EQ(a[0].kind, Piece::Kind::integral);
  EXPECT_EQ(a[1].kind, Piece::Kind::at);
  EXPECT_EQ(a[1].from->number, 1);
  EXPECT_EQ(a[2].to->number, 1);
  EXPECT_EQ(a[3].kind, Piece::Kind::once);
  const State at = state(3, 0, 0, 7);
  const auto piece = [&](const Piece& p, const State& s) {
    return run(problem, p.program, s).at(static_cast<std::size_t>(p.output));
  };
  EXPECT_EQ(piece(a[0], at), 2 * 9 - 7.0 / 4);
  EXPECT_EQ(piece(a[1], at), 9);
  EXPECT_EQ(piece(a[2], at), 3);
  EXPECT_EQ(piece(a[3], at), 5);
  const auto& b = problem.objective[1].pieces;
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(b[0].kind, Piece::Kind::at);
  EXPECT_EQ(piece(b[0], at), 63);
  const auto& c = problem.objective[2].pieces;
  ASSERT_EQ(c.size(), 2U);
  EXPECT_EQ(piece(c[0], at), 14);
  EXPECT_EQ(c[1].kind, Piece::Kind::once);
  State once;
  once.functionals = {5};
  ASSERT_EQ(problem.functionals.size(), 1U);
  EXPECT_EQ(piece(c[1], once), 25);
  // Integrals over the whole time share a program; the one over [0, 1] has its own.
  EXPECT_EQ(a[0].program, c[0].program);
  EXPECT_EQ(a[0].program, problem.objective[3].pieces[0].program);
  EXPECT_NE(a[0].program, a[2].program);
  EXPECT_EQ(piece(problem.objective[3].pieces[0], at), 10);
  EXPECT_EQ(piece(problem.objective[4].pieces.at(0), at), 0);
}

TEST(Compile, TermsOnDifferentKnotsDoNotShareAProgram) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\ntrajectory bspline spans 9\ndof y\n"
      "minimize integral(x^2)\nminimize integral(y^2)\nminimize integral(x'^2)\n");
  const auto program = [&](std::size_t i) { return problem.objective[i].pieces.at(0).program; };
  EXPECT_NE(program(0), program(1));
  EXPECT_EQ(program(0), program(2));
}

TEST(Compile, EveryLetIsPlottedUnlessItIsNoCurve) {
  const Problem problem = problem_of(head + "let h = x^2\nlet p = (x, h)\nlet J = integral(x^2)\nminimize J\n");
  ASSERT_EQ(problem.plots.size(), 2U);
  EXPECT_EQ(plotted(problem, "p", state(0.5, 0, 0)), (std::vector{0.5, 0.25}));
  EXPECT_TRUE(problem.functionals.empty());
}

TEST(Compile, KeysOfTuplesAndNames) {
  const Problem problem =
      problem_of(head + "keyframe 1: (x, y) = (3, 4)\nkeyframe 2: (x, y) = 0\nkeyframe 0: y = 5, x = 6\n");
  EXPECT_EQ(problem.keyframes[0].keys, (std::vector<Key>{{"x", {3, {}, 0}}, {"y", {4, {}, 0}}}));
  EXPECT_EQ(problem.keyframes[1].keys, (std::vector<Key>{{"x", {0, {}, 0}}, {"y", {0, {}, 0}}}));
  EXPECT_EQ(problem.keyframes[2].keys, (std::vector<Key>{{"y", {5, {}, 0}}, {"x", {6, {}, 0}}}));
}

TEST(Compile, KeyframesBehindActionsBeginThere) {
  const Problem problem = problem_of(head + "keyframe 0: x = 1\nsolve\niterate 0\nkeyframe 1: x = 2\nreset\n");
  ASSERT_EQ(problem.keyframes.size(), 2U);
  EXPECT_EQ(problem.keyframes[0].since, 0);
  EXPECT_EQ(problem.keyframes[1].since, 2);
}

TEST(Compile, ActionsInOrder) {
  const Problem problem = problem_of(head + "solve iterations 5 tolerance 1e-6\niterate 0\nsolve method newton\n");
  ASSERT_EQ(problem.actions.size(), 3U);
  EXPECT_EQ(std::get<Solve>(problem.actions[0].action), (Solve{5, 1e-6}));
  EXPECT_EQ(std::get<Iterate>(problem.actions[1].action).iterations, 0);
  EXPECT_EQ(std::get<Solve>(problem.actions[2].action), Solve{});
}

TEST(Compile, InequalitiesAreAtMostZero) {
  const Problem problem = problem_of(head + R"(constrain x <= y at 0
constrain x >= y at 0 weight 2
constrain -1 <= (x, y) <= (2, 3) over [0, 1]
constrain 5 >= x >= 4 at 0
constrain x = 1 at 0
)");
  using Relation = Constraint::Relation;
  const State at = state(3, 0, 0, 7);
  const auto values = [&](std::size_t i) { return run(problem, problem.constraints.at(i).program, at); };
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(problem.constraints[i].relation, Relation::at_most) << i;
  EXPECT_EQ(problem.constraints[4].relation, Relation::equal);
  EXPECT_EQ(values(0), std::vector{-4.0});
  EXPECT_EQ(values(1), std::vector{4.0});
  EXPECT_EQ(problem.constraints[1].weight, (Quantity{2, {}, 0}));
  EXPECT_EQ(values(2), (std::vector{-1.0 - 3, 3.0 - 2, -1.0 - 7, 7.0 - 3}));
  EXPECT_EQ(values(3), (std::vector{4.0 - 3, 3.0 - 5}));
  EXPECT_FALSE(problem.programs.at(problem.constraints[2].program).jacobian.empty());
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

TEST(Compile, ConditionsAreProgramsOfOneOutput) {
  const Problem problem = problem_of(head + R"(constant a = 1
constrain x >= 0 when t < a
constrain x = 0 over [0, 1] when not (y > 0 and t < 1)
constrain 2 = a when t < 1
constrain x = 0 at 0
)");
  State now = state(0, 0, 0, 1), later = now;
  now.time = 0.5, later.time = 1.5;
  const auto holds = [&](std::size_t i, const State& at) {
    const Condition& condition = problem.constraints.at(i).condition.value();
    const Program& program = problem.programs.at(condition.program);
    EXPECT_EQ(program.values.size(), 1U);
    EXPECT_TRUE(program.jacobian.empty());
    return run(problem, condition.program, at).at(0) != 0;
  };
  EXPECT_TRUE(holds(0, now));
  EXPECT_FALSE(holds(0, later));
  later.constants = {{"a", 2}};
  EXPECT_TRUE(holds(0, later));
  EXPECT_FALSE(holds(1, now));
  EXPECT_TRUE(holds(1, later));
  // What depends on time through its condition alone holds over time.
  EXPECT_EQ(problem.constraints[2].scope.kind, Scope::Kind::whole);
  EXPECT_FALSE(problem.constraints[3].condition.has_value());
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

TEST(Compile, FunctionsOfOnesOwnTakeAnything) {
  const State at = state(0.3, -0.7, 1.1, 0.9, 0.2, -0.4);
  const std::string functions = head + R"(constant k = 2
define square(a) = k*a^2
define far(p, q) = norm(p - q) > 1
define pair(a) = (a, square(a))
define rate(a) = a'
define mean(a) = integral(a)/2
)";
  const auto value = [&](const std::string& expression) {
    return plotted(problem_of(functions + "let value = " + expression), "value", at);
  };
  EXPECT_DOUBLE_EQ(value("square(x + y)").at(0), 2 * 1.2 * 1.2);
  EXPECT_DOUBLE_EQ(value("pair(square(x)).y").at(0), 2 * std::pow(2 * 0.3 * 0.3, 2));
  EXPECT_EQ(value("if(far((x, y), (1, 2)), 1, 0)"), std::vector{1.0});
  EXPECT_DOUBLE_EQ(value("rate(x^2)").at(0), 2 * 0.3 * -0.7);
  EXPECT_DOUBLE_EQ(value("square(square(x)')").at(0), 2 * std::pow(4 * 0.3 * -0.7, 2));
  EXPECT_EQ(problem_of(functions + "minimize mean(x^2)").objective[0].pieces[0].kind, Piece::Kind::integral);
}

TEST(Compile, FunctionsCannotMakeAScenesWorkEndless) {
  std::ostringstream text;
  text << head << "define f0(a) = a + x\n";
  for (int i = 1; i < 60; ++i)
    text << "define f" << i << "(a) = sin(f" << i - 1 << "(a + 1)) + cos(f" << i - 1 << "(2*a))\n";
  const auto result = compile(text.str() + "let z = f59(x)\n");
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_NE(result.diagnostics[0].message.find("too large"), std::string::npos);
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

TEST(Compile, FrozenConstantsSayWhere) {
  const Problem problem = problem_of(
      "constant a = 1\nconstant T = 2*a\nconstant free = 3\ntime [0, T]\ntrajectory bspline spans 8\ndof x\n");
  EXPECT_EQ(problem.constants[0].frozen, (Place{4, 1}));
  EXPECT_EQ(problem.constants[1].frozen, (Place{4, 1}));
  EXPECT_FALSE(problem.constants[2].frozen.has_value());
}

TEST(Compile, IsAPureFunctionOfTheText) {
  for (const std::string file : {"examples/throw.scene", "examples/player_craig.scene"}) {
    const std::string text = file_text(file);
    const Problem once = problem_of(text), again = problem_of(text);
    EXPECT_EQ(once, again) << file;
  }
}

TEST(Compile, AnEditOfOneStatementKeepsThePrograms) {
  const Problem one = problem_of(head + "constrain x^2 = y at 0\nminimize integral(x''^2)\n");
  const Problem two =
      problem_of(head + "let unused = x*y\nconstrain y = 3 at 0\nconstrain x^2 = y at 1\nminimize integral(x''^2)\n");
  EXPECT_EQ(one.constraints[0].program, two.constraints[1].program);
  EXPECT_EQ(one.objective[0].pieces[0].program, two.objective[0].pieces[0].program);
  // What is declared before has made parts of the relation in another order.
  const std::string relation = "constrain sin(x)*(y - x) + cos(y)*(x' - y) - x*y = 0 at 0\n";
  const Problem plain = problem_of(head + relation);
  const Problem reordered = problem_of(head + "let a = x*y - cos(y)\nlet b = (x - y)*(y - x')\n" + relation);
  EXPECT_EQ(plain.constraints[0].program, reordered.constraints[0].program);
}

TEST(Compile, StatisticsCountWhatWasEmitted) {
  const auto statistics = compile(file_text("examples/throw_eliminated.scene")).statistics;
  EXPECT_EQ(statistics.programs, problem_of(file_text("examples/throw_eliminated.scene")).programs.size());
  EXPECT_GT(statistics.tree_nodes, 10.0 * static_cast<double>(statistics.shared_nodes));
  EXPECT_GT(statistics.shared_nodes, statistics.operations);
  EXPECT_GT(statistics.milliseconds.differentiate, 0);
  EXPECT_GE(statistics.milliseconds.total, statistics.milliseconds.parse);
}

TEST(Compile, LongAndWideScenesAreNoTrouble) {
  std::string sum = head + "let s = x";
  for (int i = 0; i < 20000; ++i) sum += " + " + std::to_string(i) + "*sin(x + " + std::to_string(i % 7) + ")";
  EXPECT_TRUE(compile(sum).problem.has_value());
  std::string doubled = head + "let a0 = (x, x)\n";
  for (int i = 1; i < 60; ++i)
    doubled += "let a" + std::to_string(i) + " = (a" + std::to_string(i - 1) + ", a" + std::to_string(i - 1) + ")\n";
  const auto result = compile(doubled);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_NE(result.diagnostics[0].message.find("components"), std::string::npos);
}

}  // namespace
}  // namespace spacetime::symbolic
