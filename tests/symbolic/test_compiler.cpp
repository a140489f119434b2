// Edited texts: what is derived anew, counted.
#include "symbolic/compiler.h"

#include <gtest/gtest.h>

#include "tests/symbolic/compiled.h"
#include "tests/symbolic/twelve_links.h"

namespace spacetime::symbolic {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Compiler, AnEditDerivesTheChangedStatementAlone) {
  const std::string text = twelve_links();
  Compiler compiler;
  const Statistics first = compiler.compile(text).statistics;
  EXPECT_EQ(first.derived, first.programs);
  EXPECT_GE(first.programs, 6U);
  EXPECT_EQ(compiler.compile(text).statistics.derived, 0U);
  EXPECT_EQ(compiler.compile(twelve_links("at(arm.hand.y, 1) = 3")).statistics.derived, 1U);
  EXPECT_EQ(compiler.compile(replaced(text, "<= 2 over", "<= 2.5 over")).statistics.derived, 1U);
  EXPECT_EQ(compiler.compile("# a comment\n" + replaced(text, "at 0, 2", "at 0.5, 1.5 weight 3")).statistics.derived,
            0U);
  EXPECT_EQ(compiler.compile(replaced(text, "trajectory", "constant unused = 3\ntrajectory")).statistics.derived, 0U);
  // The lengths are everywhere.
  EXPECT_GT(compiler.compile(replaced(text, "a 0.3", "a 0.4")).statistics.derived, 3U);
}

TEST(Compiler, EachResultIsThatOfTheTextAlone) {
  Compiler compiler;
  for (const std::string& text :
       {twelve_links(), twelve_links("at(arm.hand.y, 1) = 3"), file_text("examples/throw.scene"),
        replaced(twelve_links(), "mass 1.0", "mass 2.0"), file_text("examples/throw.scene"), twelve_links()}) {
    const Compilation remembered = compiler.compile(text), fresh = compile(text);
    ASSERT_TRUE(remembered.problem && fresh.problem);
    EXPECT_EQ(*remembered.problem, *fresh.problem);
    EXPECT_EQ(remembered.statistics.operations, fresh.statistics.operations);
    EXPECT_EQ(remembered.statistics.tree_nodes, fresh.statistics.tree_nodes);
    EXPECT_EQ(remembered.statistics.programs, fresh.statistics.programs);
  }
}

TEST(Compiler, MistakesInBetweenForgetNothing) {
  const std::string text = twelve_links();
  Compiler compiler;
  compiler.compile(text);
  for (int i = 0; i < 5; ++i)
    EXPECT_FALSE(compiler.compile(replaced(text, "minimize", "minimise")).problem.has_value());
  EXPECT_EQ(compiler.compile(text).statistics.derived, 0U);
}

TEST(Compiler, WhatIsNotUsedAnyMoreIsForgotten) {
  const std::string text = twelve_links();
  Compiler compiler;
  const std::size_t programs = compiler.compile(text).statistics.programs;
  for (int i = 0; i < 4; ++i) compiler.compile(file_text("examples/double_integrator.scene"));
  EXPECT_EQ(compiler.compile(text).statistics.derived, programs);
}

TEST(Compiler, ProgramsThatDifferInDerivativesAloneAreTwo) {
  Compiler compiler;
  const std::string head = "time [0, 1]\ntrajectory bspline spans 4\ndof x\n";
  const Compilation result =
      compiler.compile(head + "let h = x^2\nconstrain x^2 = 0 at 1\nconstrain -(x^2) = 0 at 1\n");
  EXPECT_EQ(result.statistics.programs, 3U);
  EXPECT_EQ(result.statistics.derived, 3U);
}

}  // namespace
}  // namespace spacetime::symbolic
