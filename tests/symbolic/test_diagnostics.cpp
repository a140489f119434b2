// Wrong scenes: each slip is reported once, where it is, in words that say what to do.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {
namespace {

struct Wrong {
  std::string text;
  int line, column;
  std::string piece;  // of the message
};

const std::string time = "time [0, 2]\ntrajectory bspline spans 8\n";  // two lines
const std::string head = time + "dof x\n";                             // three

void expect_one(const Wrong& wrong) {
  const Compilation result = compile(wrong.text);
  EXPECT_FALSE(result.problem.has_value()) << wrong.text;
  std::string all;
  for (const Diagnostic& diagnostic : result.diagnostics) all += render(diagnostic, "scene", wrong.text);
  ASSERT_EQ(result.diagnostics.size(), 1U) << wrong.text << '\n' << all;
  const Diagnostic& diagnostic = result.diagnostics[0];
  EXPECT_EQ(diagnostic.span.line, wrong.line) << all;
  EXPECT_EQ(diagnostic.span.column, wrong.column) << all;
  EXPECT_NE(diagnostic.message.find(wrong.piece), std::string::npos) << all;
}

TEST(Diagnostics, Text) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {"", 1, 1, "the scene is empty"},
           {"# nothing\n\n", 1, 1, "the scene is empty"},
           {"time [0, 1]\n\xFF", 2, 1, "0xFF is not valid UTF-8"},
           {std::string("\x7F"
                        "ELF\0\1",
                        6),
            1, 1, "control character"},
           {head + "let h = @ + 3 $ 4", 4, 9, "'@' means nothing"},
           {head + "constant g == 3", 4, 12, "write a single '='"},
           {head + "constant g = 3**2", 4, 15, "write '^'"},
           {head + "constant a = 2x", 4, 14, "write 2*x"},
           {head + "constant a = 1e999", 4, 14, "outside the range"},
           {head + "constant a = 3\n+ 4", 5, 1, "a line cannot begin with '+'"},
           {head + "constant a = 3\n<= 4", 5, 1, "a line cannot begin with '<='"},
           {head + "constant a = 3; and 4", 4, 17, "a statement cannot begin with 'and'"},
           {head + "constant a = 3 +\nconstant b = 2", 5, 1, "expected a value, found 'constant'"},
           {head + "constant g = 9.81 m", 4, 19, "expected the end of the statement"},
           {head + "}", 4, 1, "found '}'"},
           {head + "let y = (x + 1\nconstrain x = 0 at 0", 5, 1, "expected ',' or ')', found 'constrain'"},
           {head + "let y = (x + 1]", 4, 15, "expected ',' or ')'"},
           {head + "let y = ()", 4, 9, "empty parentheses"},
           {head + "let y = [1, 2]", 4, 9, "a list in [ ] cannot stand here"},
           {head + "constrian x = 0 at 0", 4, 1, "did you mean 'constrain'?"},
           {head + "x = 3", 4, 1, "a statement begins with what it is"},
           {head + "let h = x ; let k = h +* 3 ; let l = k", 4, 24, "expected a value, found '*'"}})
    expect_one(wrong);
}

TEST(Diagnostics, Names) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "minimize integral(xx)", 4, 19, "unknown name 'xx': did you mean 'x'?"},
           {head + "constant gravity = 9.81\nlet y = gravty*x", 5, 9, "did you mean 'gravity'?"},
           {head + "constant gravity = 9.81\nlet y = GRAVITY*x\nlet z = GRAVITY", 5, 9, "did you mean 'gravity'?"},
           {head + "creature arm { link l { revolute elbow; a 1 } }\nlet y = elbow", 5, 9, "did you mean 'arm.elbow'?"},
           {head + "constant b = a\nconstant a = 3\nlet y = a", 4, 14, "(line 5): move its declaration up"},
           {head + "dof x", 4, 5, "'x' is declared twice"},
           {head + "constant x = 1", 4, 10, "'x' is declared twice"},
           {head + "constant pi = 3", 4, 10, "'pi' is reserved"},
           {head + "dof t", 4, 5, "'t' is reserved"},
           {head + "let integral = 2", 4, 5, "'integral' is reserved"},
           {head + "let " + std::string(101, 'n') + " = 2", 4, 5, "at most 100 characters"},
           {head + "constrain a: x = 0 at 0\nminimize a: integral(x)", 5, 10, "names two statements"},
           {head + "let y = foo(x)", 4, 9, "there is no function 'foo'"},
           {head + "let y = sqr(x)", 4, 9, "did you mean 'sqrt'?"},
           {head + "let y = x(3)", 4, 9, "write '*' for a product"},
           {head + "let y = sin", 4, 9, "write sin(x)"},
           {head + "let y = inf", 4, 9, "only as a weight"}})
    expect_one(wrong);
}

