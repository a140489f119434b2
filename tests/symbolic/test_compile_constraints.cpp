// What constraints and objectives mean: relations, their scopes and weights, functionals and pieces.
#include <vector>

#include "tests/symbolic/two_dofs.h"

namespace spacetime::symbolic {
namespace {

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

}  // namespace
}  // namespace spacetime::symbolic
