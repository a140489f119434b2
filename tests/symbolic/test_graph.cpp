#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "symbolic/graph.h"
#include "symbolic/value.h"
#include "tests/symbolic/random_expression.h"

namespace spacetime::symbolic {
namespace {

struct GraphTest : testing::Test {
  Graph g;
  Expr dof(const std::string& name) {
    return g.input({.kind = InputKind::dof, .name = name, .index = 0, .derivative = 0});
  }
  Expr x = dof("x"), y = dof("y"), z = dof("z");
  Expr n(double value) { return g.number(value); }
};

TEST_F(GraphTest, WhatIsBuiltAlikeIsOneNode) {
  EXPECT_EQ(g.add(x, y), g.add(y, x));
  EXPECT_EQ(g.multiply(x, y), g.multiply(y, x));
  EXPECT_EQ(g.operation(Op::logical_and, x, y), g.operation(Op::logical_and, y, x));
  EXPECT_EQ(dof("x"), x);
  EXPECT_NE(g.subtract(x, y), g.subtract(y, x));
  EXPECT_EQ(g.number(-0.0), n(0));
  EXPECT_EQ(Expr{}, n(0));
  EXPECT_NE(g.input({.kind = InputKind::dof, .name = "x", .index = 0, .derivative = 1}), x);
}

TEST_F(GraphTest, TheOrderOfMinimumAndMaximumStays) {  // a tie follows the first
  EXPECT_NE(g.operation(Op::minimum, x, y), g.operation(Op::minimum, y, x));
}

TEST_F(GraphTest, NeutralElements) {
  EXPECT_EQ(g.add(x, n(0)), x);
  EXPECT_EQ(g.subtract(x, n(0)), x);
  EXPECT_EQ(g.subtract(n(0), x), g.negate(x));
  EXPECT_EQ(g.multiply(x, n(1)), x);
  EXPECT_EQ(g.multiply(x, n(0)), n(0));
  EXPECT_EQ(g.multiply(x, n(-1)), g.negate(x));
  EXPECT_EQ(g.divide(x, n(1)), x);
  EXPECT_EQ(g.divide(n(0), x), n(0));
  EXPECT_EQ(g.subtract(x, x), n(0));
  EXPECT_EQ(g.add(x, g.negate(x)), n(0));
  EXPECT_EQ(g.power(x, n(0)), n(1));
  EXPECT_EQ(g.power(x, n(1)), x);
  EXPECT_EQ(g.power(n(1), x), n(1));
}

TEST_F(GraphTest, WhatMayBeUndefinedIsNotCancelled) {
  EXPECT_NE(g.divide(x, x), n(1));  // 0/0
  const Expr e = g.operation(Op::exponential, x);
  EXPECT_EQ(g.divide(e, e), n(1));
}

TEST_F(GraphTest, NumbersGather) {
  EXPECT_EQ(g.multiply(n(2), g.multiply(n(3), x)), g.multiply(n(6), x));
  EXPECT_EQ(g.multiply(g.multiply(n(2), x), g.multiply(n(3), y)), g.multiply(n(6), g.multiply(x, y)));
  EXPECT_EQ(g.add(g.add(x, n(1)), n(2)), g.add(x, n(3)));
  EXPECT_EQ(g.subtract(g.add(x, n(1)), n(1)), x);
  EXPECT_EQ(g.subtract(g.add(x, n(1)), g.add(y, n(3))), g.add(g.subtract(x, y), n(-2)));
  EXPECT_EQ(g.add(x, x), g.multiply(n(2), x));
  EXPECT_EQ(g.subtract(g.multiply(n(5), x), g.multiply(n(5), x)), n(0));
  EXPECT_EQ(g.add(g.multiply(n(5), x), g.multiply(n(-4), x)), x);
  EXPECT_EQ(g.divide(x, n(4)), g.multiply(n(0.25), x));
  EXPECT_EQ(g.divide(g.multiply(n(6), x), n(2)), g.multiply(n(3), x));
}

TEST_F(GraphTest, SignsStandOutside) {
  const Expr difference = g.subtract(x, y);
  EXPECT_EQ(g.subtract(y, x), g.negate(difference));
  EXPECT_EQ(g.negate(g.negate(x)), x);
  EXPECT_EQ(g.multiply(g.negate(x), y), g.negate(g.multiply(x, y)));
  EXPECT_EQ(g.multiply(g.negate(x), g.negate(y)), g.multiply(x, y));
  EXPECT_EQ(g.multiply(difference, g.subtract(y, x)), g.negate(g.multiply(difference, difference)));
  EXPECT_EQ(g.divide(g.negate(x), y), g.negate(g.divide(x, y)));
  EXPECT_EQ(g.divide(n(-2), x), g.negate(g.divide(n(2), x)));
  EXPECT_EQ(g.add(g.negate(x), g.negate(y)), g.negate(g.add(x, y)));
  EXPECT_EQ(g.add(x, g.negate(y)), difference);
  EXPECT_EQ(g.subtract(n(1), x), g.negate(g.add(x, n(-1))));
  EXPECT_EQ(g.multiply(n(-2), x), g.negate(g.multiply(n(2), x)));
  for (const auto op :
       {Op::sine, Op::tangent, Op::arc_sine, Op::arc_tangent, Op::hyperbolic_sine, Op::hyperbolic_tangent, Op::sign}) {
    EXPECT_EQ(g.operation(op, g.negate(x)), g.negate(g.operation(op, x)));
  }
  for (const auto op : {Op::cosine, Op::hyperbolic_cosine, Op::absolute}) {
    EXPECT_EQ(g.operation(op, g.negate(x)), g.operation(op, x));
  }
}

TEST_F(GraphTest, SumsUndoThemselves) {
  EXPECT_EQ(g.add(g.subtract(x, y), y), x);
  EXPECT_EQ(g.subtract(g.add(x, y), y), x);
  EXPECT_EQ(g.subtract(g.add(x, y), x), y);
  EXPECT_EQ(g.subtract(x, g.add(x, y)), g.negate(y));
  EXPECT_EQ(g.subtract(x, g.subtract(x, y)), y);
  EXPECT_EQ(g.subtract(g.subtract(x, y), x), g.negate(y));
}

TEST_F(GraphTest, PiIsExact) {
  EXPECT_EQ(g.cosine(g.pi(0.5)), n(0));
  EXPECT_EQ(g.cosine(g.pi(-1.5)), n(0));
  EXPECT_EQ(g.sine(g.pi()), n(0));
  EXPECT_EQ(g.sine(g.pi(-0.5)), n(-1));
  EXPECT_EQ(g.sine(g.pi(1e6 + 0.5)), n(1));
  EXPECT_EQ(g.cosine(g.divide(g.pi(), n(3))), n(0.5));
  EXPECT_EQ(g.sine(g.divide(g.pi(), n(-6))), n(-0.5));
  EXPECT_EQ(g.sine(g.pi(0.75)), n(std::sqrt(0.5)));
  EXPECT_EQ(g.operation(Op::tangent, g.pi(0.25)), n(1));
  EXPECT_TRUE(g.is_undefined(g.operation(Op::tangent, g.pi(0.5))));
  EXPECT_EQ(g.add(g.pi(0.5), g.pi(0.5)), g.pi());
  EXPECT_EQ(g.subtract(g.pi(0.5), g.pi(0.5)), n(0));
  EXPECT_EQ(g.divide(g.multiply(n(3), g.pi()), n(2)), g.pi(1.5));
  EXPECT_EQ(g.divide(g.pi(2), g.pi()), n(2));
  EXPECT_EQ(g.negate(g.pi()), g.pi(-1));
  EXPECT_EQ(g.operation(Op::absolute, g.pi(-2)), g.pi(2));
  EXPECT_EQ(*g.constant(g.add(g.pi(), n(1))), std::numbers::pi + 1);
  EXPECT_EQ(*g.constant(g.pi(0.5)), std::numbers::pi / 2);
  for (double k = -3; k < 3; k += 0.0371) {
    EXPECT_NEAR(*g.constant(g.sine(g.pi(k))), std::sin(k * std::numbers::pi), 2e-15);
    EXPECT_NEAR(*g.constant(g.cosine(g.pi(k))), std::cos(k * std::numbers::pi), 2e-15);
  }
}

TEST_F(GraphTest, QuarterTurnsFloatOutOfAngles) {
  const Expr a = g.add(g.add(x, g.pi(-0.5)), y);
  EXPECT_EQ(a, g.add(g.add(x, y), g.pi(-0.5)));
  EXPECT_EQ(g.cosine(a), g.sine(g.add(x, y)));
  EXPECT_EQ(g.sine(a), g.negate(g.cosine(g.add(x, y))));
  EXPECT_EQ(g.sine(g.subtract(g.pi(), x)), g.sine(x));
  EXPECT_EQ(g.cosine(g.add(g.pi(3), x)), g.negate(g.cosine(x)));
  EXPECT_EQ(g.cosine(g.add(g.pi(2), x)), g.cosine(x));
  EXPECT_EQ(g.operation(Op::tangent, g.add(x, g.pi())), g.operation(Op::tangent, x));
}

TEST_F(GraphTest, PowersBecomeProducts) {
  EXPECT_EQ(g.power(x, n(2)), g.multiply(x, x));
  const auto before = g.size();
  const Expr p = g.power(x, n(64));
  EXPECT_LE(g.size() - before, 7u);
  EXPECT_EQ(g.power(x, n(-2)), g.divide(n(1), g.multiply(x, x)));
  EXPECT_EQ(g.power(x, n(0.5)), g.square_root(x));
  EXPECT_TRUE(g.is_operation(g.power(x, n(65)), Op::power));
  EXPECT_TRUE(g.is_operation(g.power(x, n(1.5)), Op::power));
  const double at[] = {1.1};
  EXPECT_NEAR(evaluate<double>(g, {&p, 1}, at)[0], std::pow(1.1, 64), 1e-11);
}

TEST_F(GraphTest, ChoicesThatAreKnownAreMade) {
  EXPECT_EQ(g.select(n(1), x, y), x);
  EXPECT_EQ(g.select(n(0), x, y), y);
  EXPECT_EQ(g.select(g.operation(Op::less, n(1), n(2)), x, y), x);
  EXPECT_EQ(g.select(z, x, x), x);
  const Expr c = g.operation(Op::less, x, y), d = g.operation(Op::less, y, z);
  EXPECT_EQ(g.select(g.operation(Op::logical_not, c), x, y), g.select(c, y, x));
  EXPECT_EQ(g.operation(Op::logical_not, g.operation(Op::logical_not, c)), c);
  EXPECT_EQ(g.operation(Op::logical_and, c, n(0)), n(0));
  EXPECT_EQ(g.operation(Op::logical_and, n(3), c), c);
  EXPECT_EQ(g.operation(Op::logical_or, c, n(3)), n(1));
  EXPECT_EQ(g.operation(Op::logical_or, c, d), g.operation(Op::logical_or, d, c));
  EXPECT_EQ(g.operation(Op::less, x, x), n(0));
  EXPECT_EQ(g.operation(Op::less_equal, x, x), n(1));
  EXPECT_EQ(g.operation(Op::minimum, n(2), n(1)), n(1));
  EXPECT_EQ(g.operation(Op::maximum, g.pi(), n(3)), g.pi());
}

TEST_F(GraphTest, ConstantsWithoutFiniteValueStay) {
  for (const auto e : {g.divide(n(1), n(0)), g.operation(Op::logarithm, n(0)), g.square_root(n(-1)),
                       g.power(n(-8), n(1.5)), g.multiply(n(1e300), n(1e300)), g.divide(g.pi(), n(0))}) {
    EXPECT_TRUE(g.is_undefined(e));
    EXPECT_FALSE(g.constant(e));
    EXPECT_NE(g.multiply(n(0), e), n(0)) << "0 * inf is no 0";
  }
  EXPECT_FALSE(g.is_undefined(x));
  EXPECT_FALSE(g.is_undefined(g.divide(n(1), x)));
}

TEST_F(GraphTest, DeepExpressionsNeedNoStack) {
  Expr sum = x, nested = x;
  for (int i = 0; i < 100'000; ++i) {
    sum = g.add(g.multiply(sum, y), n(i % 7));
    nested = g.sine(nested);
  }
  const Expr roots[] = {sum, nested};
  const double at[] = {0.3, 0.5, 0};
  const auto value = evaluate<double>(g, roots, at);
  EXPECT_TRUE(std::isfinite(value[0]));
  EXPECT_NEAR(value[1], std::sqrt(3.0 / 100'000), 1e-4);  // sin iterated n times approaches sqrt(3/n)
}

// The folded graph against what was written, over every operation.
TEST(GraphProperty, FoldingKeepsTheValue) {
  constexpr std::uint64_t seed = 20240901;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomExpressions random(seed);
  int seen[op_count] = {};
  for (int i = 0; i < 2000; ++i) {
    Graph g;
    const auto e = random.make(g, 20, 3);
    const auto raw = e.values<double>(e.point);
    const auto folded = evaluate<double>(g, e.expr, e.point);
    const auto bound = rounding_bounds(g, e.expr, e.point);
    for (std::size_t k = 0; k < raw.size(); ++k) {
      if (!e.raw[k].tame) continue;  // at the edge of a domain rounding decides
      if (e.raw[k].is_operation) ++seen[static_cast<int>(e.raw[k].op)];
      // Folding adds in another order, so cancellation may cost more than the bound of the folded form.
      EXPECT_NEAR(folded[k], raw[k], 100 * bound[k] + 1e-12 * std::fmax(1, std::fabs(raw[k])))
          << "expression " << i << ", node " << k;
    }
    if (HasFailure()) break;
  }
  for (int op = 0; op < op_count; ++op) EXPECT_GT(seen[op], 100) << info(static_cast<Op>(op)).name;
}

}  // namespace
}  // namespace spacetime::symbolic