TEST(Diagnostics, Expressions) {
  for (const Wrong& wrong :
       std::vector<Wrong>{{head + "constant g = 1/0", 4, 15, "division by zero"},
                          {head + "let y = x/(2 - 2)", 4, 10, "division by zero"},
                          {head + "constant a = 2\nlet y = x/(a - 2)", 5, 10, "division by zero"},
                          {head + "let y = sqrt(-1)", 4, 9, "no finite value"},
                          {head + "constant a = 0\nlet y = x + log(a)", 5, 13, "no finite value"},
                          {head + "let y = x'''", 4, 12, "third time derivative"},
                          {head + "let v = x''\nlet y = sin(v)'", 5, 15, "third time derivative"},
                          {head + "let y = min(x)", 4, 9, "min(a, b), but has 1 argument"},
                          {head + "let y = (x, 1) * (x, 2)", 4, 16, "write dot( , )"},
                          {head + "let y = (x, 1) + 1", 4, 16, "a tuple of 2 and a scalar"},
                          {head + "let y = 1/(x, 1)", 4, 10, "a scalar and a tuple of 2"},
                          {head + "let y = dot((x, 1), (1, 2, 3))", 4, 21, "tuples of one length"},
                          {head + "let y = cross((x, 1), (1, 2))", 4, 15, "tuples of 3"},
                          {head + "let y = sin((x, 1))", 4, 13, "must be a single number"},
                          {head + "let y = if(x, 1, 2)", 4, 12, "is a condition"},
                          {head + "let y = if(x < 1, 1, (2, 3))", 4, 22, "as many components"},
                          {head + "let y = x < 3", 4, 9, "this is a condition"},
                          {head + "let y = if(x < 1 and 3, x, 0)", 4, 22, "'and' stands with conditions"},
                          {head + "let y = if(x = 3, 1, 2)", 4, 14, "conditions are made with"},
                          {head + "let y = x.y", 4, 11, "a scalar has no component '.y'"},
                          {head + "let y = (x, 1).z", 4, 16, "a tuple of 2 has no component '.z'"},
                          {head + "let y = (x, 1).w", 4, 16, "its components are .x .y .z"},
                          {head + "minimize integral(x, 1)", 4, 10, "or three"},
                          {head + "minimize integral(x, 1, 0)", 4, 25, "must be later"},
                          {head + "minimize integral(x, 0, 3)", 4, 25, "outside the scene's time [0, 2]"},
                          {head + "minimize at(x, x)", 4, 16, "is a time"},
                          {head + "minimize at(x, -1)", 4, 16, "outside the scene's time"}})
    expect_one(wrong);
}

