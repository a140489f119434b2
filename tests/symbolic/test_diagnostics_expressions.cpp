// Wrong text, names and expressions.
#include <string>
#include <vector>

#include "tests/symbolic/wrong.h"

namespace spacetime::symbolic {
namespace {

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

}  // namespace
}  // namespace spacetime::symbolic
