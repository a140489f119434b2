#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "symbolic/derivative.h"
#include "symbolic/value.h"
#include "tests/symbolic/random_expression.h"

namespace spacetime::symbolic {
namespace {

constexpr std::uint64_t seed = 19940725;

struct DerivativeTest : testing::Test {
  Graph g;
  Expr dof(const std::string& name, int derivative = 0) {
    return g.input({.kind = InputKind::dof, .name = name, .index = 0, .derivative = derivative});
  }
  Expr x = dof("x"), y = dof("y");
  Expr n(double value) { return g.number(value); }
  double at(Expr e, double x_value, double y_value = 0) {
    const double inputs[] = {x_value, y_value};
    return evaluate<double>(g, {&e, 1}, inputs)[0];
  }
  Expr first(Expr e, Expr by) {
    const auto entries = jacobian(g, {&e, 1}, {&by, 1});
    return entries.empty() ? Expr{} : entries[0].value;
  }
  Expr second(Expr e, Expr by) {
    const auto entries = hessian(g, e, {&by, 1});
    return entries.empty() ? Expr{} : entries[0].value;
  }
};

TEST_F(DerivativeTest, OfTimeGoesToTheNextDerivative) {
  const Expr v = dof("x", 1), a = dof("x", 2);
  const Expr t = g.input({.kind = InputKind::time, .name = {}, .index = 0, .derivative = 0});
  const Expr k = g.input({.kind = InputKind::constant, .name = "k", .index = 0, .derivative = 0});
  const Expr signal = g.input({.kind = InputKind::signal, .name = "s", .index = 0, .derivative = 0});
  const Expr h = g.sine(x);
  EXPECT_EQ(time_derivative(g, h), g.multiply(g.cosine(x), v));
  EXPECT_EQ(time_derivative(g, v), a);
  EXPECT_EQ(time_derivative(g, t), n(1));
  EXPECT_EQ(time_derivative(g, k), n(0));
  EXPECT_EQ(time_derivative(g, n(3)), n(0));
  EXPECT_EQ(time_derivative(g, g.multiply(k, t)), k);
  EXPECT_EQ(g.input_of(*time_derivative(g, signal)).derivative, 1);
  EXPECT_FALSE(time_derivative(g, a));
  EXPECT_FALSE(time_derivative(g, g.add(x, g.sine(a))));
  EXPECT_EQ(time_derivative(g, g.select(g.operation(Op::less, a, n(0)), x, n(2))),
            g.select(g.operation(Op::less, a, n(0)), v, n(0)));  // a condition has no derivative
  EXPECT_EQ(time_derivative(g, g.operation(Op::sign, a)), n(0));
  const auto twice = time_derivative(g, *time_derivative(g, g.multiply(x, x)));
  ASSERT_TRUE(twice);
  std::vector<double> inputs(g.inputs().size());
  inputs[g.node(x).input] = 3, inputs[g.node(v).input] = 5, inputs[g.node(a).input] = 7;
  EXPECT_EQ(evaluate<double>(g, {&*twice, 1}, inputs)[0], 2 * 5 * 5 + 2 * 3 * 7);
}

TEST_F(DerivativeTest, AtKinksFollowsTheFirst) {
  const Expr square = g.multiply(x, x);
  EXPECT_EQ(at(first(g.operation(Op::absolute, x), x), 0), 0);
  EXPECT_EQ(at(first(g.operation(Op::absolute, x), x), -2), -1);
  EXPECT_EQ(first(g.operation(Op::sign, x), x), n(0));
  for (const auto op : {Op::minimum, Op::maximum}) {
    const Expr e = g.operation(op, g.multiply(n(3), x), square);  // equal at 0 and 3
    EXPECT_EQ(at(first(e, x), 0), 3) << info(op).name;
    EXPECT_EQ(at(first(e, x), 3), 3) << info(op).name;
    const Expr reverse = g.operation(op, square, g.multiply(n(3), x));
    EXPECT_EQ(at(first(reverse, x), 0), 0) << info(op).name;
    EXPECT_EQ(at(first(reverse, x), 3), 6) << info(op).name;
  }
}

// What is not chosen may be infinite, or no number, with all its derivatives.
TEST_F(DerivativeTest, WhatIsNotChosenSpoilsNothing) {
  const Expr zero = n(0), one = n(1);
  const Expr positive = g.operation(Op::less, zero, x);
  const Expr root = g.square_root(x), log = g.operation(Op::logarithm, x), inverse = g.divide(one, x);
  struct Case {
    const char* name;
    Expr e;
    double x, first, second;
  };
  const Expr cubed = g.multiply(inverse, g.multiply(root, log));
  const Case cases[] = {
      {"root", g.select(positive, root, g.negate(x)), -1, -1, 0},
      {"root at its edge", g.select(positive, root, g.multiply(x, x)), 0, 0, 2},
      {"log", g.select(positive, log, g.multiply(x, x)), -3, -6, 2},
      {"pole", g.select(positive, inverse, g.sine(x)), 0, 1, 0},
      {"one branch alone", g.select(positive, cubed, n(7)), 0, 0, 0},
      {"in a product", g.multiply(g.add(x, n(2)), g.select(positive, cubed, one)), 0, 1, 0},
      {"under a square", g.power(g.select(positive, g.operation(Op::logarithm, root), x), n(2)), -2, -4, 2},
      {"nested", g.select(positive, g.select(g.operation(Op::less, x, one), log, root), x), -1, 1, 0},
      {"chosen in one place, not in another",
       g.add(g.select(positive, root, x), g.select(g.operation(Op::less, n(-5), x), x, root)), -1, 2, 0},
      {"root of max", g.square_root(g.operation(Op::maximum, n(4), g.multiply(x, inverse))), 0, 0, 0},
      {"min", g.operation(Op::minimum, x, g.divide(one, g.multiply(x, x))), 0, 1, 0},
      {"root of |x| at 0", g.square_root(g.operation(Op::absolute, x)), 0, 0, 0},
  };
  for (const auto& [name, e, x_value, d, dd] : cases) {
    EXPECT_EQ(at(first(e, x), x_value), d) << name;
    EXPECT_EQ(at(second(e, x), x_value), dd) << name;
    const auto values = std::array{e, e};  // several rows take another way
    const auto rows = jacobian(g, values, {&x, 1});
    EXPECT_EQ(rows.empty() ? 0 : at(rows[0].value, x_value), d) << name;
  }
  const Expr v = dof("x", 1);
  const auto rate = time_derivative(g, g.select(positive, log, x));
  std::vector<double> inputs(g.inputs().size());
  inputs[g.node(x).input] = -1, inputs[g.node(v).input] = 3;
  EXPECT_EQ(evaluate<double>(g, {&*rate, 1}, inputs)[0], 3);
}

TEST_F(DerivativeTest, WhatIsZeroIsLeftOut) {
  const Expr z = dof("z");
  const Expr values[] = {g.add(x, y), g.multiply(y, y), n(3)};
  const Expr inputs[] = {x, y, z};
  const auto entries = jacobian(g, values, inputs);
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].row, 0);
  EXPECT_EQ(entries[0].column, 0);
  EXPECT_EQ(entries[1].column, 1);
  EXPECT_EQ(entries[2].row, 1);
  EXPECT_EQ(entries[2].value, g.multiply(n(2), y));
  EXPECT_TRUE(hessian(g, values[0], inputs).empty());
  const auto curved = hessian(g, g.multiply(x, y), inputs);
  ASSERT_EQ(curved.size(), 1u);
  EXPECT_EQ(curved[0].row, 1);
  EXPECT_EQ(curved[0].column, 0);
  EXPECT_EQ(curved[0].value, n(1));
  EXPECT_TRUE(jacobian(g, {}, inputs).empty());
  EXPECT_EQ(jacobian(g, {&x, 1}, inputs).size(), 1u);  // an input itself
}