TEST(Diagnostics, Statements) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {"constant g = 9.81", 1, 1, "the scene has no time"},
           {"time [0, 1]\ntime [0, 2]", 2, 1, "a scene has one 'time'"},
           {"time [2, 1]", 1, 6, "must end later"},
           {"time [0, 1/0]", 1, 11, "division by zero"},
           {"time [0, t]", 1, 10, "depends on time"},
           {"time [0, 1]\ndof x\ndof y", 2, 5, "'x' has no trajectory"},
           {"time [0, 1]\ntrajectory bspline spans 2.5\ndof x", 2, 26, "a whole number"},
           {"time [0, 1]\ntrajectory bspline spans 0", 2, 26, "a whole number from 1"},
           {"time [0, 1]\ntrajectory bspline knots [0, 0.5, 0.4, 1]", 2, 35, "knots must rise"},
           {"time [0, 1]\ntrajectory bspline knots [0, 0.5, 0.9]", 2, 26, "begin and end with the scene's time"},
           {"time [0, 1]\ntrajectory bspline knots [0]", 2, 26, "at least two"},
           {"time [0, 1]\ntrajectory bspline\ndof x", 2, 19, "'spans' and a number"},
           {head + "trajectory bspline spans 4 for xx", 4, 32, "did you mean 'x'?"},
           {head + "constant a = x", 4, 14, "depends on the motion"},
           {head + "dof y = x", 4, 9, "depends on the motion"},
           {head + "constrain (x, x') = (1, 2, 3) at 0", 4, 19, "2 components and the right side 3"},
           {head + "constrain x", 4, 12, "expected a relation"},
           {head + "constrain x = 1 = 2", 4, 17, "lo <= x <= hi"},
           {head + "constrain x < 3", 4, 13, "write '<='"},
           {head + "constrain x = 0 at 3", 4, 20, "which lies outside the scene's time [0, 2]"},
           {head + "constant T = 5\nconstrain x = 0 at 0, T/2", 5, 23, "is 2.5, which lies outside"},
           {head + "constrain x = 0 at x", 4, 20, "depends on the motion"},
           {head + "constrain x = 0 over [1, 0]", 4, 22, "later than its first"},
           {head + "constrain x = 0 over [0, 1] every 0", 4, 35, "greater than 0"},
           {head + "constrain x = 0 over [0, 1] every 1e-9", 4, 35, "more than 1000000 instances"},
           {head + "constrain x = 0 over [0, 1] count 1", 4, 35, "from 2"},
           {head + "constrain x = 0 at 0 weight -1", 4, 29, "cannot be negative"},
           {head + "constrain x = 0 at 0 at 1", 4, 22, "'at' stands twice"},
           {head + "minimize x", 4, 10, "put it inside integral( ) or at( , time)"},
           {head + "minimize integral((x, x'))", 4, 10, "must be a single number"},
           {head + "minimize x = 3", 4, 12, "write 'constrain'"},
           {head + "minimize integral(x) at 3", 4, 22, "an objective has no 'at'"},
           {head + "minimize integral(x) weight inf", 4, 22, "write a number"},
           {head + "keyframe 5: x = 1", 4, 10, "outside the scene's time"},
           {head + "keyframe 0: x' = 1", 4, 13, "only a degree of freedom can be keyed"},
           {head + "keyframe 0: x = t", 4, 17, "numbers and constants"},
           {head + "keyframe 0: x = 1, x = 2", 4, 20, "two keys at this time"},
           {head + "keyframe 0: x = 1\nkeyframe 1 - 1: x = 2", 5, 17, "two keys at this time"},
           {head + "keyframe 0 x = 1", 4, 12, "expected ':'"},
           {head + "iterate 2.5", 4, 9, "a whole number"},
           {head + "solve iterations -1", 4, 18, "a whole number"},
           {head + "solve tolerance 0", 4, 17, "greater than 0"},
           {head + "solve method newtn", 4, 14, "did you mean 'newton'?"},
           {head + "solve\nconstrain x = 0 at 0\ndof y", 5, 1, "after an action"}})
    expect_one(wrong);
}

