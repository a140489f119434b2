// Wrong scenes: each slip is reported once, where it is, in words that say what to do.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
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
           {head + "constant g = 9.81 m", 4, 19, "expected the end of the statement, found 'm': a product needs '*'"},
           {head + "let y = (x + 1)(x + 2)", 4, 16, "a product needs '*'"},
           {head + "let y = sin x", 4, 13, "an argument ( )"},
           {head + "let y = 3,5*x", 4, 10, "decimals have a point"},
           {head + "dof a, b", 4, 6, "each declaration has a line of its own"},
           {head + "let y = (x + 1))", 4, 16, "it closes nothing"},
           {head + "let y(a) = a^2", 4, 6, "'define' declares functions"},
           {head + "@ foo = 3", 4, 1, "'@' means nothing"},
           {head + "// a comment's end", 4, 1, "a comment begins with '#'"},
           {head + "let y = x /* more */", 4, 11, "'/*' means nothing here"},
           {head + "constrain x != 0 at 1", 4, 13, "relations are made with"},
           {head + "let y = x\xC2\xB2", 4, 10, "write '^2'"},
           {head + "let y = x > 0 ? 1 : 2", 4, 15, "write if(condition, a, b)"},
           {head + "constrain x = 0 at [0, 1]", 4, 20, "write 'over' in front of an interval"},
           {head + "}", 4, 1, "found '}'"},
           {head + "let y = (x + 1\nconstrain x = 0 at 0", 5, 1, "expected ',' or ')', found 'constrain'"},
           {head + "let y = (x + 1]", 4, 15, "expected ',' or ')'"},
           {head + "let y = x +", 4, 12, "expected a value, found the end of the text"},
           {head + "let y = (x\n\n# more\n", 4, 11, "expected ',' or ')', found the end of the text"},
           {head + "let y = ()", 4, 9, "empty parentheses"},
           {head + "let y = [1, 2]", 4, 9, "a list in [ ] cannot stand here"},
           {head + "constrain x = 0\n  at 0, 1", 5, 3, "'at' does not begin a statement: write it on the line"},
           {head + "constrian x = 0 at 0", 4, 1, "did you mean 'constrain'?"},
           {head + "x = 3", 4, 1, "a statement begins with what it is"},
           {head + "let h = x ; let k = h +* 3 ; let l = k", 4, 24, "expected a value, found '*'"}})
    expect_one(wrong);
}

TEST(Diagnostics, Names) {
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "minimize integral(xx)", 4, 19, "unknown name 'xx': did you mean 'x'?"},
           {head + "minimize integral(speed)", 4, 19, "unknown name 'speed': declare it first"},
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
           {head + "let y = ln(x)", 4, 9, "the natural logarithm is log(x)"},
           {head + "let y = pow(x, 2)", 4, 9, "a power is written a^b"},
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
           {head + "constrain 0 <= x >= 1", 4, 18, "lo <= x <= hi"},
           {head + "constrain (0, 1) <= x <= (1, 2, 3)", 4, 18, "2 components and the right side 3"},
           {head + "constrain x <= y", 4, 16, "unknown name 'y'"},
           {head + "constrain x <= 0 when x", 4, 23, "'when' takes a condition"},
           {head + "constrain x <= 0 when integral(x) > 1", 4, 23, "cannot be made of integral( )"},
           {head + "constrain x <= 0 when at(x, 1) > 1 and t < 1", 4, 23, "cannot be made of integral( )"},
           {head + "constrain x <= 0 when t < 1 when t > 0", 4, 29, "'when' stands twice"},
           {head + "dof y in [1, 0]", 4, 10, "upper bound must be greater"},
           {head + "dof y in [0, t]", 4, 14, "depends on time"},
           {head + "dof y = 3 in [0, 1]", 4, 14, "start value 3 lies outside"},
           {head + "dof y in 0", 4, 10, "an interval such as [0, 1]"},
           {time + "creature c { link l { revolute k in [1, 1]; a 1 } }", 3, 37, "upper bound must be greater"}})
    expect_one(wrong);
}

