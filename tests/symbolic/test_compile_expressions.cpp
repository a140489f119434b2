// What expressions mean, looked at through the programs that they become.
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "tests/symbolic/two_dofs.h"

namespace spacetime::symbolic {
namespace {

double let(const std::string& expression, const State& at = state(0.3, -0.7, 1.1, 0.9, 0.2, -0.4)) {
  const auto values = plotted(problem_of(head + "let value = " + expression), "value", at);
  EXPECT_EQ(values.size(), 1U) << expression;
  return values.at(0);
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

TEST(Compile, EveryLetIsPlottedUnlessItIsNoCurve) {
  const Problem problem = problem_of(head + "let h = x^2\nlet p = (x, h)\nlet J = integral(x^2)\nminimize J\n");
  ASSERT_EQ(problem.plots.size(), 2U);
  EXPECT_EQ(plotted(problem, "p", state(0.5, 0, 0)), (std::vector{0.5, 0.25}));
  EXPECT_TRUE(problem.functionals.empty());
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

}  // namespace
}  // namespace spacetime::symbolic