TEST_F(DerivativeTest, AValueThatOthersUseKeepsItsRow) {
  const Expr s = g.sine(x), values[] = {s, g.multiply(s, y), g.operation(Op::exponential, g.multiply(s, s))};
  const Expr inputs[] = {x, y};
  const double point[] = {0.7, 1.3};
  std::map<std::pair<int, int>, double> found;
  for (const auto& entry : jacobian(g, values, inputs)) found[{entry.row, entry.column}] = at(entry.value, 0.7, 1.3);
  const double sine = std::sin(0.7), cosine = std::cos(0.7);
  EXPECT_EQ(found.size(), 4u);
  EXPECT_NEAR((found[{0, 0}]), cosine, 1e-15);
  EXPECT_NEAR((found[{1, 0}]), cosine * point[1], 1e-15);
  EXPECT_NEAR((found[{1, 1}]), sine, 1e-15);
  EXPECT_NEAR((found[{2, 0}]), 2 * sine * cosine * std::exp(sine * sine), 1e-15);
}

TEST_F(DerivativeTest, DeepExpressionsNeedNoStack) {
  Expr nested = x, chosen = x, sum;
  for (int i = 0; i < 100'000; ++i) nested = g.sine(nested);
  for (int i = 0; i < 5'000; ++i) {
    chosen = g.select(g.operation(Op::less, chosen, n(i)), g.multiply(n(0.999), chosen), g.add(chosen, y));
    sum = g.add(sum, g.multiply(chosen, y));
  }
  const double d = at(first(nested, x), 0.3);
  EXPECT_GT(d, 0);
  EXPECT_LT(d, 1);
  EXPECT_TRUE(std::isfinite(at(second(nested, x), 0.3)));
  EXPECT_TRUE(std::isfinite(at(first(sum, x), 0.3, 0.1)));
  const Expr inputs[] = {x, y};
  EXPECT_EQ(hessian(g, sum, inputs).size(), 2u);
  const Expr v = dof("x", 1), rate = *time_derivative(g, nested);
  std::vector<double> values(g.inputs().size());
  values[g.node(x).input] = 0.3, values[g.node(v).input] = 1;
  EXPECT_NEAR(evaluate<double>(g, {&rate, 1}, values)[0], d, 1e-9 * d);
}

// Nested and neighbouring choices by the thousand: guards must not multiply.
TEST_F(DerivativeTest, ManyChoicesStaySmall) {
  Expr e = x;
  for (int i = 0; i < 2000; ++i) {
    const Expr apart = g.select(g.operation(Op::less, e, n(i)), g.sine(e), n(0));
    const Expr other = g.select(g.operation(Op::less, y, n(i)), g.cosine(e), n(1));
    e = g.add(g.operation(Op::absolute, apart), g.operation(Op::minimum, other, e));
  }
  const auto before = g.size();
  EXPECT_TRUE(std::isfinite(at(first(e, x), 0.3, 0.1)));
  EXPECT_LT(g.size() - before, 2000u * 200);
}

double tolerance(double bound, double reference) { return 100 * bound + 1e-9 * std::fmax(1, std::fabs(reference)); }

TEST(DerivativeProperty, JacobianAgainstDualNumbersAndDifferences) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomExpressions random(seed);
  int differences = 0;
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    Graph g;
    const auto e = random.make(g, 25, 3);
    // One row goes backwards, several by elimination.
    const Expr rows[] = {e.expr.back(), e.expr[e.expr.size() - 2]};
    for (const std::size_t count : {1u, 2u}) {
      std::map<std::pair<int, int>, Expr> found;
      for (const auto& entry : jacobian(g, std::span(rows, count), e.variables)) {
        found[{entry.row, entry.column}] = entry.value;
      }
      for (int k = 0; k < 3; ++k) {
        std::vector<Dual<double>> at;
        for (const double value : e.point) at.emplace_back(value, 0.0);
        at[k].d = 1;
        const auto dual = e.values<Dual<double>>(at);
        for (int row = 0; row < static_cast<int>(count); ++row) {
          const double reference = dual[dual.size() - 1 - row].d;
          const Expr entry = found[{row, k}];
          const double value = evaluate<double>(g, {&entry, 1}, e.point)[0];
          const double bound = rounding_bounds(g, {&entry, 1}, e.point)[0];
          EXPECT_NEAR(value, reference, tolerance(bound, reference)) << "expression " << i << ", input " << k;

          auto right = e.point, left = e.point;
          const double h = 1e-6;
          right[k] += h, left[k] -= h;
          const double f = e.value<double>(e.point), high = e.values<double>(right)[dual.size() - 1 - row],
                       low = e.values<double>(left)[dual.size() - 1 - row];
          const double slope = (high - low) / (2 * h);
          if (std::fabs(f) < 1e3 && std::fabs(reference) < 1e3) {
            differences += std::fabs(slope - value) <= 1e-5 * std::fmax(1, std::fabs(value)) ? 0 : 1;
          }
        }
      }
    }
  }
  // Differences may step over a kink or meet a steep place; seldom.
  EXPECT_LE(differences, 60);
}

