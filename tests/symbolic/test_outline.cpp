// Where statements stand: each one's text is cut out of the scene, whatever stands around it.
#include <gtest/gtest.h>

#include "symbolic/compile.h"

namespace spacetime::symbolic {
namespace {

std::vector<std::string> texts(const std::string& text, std::vector<Diagnostic>* diagnostics = nullptr) {
  const Compilation compiled = compile(text);
  if (diagnostics) *diagnostics = compiled.diagnostics;
  std::vector<std::string> out;
  for (const Outlined& one : compiled.outline) {
    out.push_back(one.word + "|" + one.name + "|" + text.substr(one.begin, one.end - one.begin) +
                  (one.action ? "|action" : ""));
  }
  return out;
}

TEST(Outline, CutsEachStatementOutOfItsText) {
  const std::string text =
      "\xEF\xBB\xBF# größer\r\ntime [0, 1]; trajectory bspline spans 4  # é\r\ndof x\n"
      "creature arm {\n  link upper { revolute q; a 1; mass 1 }  # }\n}\n"
      "constrain x =\n  0 at 0\nconstrain goal: x = 1 at 1;;solve\nset  k = 1";
  std::vector<Diagnostic> diagnostics;
  const auto found = texts(text, &diagnostics);
  EXPECT_EQ(found, (std::vector<std::string>{
                       "time||time [0, 1]", "trajectory||trajectory bspline spans 4", "dof|x|dof x",
                       "creature|arm|creature arm {\n  link upper { revolute q; a 1; mass 1 }  # }\n}",
                       "constrain|constraint 1|constrain x =\n  0 at 0", "constrain|goal|constrain goal: x = 1 at 1",
                       "solve||solve|action", "set|k|set  k = 1|action"}));
  EXPECT_FALSE(diagnostics.empty());  // there is no constant k
}

TEST(Outline, HasStatementsWithMistakes) {
  EXPECT_EQ(texts("time [0, 1]\ndof x = = 2  # no\nconstrain goal: x at 1\nminimize integral(\nsolve\n"),
            (std::vector<std::string>{"time||time [0, 1]", "dof|x|dof x = = 2", "constrain|goal|constrain goal: x at 1",
                                      "minimize|objective 1|minimize integral(", "solve||solve|action"}));
}

TEST(Outline, TellsThePlace) {
  const Compilation compiled = compile("time [0, 1]\n  trajectory bspline spans 4; dof x\n");
  ASSERT_EQ(compiled.outline.size(), 3U);
  EXPECT_EQ(compiled.outline[1].line, 2);
  EXPECT_EQ(compiled.outline[1].column, 3);
  EXPECT_EQ(compiled.outline[2].column, 31);
}

}  // namespace
}  // namespace spacetime::symbolic