TEST(Diagnostics, Parameters) {
  const std::string p = head + "parameter m = 1\n";  // four lines
  for (const Wrong& wrong :
       std::vector<Wrong>{{head + "parameter m", 4, 12, "'=' and a start value"},
                          {head + "parameter x = 1", 4, 11, "'x' is declared twice"},
                          {head + "parameter m = x", 4, 15, "depends on the motion"},
                          {head + "parameter m = 1 in [2, 3]", 4, 20, "start value 1 lies outside"},
                          {head + "parameter m = 1 in [2, -3]", 4, 20, "upper bound must be greater"},
                          {p + "constrain x = 0 at m", 5, 20, "a parameter, which is not known before the motion is"},
                          {p + "constrain x = 0 over [0, m]", 5, 26, "a parameter"},
                          {p + "constrain x = 0 over [0, 2] every m", 5, 35, "a parameter"},
                          {p + "constrain x = 0 at 1 weight m", 5, 29, "a parameter"},
                          {p + "constant c = 2*m", 5, 14, "a parameter"},
                          {p + "minimize at(x, m)", 5, 16, "not of a parameter"},
                          {p + "minimize integral(x, 0, m)", 5, 25, "not of a parameter"},
                          {p + "dof y in [0, m]", 5, 14, "a parameter"},
                          {p + "dof y = m", 5, 9, "a parameter"},
                          {p + "parameter n = m", 5, 15, "a parameter"},
                          {p + "keyframe m: x = 1", 5, 10, "a parameter"},
                          {p + "keyframe 1: x = m", 5, 17, "numbers and constants"},
                          {p + "keyframe 1: m = 1", 5, 13, "only a degree of freedom can be keyed"},
                          {p + "set m = 3", 5, 5, "'m' is no constant"},
                          {p + "trajectory bspline spans m", 5, 26, "a parameter"},
                          {p + "script s { path [(0, 0, 0), (1, 0, m), (2, 0, 0), (3, 0, 0)] }", 5, 29, "a parameter"}})
    expect_one(wrong);
}

TEST(Diagnostics, FunctionsOfOnesOwn) {
  const std::string f = head + "define f(a, b) = a/b\n";  // four lines
  for (const Wrong& wrong :
       std::vector<Wrong>{{f + "let y = f(x)", 5, 9, "'f' is written f(a, b), but has 1 argument here"},
                          {f + "let y = f(x, 1, 2) + f(x, 2)", 5, 9, "but has 3 arguments here"},
                          {f + "let y = f", 5, 9, "'f' is a function"},
                          {f + "let y = f + x'", 5, 9, "'f' is a function"},
                          {f + "let y = f(x, 0) + f(x, 1)", 4, 19, "division by zero"},
                          {f + "let y = f_(x, 1)", 5, 9, "did you mean 'f'?"},
                          {f + "constant f = 2", 5, 10, "'f' is declared twice"},
                          {head + "define f(a) = f(a)", 4, 15, "there is no function 'f'"},
                          {head + "define f(a) = b\nlet y = f(x)", 4, 15, "unknown name 'b'"},
                          {head + "define f(a) = g(a)\nlet y = f(x)\nlet z = f(2)", 4, 15, "there is no function 'g'"},
                          {head + "define f(a) = x(a)\nlet y = f(x)", 4, 15, "'x' is no function"},
                          {head + "define f(x) = x^2\nlet y = f(2)", 4, 10, "an argument does not hide it"},
                          {head + "define f(a, a) = a\nlet y = f(2, 3)", 4, 13, "'a' is declared twice"},
                          {head + "define f(pi) = 2", 4, 10, "'pi' is reserved"},
                          {head + "define f(f) = 2", 4, 10, "the function's name"},
                          {head + "define sin(a) = 2", 4, 8, "'sin' is reserved"},
                          {head + "define f() = 2", 4, 10, "an argument's name"},
                          {head + "define f(a = 2\nlet y = f(1)", 4, 12, "expected ',' or ')'"},
                          {head + "define f(a) = a +* 2\nlet y = f(1) + f(2)", 4, 18, "expected a value"},
                          {head + "define f(a) = a.z\nlet y = f((x, 1))", 4, 17, "has no component '.z'"}})
    expect_one(wrong);
  std::string deep = head + "define f0(a) = a\n";
  for (int i = 1; i <= 100; ++i) deep += "define f" + std::to_string(i) + "(a) = f" + std::to_string(i - 1) + "(a)\n";
  expect_one({deep + "let y = f100(x)\nlet z = f100(2)", 41, 17, "more than 64 deep"});
}

