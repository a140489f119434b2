// Every operation by itself, on every target: its values, and that no lane looks at another.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "common/evaluate.h"
#include "tests/common/bit_hash.h"
#include "tests/common/scalar.h"

namespace spacetime {

void PrintTo(Op op, std::ostream* out) { *out << info(op).name; }  // names the tests

namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN(),
                 tiny = std::numeric_limits<double>::denorm_min(), smallest = std::numeric_limits<double>::min(),
                 largest = std::numeric_limits<double>::max();
constexpr double special[] = {0.0,   -0.0,   1.0,      -1.0,      0.5,     -2.0,     inf, -inf,   nan, tiny,
                              -tiny, 3e-310, smallest, -smallest, largest, -largest, 1e9, -1e300, 1e-9};

// op applied to the inputs.
Program program_of(Op op) {
  Program program;
  const int arity = info(op).arity;
  for (int i = 0; i < arity; ++i) program.inputs.push_back({InputKind::dof, std::string(1, char('a' + i)), 0, 0});
  program.op = {op};
  program.a = {0};
  program.b = {arity > 1 ? 1 : 0};
  program.c = {arity > 2 ? 2 : 0};
  program.values = {arity};
  program.value_operations = program.jacobian_operations = 1;
  return program;
}

using Columns = std::vector<std::vector<double>>;

std::vector<double> run(const Evaluator& evaluator, const Columns& columns) {
  std::vector<const double*> inputs;
  for (const auto& column : columns) inputs.push_back(column.data());
  const auto samples = columns.front().size();
  std::vector<double> result(samples);
  evaluator.run(Depth::values, samples, inputs, std::vector<std::uint8_t>(columns.size(), 0), result.data(), samples);
  return result;
}

// Every combination of special numbers, and random ones of many magnitudes.
Columns points(int arity, std::mt19937_64& random) {
  Columns columns(arity);
  std::size_t combinations = 1;
  for (int k = 0; k < arity; ++k) combinations *= std::size(special);
  for (std::size_t i = 0; i < combinations; ++i) {
    auto rest = i;
    for (auto& column : columns) column.push_back(special[rest % std::size(special)]), rest /= std::size(special);
  }
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-6, 6);
  for (int i = 0; i < 2000; ++i) {
    for (auto& column : columns) column.push_back(std::ldexp(mantissa(random), exponent(random)));
  }
  return columns;
}

class Operation : public testing::TestWithParam<Op> {
 protected:
  Op op = GetParam();
  Program program = program_of(op);
  std::mt19937_64 random{20240117};
  Columns columns = points(info(op).arity, random);
};

TEST_P(Operation, HasTheScalarsValueOnEveryTarget) {
  for (const auto target : evaluation_targets()) {
    const auto result = run(Evaluator(program, target), columns);
    const bool exact = is_exact(op) || target == "generic";
    for (std::size_t s = 0; s < result.size(); ++s) {
      double x[3] = {};
      for (std::size_t k = 0; k < columns.size(); ++k) x[k] = columns[k][s];
      const double expected = scalar(op, x[0], x[1], x[2]);
      if (exact ? same(result[s], expected) : ulps(result[s], expected) <= 4) continue;
      ADD_FAILURE() << target << ": " << info(op).name << '(' << x[0] << ", " << x[1] << ", " << x[2]
                    << ") = " << result[s] << ", not " << expected << ", " << ulps(result[s], expected) << " ulps";
    }
  }
}

TEST_P(Operation, GivesASampleTheSameBitsInAnyCompany) {
  for (const auto target : evaluation_targets()) {
    const Evaluator evaluator(program, target);
    const auto together = run(evaluator, columns);
    for (int trial = 0; trial < 400; ++trial) {
      const auto s = random() % together.size(), samples = 1 + random() % 130, place = random() % samples;
      Columns company(columns.size());
      for (std::size_t i = 0; i < samples; ++i) {
        const auto from = i == place ? s : random() % together.size();
        for (std::size_t k = 0; k < columns.size(); ++k) company[k].push_back(columns[k][from]);
      }
      EXPECT_TRUE(same(run(evaluator, company)[place], together[s]))
          << target << ": " << info(op).name << " at place " << place << " of " << samples;
    }
  }
}

TEST_P(Operation, HasTheSameBitsOnAllVectorTargets) {
  const auto targets = vector_targets();
  for (std::size_t k = 1; k < targets.size(); ++k) {
    EXPECT_TRUE(std::ranges::equal(run(Evaluator(program, targets[k - 1]), columns),
                                   run(Evaluator(program, targets[k]), columns), same))
        << targets[k - 1] << " and " << targets[k];
  }
}

std::vector<Op> all_operations() {
  std::vector<Op> result;
  for (int i = 0; i < op_count; ++i) result.push_back(static_cast<Op>(i));
  return result;
}
INSTANTIATE_TEST_SUITE_P(Each, Operation, testing::ValuesIn(all_operations()),
                         [](const auto& test) { return std::string(spacetime::info(test.param).name); });

// The bits themselves, of all operations in their order; see Evaluate.VectorTargetsHaveTheKnownBits.
TEST(Operations, HaveTheKnownBitsOnVectorTargets) {
  for (const auto target : vector_targets()) {
    BitHash hash;
    for (const Op op : all_operations()) {
      std::mt19937_64 random(20240119);
      hash.add(run(Evaluator(program_of(op), target), points(info(op).arity, random)));
    }
    EXPECT_EQ(hash.value(), 0x327ff411291133ceU) << target;
  }
}

TEST(Operations, FollowTheLanguageAtTiesAndKinks) {
  for (const auto target : evaluation_targets()) {
    const auto value = [&](Op op, std::vector<double> operands) {
      Columns one;
      for (const double x : operands) one.push_back({x});
      return run(Evaluator(program_of(op), target), one).front();
    };
    EXPECT_TRUE(same(value(Op::minimum, {-0.0, 0.0}), -0.0));  // the first at a tie
    EXPECT_TRUE(same(value(Op::minimum, {0.0, -0.0}), 0.0));
    EXPECT_TRUE(same(value(Op::maximum, {-0.0, 0.0}), -0.0));
    EXPECT_TRUE(same(value(Op::maximum, {0.0, -0.0}), 0.0));
    EXPECT_TRUE(std::isnan(value(Op::minimum, {nan, 1})));  // and with a NaN
    EXPECT_EQ(value(Op::maximum, {1, nan}), 1);
    EXPECT_TRUE(same(value(Op::sign, {-0.0}), 0.0));
    EXPECT_EQ(value(Op::select, {1, 2, nan}), 2);  // what is not chosen does not leak
    EXPECT_EQ(value(Op::select, {0, nan, 3}), 3);
    EXPECT_EQ(value(Op::select, {-0.0, nan, 3}), 3);
    const double x = 1 + 0x1p-30;
    EXPECT_EQ(value(Op::multiply_add, {x, x, -1 - 0x1p-29}), 0x1p-60);  // rounded once
  }
}

}  // namespace
}  // namespace spacetime
