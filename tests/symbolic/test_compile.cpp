// What whole scenes mean, looked at through the programs that they become.
#include <string>
#include <vector>

#include "tests/symbolic/two_dofs.h"

namespace spacetime::symbolic {
namespace {

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