TEST(Diagnostics, Elimination) {
  const std::string arm =
      time + "creature arm { link a { revolute p; a 1; mass 1 }; link b { revolute r; a 1; mass 1 } }\n";
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "eliminate y = 2", 4, 11, "no degree of freedom 'y'"},
           {head + "eliminate x = y", 4, 15, "unknown name 'y'"},
           {head + "eliminate x = x'", 4, 15, "by means of itself"},
           {head + "eliminate x = (1, 2)", 4, 15, "must be a single number"},
           {head + "let h = x^2\neliminate x = t", 5, 11, "'x' is used on line 4, before it is eliminated"},
           {head + "constrain x = 0 at 1\neliminate x = t", 5, 11, "used on line 4"},
           {head + "keyframe 0: x = 1\neliminate x = t", 5, 11, "used on line 4"},
           {head + "eliminate x = t\neliminate x = 2*t", 5, 11, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nkeyframe 0: x = 1", 5, 13, "'x' is eliminated on line 4"},
           {head + "dof y\neliminate x = y\nkeyframe 0: x = 1", 6, 13, "'x' is eliminated on line 5"},
           {head + "eliminate x = t\nkey 0: x = 1", 5, 8, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nbound x in [0, 1]", 5, 7, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\ncontrol x 1 = 0", 5, 9, "'x' is eliminated on line 4"},
           {head + "eliminate x = t\nwindow [0, 1] of x", 5, 18, "'x' is eliminated on line 4"},
           {head + "dof y in [0, 1]\neliminate y = x", 5, 11, "'y' has bounds"},
           {head + "constant g = 2\neliminate g = x", 5, 11, "no degree of freedom 'g'"},
           {head + "dof y\neliminate x = y''\nconstrain x' = 0 at 1", 6, 12, "third time derivative"},
           {arm + "eliminate arm = 2", 4, 11, "'arm' is a creature"},
           {arm + "eliminate arm.s = 2", 4, 11, "no degree of freedom 'arm.s'"},
           {arm + "eliminate arm.r = arm.p'", 4, 19, "two time derivatives"},
           {arm + "let h = arm.a.y + arm.b.y\neliminate arm.r = -arm.p", 5, 11, "used on line 4"},
           {arm + "minimize integral(dot(arm.force, arm.force))\neliminate arm.p = t", 5, 11, "used on line 4"},
           {arm + "eliminate arm.r = -arm.p\nkeyframe 0: arm.q = 1", 5, 13, "only a degree of freedom can be keyed"}})
    expect_one(wrong);
}

