// What scenes mean, looked at through the programs that they become.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
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

TEST(Compile, ActionsInOrder) {
  const Problem problem = problem_of(head + "solve iterations 5 tolerance 1e-6\niterate 0\nsolve method newton\n");
  ASSERT_EQ(problem.actions.size(), 3U);
  EXPECT_EQ(std::get<Solve>(problem.actions[0].action), (Solve{5, 1e-6}));
  EXPECT_EQ(std::get<Iterate>(problem.actions[1].action).iterations, 0);
  EXPECT_EQ(std::get<Solve>(problem.actions[2].action), Solve{});
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