TEST(Diagnostics, Creatures) {
  const auto arm = [](const std::string& items, const std::string& after = "") {
    return time + "creature arm {\n" + items + "\n}\n" + after;  // items begin on line 4
  };
  const std::string link = "link one { revolute q1; a 1; mass 1; rod }\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {arm(""), 3, 1, "has no links"},
           {arm("link one { a 1 }"), 4, 6, "needs a joint"},
           {arm("link one { revolut q1; a 1 }", "let y = arm.q1\nlet z = arm.one"), 4, 12, "expected a joint"},
           {arm("link one { revolute q1; fixed }"), 4, 25, "a link has one joint"},
           {arm("link one { revolute q1; a 1; a 2 }"), 4, 30, "stands twice"},
           {arm("link one { revolute q1; a 1; axis (0, 0, 1) }"), 4, 30, "not by both"},
           {arm("link one { revolute q1; axis (0, 0, 0) }"), 4, 25, "must not be (0, 0, 0)"},
           {arm("link one { revolute q1; axis (0, 1) }"), 4, 30, "has 3 components, but here are 2"},
           {arm("link one { revolute q1; origin (0, 1, 0) }"), 4, 25, "needs an 'axis' too"},
           {arm("link one { fixed; axis (0, 1, 0) }"), 4, 19, "a fixed joint has no axis"},
           {arm("link one { fixed; offset 1 }"), 4, 19, "a fixed joint has no offset"},
           {arm("link one { revolute q1; a t }"), 4, 27, "depends on time"},
           {arm("link one { revolute q1; a 1; rod }"), 4, 30, "a rod needs a 'mass'"},
           {arm("link one { revolute q1; mass 1; rod }"), 4, 33, "a rod needs a length"},
           {arm("link one { revolute q1; a 1; mass 1; rod; com (0, 0, 0) }"), 4, 43, "its own centre of mass"},
           {arm("link one { revolute q1; a 1; com (0, 0, 0) }"), 4, 30, "needs a 'mass'"},
           {arm("link one { revolute q1; mass -1 }"), 4, 25, "cannot be negative"},
           {arm("link one { revolute q1; inertia (1, 2) }"), 4, 33, "3 components"},
           {arm("link one { revolute q1; inertia (1, -2, 1) }"), 4, 33, "cannot be negative"},
           {arm("link one { revolute q1; sphere 0.1; capsule 0.2 }"), 4, 37, "one shape"},
           {arm("link one { revolute force; a 1 }"), 4, 21, "taken inside creatures"},
           {arm("link one { revolute one; a 1 }"), 4, 21, "declared twice in 'arm'"},
           {arm(link + "link two on onr { revolute q2; a 1 }"), 5, 13, "did you mean 'one'?"},
           {arm(link + "point hand on two (0, 0, 0)"), 5, 15, "has no link 'two'"},
           {arm(link + "point hand on ground (0, 0, 0)"), 5, 15, "not on the ground"},
           {arm(link + "point hand on one (0, 0)"), 5, 19, "has 3 components"},
           {arm(link + "force on hand = (0, 0, 0)"), 5, 10, "has no point 'hand'"},
           {arm(link + "point hand on one (0, 0, 0)\nforce on hand = (arm.force, 0, 0)"), 6, 22,
            "cannot be made from them"},
           {arm(link + "gravity (0, -1, 0)\ngravity (0, -1, 0)"), 6, 1, "one 'gravity'"},
           {arm(link + "lnk two { fixed }"), 5, 1, "expected 'link', 'point', 'gravity' or 'force'"},
           {arm(link, "let y = arm.q2"), 7, 13, "did you mean 'q1'?"},
           {arm(link, "let y = arm"), 7, 9, "name one of its members, such as arm.q"},
           {arm(link, "let y = arm.q1.torque"), 7, 16, "only 'force'"},
           {arm("link one { revolute q1; a 1 }", "let y = arm.com"), 6, 13, "no centre of mass"},
           {arm("link one { fixed; a 1 }", "let y = arm.q"), 6, 13, "no degrees of freedom"},
           {time + "creature arm {\nlink one { revolute q1; a 1\nlink two { revolute q2; a 1 }\n}\nlet y = arm.q2", 5,
            1, "expected '}' to close 'link one {'"},
           {time + "creature arm {\nlink one { revolute q1; a 1 }\nlet y = arm.q1\nsolve", 5, 1,
            "expected '}' to close 'creature arm {'"},
           {arm(link + "}\nlink two { fixed; a 1 }\npoint hand on two (0, 0, 0)", "let y = arm.hand.x"), 6, 1,
            "is a '}' too early?"},
           {arm("link one { revolute q1; a 1; mass 1..; rod }"), 4, 35, "is not a number"},

           {arm(link + "link two point { fixed; a 1 }"), 5, 10, "expected '{', found 'point'"}})
    expect_one(wrong);
}

TEST(Diagnostics, WhatIsNotBuiltYetIsRefusedNotIgnored) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "constrain x <= 3", 4, 13, "inequalities are not built yet"},
           {head + "constrain x >= 3 at 1", 4, 13, "inequalities are not built yet"},
           {head + "constrain 0 <= x <= 3 over [0, 1]", 4, 13, "inequalities are not built yet"},
           {head + "constrain x = 0 at 0 when t < 1", 4, 27, "'when' is not built yet"},
           {head + "dof y in [0, 1]", 4, 10, "bounds are not built yet"},
           {time + "creature c { link l { revolute k in [0, 1]; a 1 } }", 3, 37, "bounds are not built yet"},
           {head + "parameter m = 3\nconstrain x = m at 0\nlet y = m", 4, 1, "parameters are not built yet"},
           {head + "define f(a) = a^2\nlet y = f(x)", 4, 1, "functions of one's own are not built yet"},
           {head + "eliminate x = t", 4, 1, "'eliminate' is not built yet"},
           {head + "script hoop { travel constant }\nconstrain x = hoop.x at 0", 4, 1,
            "scripted bodies are not built yet"},
           {"time [0, 1]\ntrajectory wavelet level 5\ndof x", 2, 1, "wavelet trajectories are not built yet"},
           {head + "solve method bfgs", 4, 14, "'bfgs' is not built yet"},
           {head + "solve method sqp92 linear cg", 4, 14, "'sqp92' is not built yet"},
           {head + "solve starts 5", 4, 14, "'starts' is not built yet"}})
    expect_one(wrong);
  for (const std::string action :
       {"window [0, 1]",     "window all",        "refine [0, 1]",    "refine auto tolerance 1",
        "shake amplitude 1", "filter strength 1", "damp 1",           "adapt tolerance 1",
        "lock level 1",      "set g = 1",         "weight a = 1",     "enable a",
        "disable a",         "delete a",          "replace a: x = 1", "scope a at 1",
        "bound x in [0, 1]", "key 0: x = 1",      "control x 1 = 2",  "reset"})
    expect_one({head + action, 4, 1, "is not built yet: only 'solve' and 'iterate' are"});
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