TEST(Diagnostics, Actions) {
  const std::string goal =
      head + "constant a = 1\nconstrain goal: x = a at 1\nminimize energy: integral(x''^2)\n";  // six lines
  for (const Wrong& wrong : std::vector<Wrong>{
           {goal + "solve method sqp92 linear", 7, 26, "'cg'"},
           {goal + "solve method bfgs linear cg", 7, 14, "'sqp92' alone"},
           {goal + "solve starts 0", 7, 14, "from 1"},
           {goal + "solve iterations 5 iterations 6", 7, 20, "stands twice"},
           {goal + "iterate x", 7, 9, "depends on the motion"},
           {goal + "window [3, 4]", 7, 8, "[3, 4] does not meet the scene's time [0, 2]"},
           {goal + "window [-1, 0]", 7, 8, "does not meet"},
           {goal + "window [1, 0]", 7, 8, "later than its first"},
           {goal + "window [0, 1] of y", 7, 18, "no degree of freedom 'y'"},
           {goal + "window 1", 7, 8, "an interval such as [0, 1]"},
           {goal + "refine [2, 3]", 7, 8, "does not meet"},
           {goal + "refine [0, 1] times 0", 7, 21, "from 1"},
           {goal + "refine auto", 7, 12, "expected 'tolerance'"},
           {goal + "refine auto tolerance 0", 7, 23, "greater than 0"},
           {goal + "shake 0.1", 7, 7, "expected 'amplitude'"},
           {goal + "shake amplitude -1", 7, 17, "greater than 0"},
           {goal + "shake amplitude 1 seed 0.5", 7, 24, "a whole number"},
           {goal + "filter strength 0", 7, 17, "greater than 0"},
           {goal + "damp 0", 7, 6, "greater than 0"},
           {goal + "damp x", 7, 6, "depends on the motion"},
           {goal + "adapt tolerance 0", 7, 17, "greater than 0"},
           {goal + "adapt tolerance 1 levels 0", 7, 26, "from 1"},
           {goal + "lock level -1", 7, 12, "a whole number"},
           {goal + "lock 3", 7, 6, "expected 'level'"},
           {goal + "set b = 1", 7, 5, "no constant 'b' so far"},
           {goal + "constant gravity = 9.81\nset gravty = 1", 8, 5, "did you mean 'gravity'?"},
           {goal + "set x = 1", 7, 5, "'x' is no constant"},
           {goal + "set a = x", 7, 9, "depends on the motion"},
           {goal + "set a = 1/0", 7, 10, "division by zero"},
           {goal + "set a = 3\nconstrain x = 0 at a", 8, 20, "is 3, which lies outside"},
           {goal + "set a = 0\nlet y = x/a", 8, 10, "division by zero"},
           {goal + "constant c = 1/(a + 1)\nset a = -1", 8, 5, "'c', which follows from it, has no finite value"},
           {goal + "weight gaol = 3", 7, 8, "did you mean 'goal'?"},
           {goal + "weight goal = -3", 7, 15, "cannot be negative"},
           {goal + "weight energy = inf", 7, 17, "write a number"},
           {goal + "weight x = 3", 7, 8, "there is no constraint or objective term 'x'"},
           {goal + "enable gaol", 7, 8, "did you mean 'goal'?"},
           {goal + "disable enrgy", 7, 9, "did you mean 'energy'?"},
           {goal + "delete goal\nenable goal", 8, 8, "'goal' has been deleted (line 7)"},
           {goal + "delete goal\nreplace goal: x = 0 at 1", 8, 9, "has been deleted"},
           {goal + "solve\nconstrain late: x = 0 at 1\nminimize late: integral(x)", 9, 10, "names two statements"},
           {head + "enable late\nconstrain late: x = 0 at 1", 4, 8, "no constraint or objective term 'late' so far"},
           {goal + "replace goal: integral(x)", 7, 9, "only a relation can take its place"},
           {goal + "replace energy: x = 0 at 1", 7, 9, "only a functional can take its place"},
           {goal + "replace goal: x = 0 at 5", 7, 24, "outside the scene's time"},
           {goal + "replace nobody: x = 0 at 1", 7, 9, "'nobody'"},
           {goal + "replace goal x = 0", 7, 14, "':' and what replaces it"},
           {goal + "scope goal at 5", 7, 15, "outside the scene's time"},
           {goal + "scope energy at 1", 7, 7, "an objective term, which has no scope"},
           {goal + "scope goal", 7, 11, "a scope: 'at' and times"},
           {goal + "constrain c: at(x, 1) = 3\nscope c at 1.5", 8, 7, "stand inside it"},
           {goal + "bound y in [0, 1]", 7, 7, "no degree of freedom 'y'"},
           {goal + "bound x in [1, 0]", 7, 12, "upper bound must be greater"},
           {goal + "bound x [0, 1]", 7, 9, "expected 'in'"},
           {goal + "key 3: x = 1", 7, 5, "outside the scene's time"},
           {goal + "key 1: x = 1, x = 2", 7, 15, "two keys at this time"},
           {goal + "key 1: x' = 1", 7, 8, "only a degree of freedom can be keyed"},
           {goal + "key 1: x = t", 7, 12, "numbers and constants"},
           {goal + "control y 1 = 0", 7, 9, "no degree of freedom 'y'"},
           {goal + "control x 11 = 0", 7, 11, "'x' has 11 coefficients, numbered from 0"},
           {goal + "control x 1.5 = 0", 7, 11, "a whole number"},
           {goal + "control x 1 = t", 7, 15, "depends on time"},
           {goal + "reset x", 7, 7, "expected the end of the statement"},
           {"trajectory bspline spans 4\nsolve\ntime [0, 2]", 3, 1, "must stand before the first action"},
           {goal + "solve\ntrajectory bspline spans 4 for x", 8, 1, "must stand before the first action"}})
    expect_one(wrong);
}

