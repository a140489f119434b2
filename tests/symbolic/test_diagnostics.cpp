// Wrong scenes as a whole: how many diagnostics there are, in which order, and where they point.
#include <string>
#include <string_view>
#include <vector>

#include "tests/symbolic/compiled.h"
#include "tests/symbolic/wrong.h"

namespace spacetime::symbolic {
namespace {

TEST(Diagnostics, AddsNothingToADamagedStatement) {
  for (const std::string slip :
       {"constrain goal: x = 0 at", "minimize goal: integral(x +* 2)", "constrain goal: x < 0"})
    EXPECT_EQ(compile(head + slip + "\nweight goal = 3\ndisable goal\n").diagnostics.size(), 1U) << slip;
}

TEST(Diagnostics, AllMistakesComeInOnePassInTheOrderOfTheText) {
  const Compilation result = compile(
      "constant a = b\ntime [0, 1]\nlet y = (1 + \nlet y2 = 2 @\ntrajectory bspline spans 8\n"
      "dof x\nconstrain x = 0 at 7\nminimize integral(z)\nconstrain (x = 0\nsolve\n");
  std::vector<int> lines;
  for (const Diagnostic& diagnostic : result.diagnostics) lines.push_back(diagnostic.span.line);
  EXPECT_EQ(lines, (std::vector{1, 4, 4, 7, 8, 9}));
}

TEST(Diagnostics, WhatADamagedStatementDeclaresIsNotMissedLater) {
  for (const std::string slip :
       {"constant g = 9.81 m", "constnt g = 9.81", "dof g = [1]", "let g = (1 +* 2)", "parameter g = "}) {
    const Compilation result = compile(head + slip + "\nlet y = g + 1\nconstrain g = x at 0\n");
    EXPECT_EQ(result.diagnostics.size(), 1U)
        << slip << ": " << result.diagnostics.at(0).message << " / " << result.diagnostics.back().message;
  }
  const std::string creature = "creature g { link a { revolute } }\nlet y = g.elbow + dot(g.hand, g.q) + g.a.x\n";
  EXPECT_EQ(compile(head + creature).diagnostics.size(), 1U);
  EXPECT_EQ(compile("time [0, 2\ntrajectory bspline spans 8\ndof x\n").diagnostics.size(), 1U);
  EXPECT_EQ(compile("time [0, 2]\ntrajectory bspline spas 8\ndof x\n").diagnostics.size(), 1U);
}

TEST(Diagnostics, TwicePointsAtBothPlaces) {
  const std::string text = head + "let y = 1\nconstant y = 2\n";
  const Compilation result = compile(text);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  ASSERT_EQ(result.diagnostics[0].notes.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].notes[0].span, (Span{4, 5, 1}));
  const std::string shown = render(result.diagnostics[0], "a.scene", text);
  EXPECT_TRUE(shown.starts_with("a.scene:5:10: error: 'y' is declared twice")) << shown;
  EXPECT_NE(shown.find("a.scene:4:5: note: "), std::string::npos) << shown;
}

TEST(Diagnostics, ColumnsCountCharactersBehindAByteOrderMark) {
  expect_one(
      {"\xEF\xBB\xBFtime [0, 2] # \xC3\xA9\ntrajectory bspline spans 8 ; dof y; let z = q", 2, 45, "unknown name 'q'"});
}

TEST(Diagnostics, ThereIsALimitToTheirNumber) {
  std::string text = head;
  for (int i = 0; i < 1000; ++i) text += "let a" + std::to_string(i) + " = 1/0\n";
  const Compilation result = compile(text);
  ASSERT_EQ(result.diagnostics.size(), 200U);
  EXPECT_NE(result.diagnostics.back().notes.at(0).message.find("800 more"), std::string::npos);
}

// Whatever stands in a scene, compiling it ends with a problem or with diagnostics, never both or neither.
TEST(Diagnostics, EveryCutAndEveryLostCharacterEndsWell) {
  const std::string text = file_text("examples/throw.scene");
  for (std::size_t i = 0; i < text.size(); i += 3) {
    const Compilation cut = compile(std::string_view(text).substr(0, i));
    EXPECT_NE(cut.problem.has_value(), !cut.diagnostics.empty()) << i;
    std::string lost = text;
    lost.erase(i, 1);
    const Compilation hole = compile(lost);
    EXPECT_NE(hole.problem.has_value(), !hole.diagnostics.empty()) << i;
    EXPECT_LE(hole.diagnostics.size(), 3U) << lost << "\n" << i;
  }
}

}  // namespace
}  // namespace spacetime::symbolic
