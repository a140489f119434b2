#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "common/evaluate.h"
#include "symbolic/derivative.h"
#include "symbolic/emit.h"
#include "symbolic/value.h"
#include "tests/symbolic/planar_arm.h"
#include "tests/symbolic/random_expression.h"

namespace spacetime::symbolic {
namespace {

struct EmitTest : testing::Test {
  Graph g;
  Expr input(InputKind kind, const std::string& name) {
    return g.input({.kind = kind, .name = name, .index = 0, .derivative = 0});
  }
  Expr x = input(InputKind::dof, "x"), y = input(InputKind::dof, "y"), k = input(InputKind::constant, "k");
  Program program(std::vector<Expr> values, Derivatives derivatives) {
    auto result = emit(g, values, derivatives);
    if (const auto fault = validate(result)) ADD_FAILURE() << fault->path << ": " << fault->message;
    return result;
  }
};

std::size_t count(const Program& program, Op op) {
  return static_cast<std::size_t>(std::count(program.op.begin(), program.op.end(), op));
}

// Every operation's result is used.
void expect_nothing_dead(const Program& program) {
  std::set<std::int32_t> used(program.values.begin(), program.values.end());
  for (const auto& entry : program.jacobian) used.insert(entry.value);
  for (const auto& entry : program.hessian) used.insert(entry.value);
  for (std::size_t i = 0; i < program.op.size(); ++i) {
    const int arity = info(program.op[i]).arity;
    used.insert(program.a[i]);
    if (arity > 1) used.insert(program.b[i]);
    if (arity > 2) used.insert(program.c[i]);
  }
  for (auto v = static_cast<std::int32_t>(program.inputs.size()); v < program.value_count(); ++v) {
    EXPECT_TRUE(used.count(v)) << "value " << v << " in\n" << print(program);
  }
}

TEST_F(EmitTest, ValuesThenJacobianThenHessian) {
  const auto p = program({g.multiply(k, g.multiply(g.sine(x), y))}, Derivatives::second);
  EXPECT_LT(p.value_operations, p.jacobian_operations);
  EXPECT_LT(p.jacobian_operations, static_cast<std::int32_t>(p.op.size()));
  ASSERT_EQ(p.inputs.size(), 4u);
  EXPECT_EQ(p.inputs[0].name, "x");
  EXPECT_EQ(p.inputs[1].name, "y");
  EXPECT_EQ(p.inputs[2].name, "k");
  EXPECT_EQ(p.inputs[3].kind, InputKind::multiplier);
  EXPECT_EQ(p.jacobian.size(), 2u);
  EXPECT_EQ(p.hessian.size(), 2u);  // xx and yx; yy is zero
  const double at[] = {0.3, 2, 5, 7};
  const auto out = evaluate_once(p, Depth::hessian, at);
  ASSERT_EQ(out.size(), 5u);
  EXPECT_NEAR(out[0], 10 * std::sin(0.3), 1e-14);
  EXPECT_NEAR(out[1], 10 * std::cos(0.3), 1e-14);
  EXPECT_NEAR(out[2], 5 * std::sin(0.3), 1e-14);
  EXPECT_NEAR(out[3], -70 * std::sin(0.3), 1e-13);
  EXPECT_NEAR(out[4], 35 * std::cos(0.3), 1e-13);
}

TEST_F(EmitTest, OnlyWhatIsAskedFor) {
  const Expr f = g.multiply(g.sine(x), y);
  EXPECT_TRUE(program({f}, Derivatives::none).jacobian.empty());
  const auto first = program({f}, Derivatives::first);
  EXPECT_EQ(first.jacobian.size(), 2u);
  EXPECT_TRUE(first.hessian.empty());
  EXPECT_EQ(first.jacobian_operations, static_cast<std::int32_t>(first.op.size()));
  EXPECT_EQ(program({k}, Derivatives::second).jacobian.size(), 0u);  // no unknowns
  EXPECT_TRUE(program({}, Derivatives::second).op.empty());
}

TEST_F(EmitTest, AnUnknownOfEveryKindCounts) {
  const Expr p = input(InputKind::parameter, "p");
  const Expr z = g.input({.kind = InputKind::functional, .name = {}, .index = 3, .derivative = 0});
  const Expr t = g.input({.kind = InputKind::time, .name = {}, .index = 0, .derivative = 0});
  const Expr v = g.input({.kind = InputKind::dof, .name = "x", .index = 0, .derivative = 1});
  const auto made = program({g.add(g.multiply(p, z), g.multiply(t, g.multiply(v, k)))}, Derivatives::second);
  EXPECT_EQ(made.jacobian.size(), 3u);
  EXPECT_EQ(made.hessian.size(), 1u);
}

TEST_F(EmitTest, LinearValuesHaveConstantDerivatives) {
  const auto p = program({g.subtract(x, y), g.multiply(g.number(3), x)}, Derivatives::second);
  EXPECT_EQ(p.jacobian.size(), 3u);
  EXPECT_TRUE(p.hessian.empty());
  EXPECT_EQ(p.jacobian_operations, p.value_operations);
  const double at[] = {5, 2};
  EXPECT_EQ(evaluate_once(p, Depth::hessian, at), (std::vector<double>{3, 15, 1, -1, 3}));
}

TEST_F(EmitTest, InputsAndNumbersMayBeValues) {
  const auto p = program({x, g.number(4), g.pi(0.5), x}, Derivatives::second);
  EXPECT_TRUE(p.op.empty());
  const double at[] = {5};
  EXPECT_EQ(evaluate_once(p, Depth::jacobian, at), (std::vector<double>{5, 4, M_PI / 2, 5, 1, 1}));
}

TEST_F(EmitTest, AProductUsedOnceByASumIsFused) {
  const Expr product = g.multiply(x, y);
  const auto fused = program({g.add(product, k)}, Derivatives::none);
  EXPECT_EQ(fused.op, (std::vector{Op::multiply_add}));
  const auto twice = program({g.add(product, k), g.add(product, x)}, Derivatives::none);
  EXPECT_EQ(twice.op, (std::vector{Op::multiply_add, Op::multiply_add}));  // nobody needs the product by itself
  const auto also = program({g.add(product, k), g.sine(product)}, Derivatives::none);
  EXPECT_EQ(count(also, Op::multiply), 1u);
  EXPECT_EQ(count(also, Op::multiply_add), 0u);
  const auto output = program({g.add(product, k), product}, Derivatives::none);
  EXPECT_EQ(count(output, Op::multiply), 1u);
  EXPECT_EQ(count(output, Op::multiply_add), 0u);
  const auto scaled = program({g.subtract(k, g.multiply(g.number(2), x))}, Derivatives::none);
  EXPECT_EQ(scaled.op, (std::vector{Op::multiply_add}));
  const double at[] = {3, 10};
  EXPECT_EQ(evaluate_once(scaled, Depth::values, at)[0], 4);
}

// Where several sums subtract products of one factor, it is negated once.
TEST_F(EmitTest, SignsAreKeptWhereTheyCostLeast) {
  std::vector<Expr> values;
  const Expr s = g.sine(x);
  for (const auto* name : {"a", "b", "c", "d"}) {
    const Expr other = input(InputKind::constant, name);
    values.push_back(g.subtract(other, g.multiply(s, g.add(other, y))));
  }
  const auto p = program(values, Derivatives::none);
  EXPECT_EQ(count(p, Op::multiply_add), 4u);
  EXPECT_LE(p.op.size(), 10u);
  EXPECT_EQ(program({g.negate(g.subtract(x, y))}, Derivatives::none).op, (std::vector{Op::subtract}));
  EXPECT_EQ(program({g.negate(g.operation(Op::exponential, g.negate(x)))}, Derivatives::none).op,
            (std::vector{Op::negate, Op::exponential, Op::negate}));
  EXPECT_EQ(program({g.negate(x), x}, Derivatives::none).op, (std::vector{Op::negate}));
}

TEST_F(EmitTest, AProductOfTheDerivativesIsNotTakenFromTheValues) {
  // x*y is needed by the value's sum alone at first, but again by the Hessian of the second value.
  const Expr f = g.operation(Op::exponential, g.multiply(x, y));
  const auto p = program({f, g.add(g.multiply(x, y), k)}, Derivatives::second);
  expect_nothing_dead(p);
  const double at[] = {0.3, 0.4, 1, 2, 3};
  const double e = std::exp(0.12);
  const auto out = evaluate_once(p, Depth::hessian, at);
  EXPECT_NEAR(out[0], e, 1e-15);
  EXPECT_NEAR(out[1], 1.12, 1e-15);
}

TEST_F(EmitTest, MultipliersWeighTheRows) {
  const auto p = program({g.multiply(x, y), g.multiply(x, g.multiply(x, x)), y}, Derivatives::second);
  std::vector<double> at;
  for (const auto& i : p.inputs) at.push_back(i.kind == InputKind::multiplier ? 10 + i.index : i.name == "x" ? 2 : 3);
  const auto out = evaluate_once(p, Depth::hessian, at);
  ASSERT_EQ(p.hessian.size(), 2u);
  EXPECT_EQ(out[out.size() - 2], 11 * 6 * 2);                                                    // xx
  EXPECT_EQ(out[out.size() - 1], 10);                                                            // yx
  for (const auto& i : p.inputs) EXPECT_FALSE(i.kind == InputKind::multiplier && i.index == 2);  // linear: not used
}

TEST_F(EmitTest, SizesAreCountedAsTreeAndAsGraph) {
  Expr e = x;
  for (int i = 0; i < 100; ++i) e = g.multiply(e, e);
  const auto size = size_of(g, {&e, 1});
  EXPECT_EQ(size.shared, 101u);
  EXPECT_EQ(size.tree, std::ldexp(2, 100) - 1);
  const Expr twice[] = {x, x};
  EXPECT_EQ(size_of(g, twice).shared, 1u);
  EXPECT_EQ(size_of(g, twice).tree, 2);
}

TEST_F(EmitTest, DeepExpressionsNeedNoStack) {
  Expr e = x;
  for (int i = 0; i < 100'000; ++i) e = g.sine(g.add(e, y));
  const auto p = program({e}, Derivatives::first);
  EXPECT_EQ(p.value_operations, 200'000);
  EXPECT_EQ(p.jacobian.size(), 2u);
}

// The arm's program has no dead operations, and runs alike at every depth.
TEST_F(EmitTest, PrefixesAgree) {
  const auto arm = planar_arm(g, 3);
  const auto tau = generalised_forces(g, arm);
  for (const auto& values : {std::vector{summed_squares(g, tau)}, tau}) {
    const auto p = program(values, Derivatives::second);
    expect_nothing_dead(p);
    std::vector<double> at;
    for (std::size_t i = 0; i < p.inputs.size(); ++i) at.push_back(std::sin(static_cast<double>(i) + 1));
    const auto all = evaluate_once(p, Depth::hessian, at);
    for (const auto depth : {Depth::values, Depth::jacobian}) {
      const auto part = evaluate_once(p, depth, at);
      ASSERT_LE(part.size(), all.size());
      EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin()));
    }
  }
}

// Random expressions: the program against direct evaluation of the graph, values, Jacobian and Hessian, the last
// weighted with multipliers.
TEST(EmitProperty, ProgramsComputeWhatTheGraphSays) {
  constexpr std::uint64_t seed = 20020718;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  RandomExpressions random(seed);
  int seen[op_count] = {};
  for (int i = 0; i < 600 && !testing::Test::HasFailure(); ++i) {
    Graph g;
    const auto e = random.make(g, 25, 3);
    const int rows = 1 + i % 3;
    const std::vector<Expr> values(e.expr.end() - rows, e.expr.end());
    const auto p = emit(g, values, Derivatives::second);
    const auto fault = validate(p);
    ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
    expect_nothing_dead(p);
    for (const auto op : p.op) ++seen[static_cast<int>(op)];

    const auto multiplier = [&](int row) { return g.input({.kind = InputKind::multiplier, .name = {}, .index = row}); };
    std::vector<double> inputs(g.inputs().size()), at;
    for (std::size_t k = 0; k < g.inputs().size(); ++k) {
      const auto& input = g.inputs()[k];
      inputs[k] = input.kind == InputKind::multiplier ? 0.5 + input.index : e.point[input.name[1] - '0'];
    }
    for (const auto& input : p.inputs) at.push_back(inputs[g.node(g.input(input)).input]);
    const auto out = evaluate_once(p, Depth::hessian, at);

    // The Hessian is the sum of those of the rows.
    std::map<std::pair<int, int>, Expr> sum;
    std::vector<Expr> expected = values;
    for (const auto& entry : jacobian(g, values, e.variables)) expected.push_back(entry.value);
    for (int row = 0; row < rows; ++row) {
      for (const auto& entry : hessian(g, values[row], e.variables)) {
        auto& term = sum[{entry.row, entry.column}];
        term = g.add(term, g.multiply(multiplier(row), entry.value));
      }
    }
    inputs.resize(g.inputs().size(), 1);
    ASSERT_EQ(p.values.size() + p.jacobian.size(), expected.size());
    const auto direct = evaluate<double>(g, expected, inputs);
    const auto bound = rounding_bounds(g, expected, inputs);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_NEAR(out[k], direct[k], 4 * bound[k] + 1e-300) << "expression " << i << ", output " << k;
    }
    for (std::size_t k = 0; k < p.hessian.size(); ++k) {
      const auto place = [&](int input) { return p.inputs[input].name[1] - '0'; };
      const auto entry = sum[{place(p.hessian[k].row), place(p.hessian[k].column)}];
      const double reference = evaluate<double>(g, {&entry, 1}, inputs)[0];
      const double room = rounding_bounds(g, {&entry, 1}, inputs)[0];
      EXPECT_NEAR(out[expected.size() + k], reference, 100 * room + 1e-9 * std::fmax(1, std::fabs(reference)));
    }
  }
  for (int op = 0; op < op_count; ++op) EXPECT_GT(seen[op], 20) << info(static_cast<Op>(op)).name;
}

}  // namespace
}  // namespace spacetime::symbolic