TEST(Diagnostics, FrozenConstantsNameTheLineThatFrozeThem) {
  for (const auto& [text, line, what] : std::vector<std::tuple<std::string, int, std::string>>{
           {"constant T = 2\ntime [0, T]\ntrajectory bspline spans 8\ndof x\nset T = 3", 2, "'time' on line 2"},
           {"constant a = 1\nconstant T = 2*a\ntime [0, T]\ntrajectory bspline spans 8\ndof x\nset a = 3", 3,
            "'time' on line 3"},
           {"constant n = 8\ntime [0, 1]\ntrajectory bspline spans n\ndof x\nset n = 3", 3, "'trajectory' on line 3"},
           {"constant u = 0.5\ntime [0, 1]\ntrajectory bspline knots [0, u, 1]\ndof x\nset u = 0.3", 3,
            "'trajectory' on line 3"},
           {"constant n = 8\n" + head + "constrain x = 0 over [0, 2] count n\nsolve\nset n = 3", 5,
            "'count' on line 5"}}) {
    const int last = static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1;
    expect_one({text, last, 5, what});
    EXPECT_EQ(compile(text).diagnostics.at(0).notes.at(0).span.line, line);
  }
}

TEST(Diagnostics, Scripts) {
  const std::string path = "path [(0, 0, 0), (1, 0, 0), (2, 1, 0), (3, 1, 1)]";
  for (const Wrong& wrong : std::vector<Wrong>{
           {head + "script s { path [(0, 0, 0), (1, 0, 0), (2, 0, 0)] }", 4, 17, "at least 4"},
           {head + "script s { path through [(0, 0, 0)] }", 4, 25, "at least 2"},
           {head + "script s { path [(0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 18, "has 3 components"},
           {head + "script s { path [(0, 0, x), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 18, "depends on the motion"},
           {head + "script s { path [(0, 0, z), (1, 0, 0), (2, 0, 0), (3, 0, 0)] }", 4, 25, "unknown name 'z'"},
           {head + "script s { " + path + " knots [0, 1, 2] }", 4, 68, "need 2 knots"},
           {head + "script s { " + path + " knots [1, 0] }", 4, 72, "knots must rise"},
           {head + "script s { " + path + "; " + path + " }", 4, 8, "one 'path', but here are 2"},
           {head + "script s { travel constant }", 4, 8, "one 'path', but here are 0"},
           {head + "script s { " + path + "; travel [(0, 0), (0, 1)] }", 4, 79, "times must rise"},
           {head + "script s { " + path + "; travel [(0, 0)] }", 4, 70, "at least 2"},
           {head + "script s { " + path + "; travel [(0, 0), (1, 1)] knots [0, 1] }", 4, 93, "'travel control'"},
           {head + "script s { " + path + "; travel control [(0, 0), (1, 1)] }", 4, 78, "at least 4"},
           {head + "script s { " + path + "; travel constant; travel constant }", 4, 8, "one 'travel'"},
           {head + "script s { " + path + "; orient [(0, (1, 0, 0))] }", 4, 71, "has 5 components"},
           {head + "script s { " + path + "; orient along up (0, 1) }", 4, 79, "has 3 components"},
           {head + "script s { " + path + "; jump }", 4, 63, "'path', 'travel' or 'orient'"},
           {head + "script s { " + path + "; travel constant }\nlet y = s.x", 4, 1, "not built yet"},
           {"time [0, 1]\ntrajectory wavelet level 2.5\ndof x", 2, 26, "a whole number"},
           {"time [0, 1]\ntrajectory wavelet 5\ndof x", 2, 20, "expected 'level'"}})
    expect_one(wrong);
}

TEST(Diagnostics, AddsNothingToADamagedStatement) {
  for (const std::string slip :
       {"constrain goal: x = 0 at", "minimize goal: integral(x +* 2)", "constrain goal: x < 0"})
    EXPECT_EQ(compile(head + slip + "\nweight goal = 3\ndisable goal\n").diagnostics.size(), 1U) << slip;
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
           {arm(link, "let y = arm.q2\nlet z = arm.q2' + arm.q2.force\nkeyframe 0: arm.q2 = 1"), 7, 13,
            "did you mean 'q1'?"},
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
           {arm("link one { revolute q1 } a 1; mass 1; rod }\nlink two { revolute q2; a 1 }"), 4, 26,
            "'a' can stand only inside 'link { }'"},
           {arm("link one { a 1 }\nrevolute q1\nmass 1 }\npoint hand on one (0, 0, 0)", "let y = arm.q1"), 5, 1,
            "'revolute' can stand only inside 'link { }': is a '}' too early?"},
           {arm(link + "mass 1"), 5, 1, "'mass' can stand only inside 'link { }'"},
           {arm("link one { revolute q1; a 1; mass 1..; rod }"), 4, 35, "is not a number"},
           {arm(link + "link two point { fixed; a 1 }"), 5, 10, "expected '{', found 'point'"}})
    expect_one(wrong);
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