TEST(DerivativeProperty, HessianAgainstDualNumbersOfDualNumbers) {
  SCOPED_TRACE(testing::Message() << "seed " << seed + 1);
  RandomExpressions random(seed + 1);
  using Second = Dual<Dual<double>>;
  for (int i = 0; i < 1000 && !testing::Test::HasFailure(); ++i) {
    Graph g;
    const auto e = random.make(g, 25, 3);
    std::map<std::pair<int, int>, Expr> found;
    for (const auto& entry : hessian(g, e.expr.back(), e.variables)) {
      EXPECT_LE(entry.column, entry.row);
      found[{entry.row, entry.column}] = entry.value;
    }
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column <= row; ++column) {
        std::vector<Second> at;
        for (const double value : e.point) at.emplace_back(value);
        at[row].d.v += 1;
        at[column].v.d += 1;
        const double reference = e.value<Second>(at).d.d;
        const Expr entry = found[{row, column}];
        const double value = evaluate<double>(g, {&entry, 1}, e.point)[0];
        const double bound = rounding_bounds(g, {&entry, 1}, e.point)[0];
        EXPECT_NEAR(value, reference, tolerance(bound, reference))
            << "expression " << i << ", entry " << row << ", " << column;
      }
    }
  }
}

TEST(DerivativeProperty, TimeDerivativeAgainstDualNumbers) {
  SCOPED_TRACE(testing::Message() << "seed " << seed + 2);
  RandomExpressions random(seed + 2);
  for (int i = 0; i < 500 && !testing::Test::HasFailure(); ++i) {
    Graph g;
    const auto e = random.make(g, 25, 3);
    const Expr rate = *time_derivative(g, e.expr.back());
    std::vector<double> inputs(g.inputs().size());
    std::vector<Dual<double>> at;
    for (int k = 0; k < 3; ++k) {
      auto input = g.input_of(e.variables[k]);
      const double velocity = 0.5 + k;
      inputs[g.node(e.variables[k]).input] = e.point[k];
      input.derivative = 1;
      const Expr v = g.input(input);
      inputs.resize(g.inputs().size());
      inputs[g.node(v).input] = velocity;
      at.emplace_back(e.point[k], velocity);
    }
    const double reference = e.value<Dual<double>>(at).d;
    EXPECT_NEAR(evaluate<double>(g, {&rate, 1}, inputs)[0], reference,
                tolerance(rounding_bounds(g, {&rate, 1}, inputs)[0], reference));
  }
}

}  // namespace
}  // namespace spacetime::symbolic
