// Whole programs: slots, blocks, prefixes, targets.
#include "common/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "tests/common/bit_hash.h"
#include "tests/common/random_program.h"
#include "tests/common/scalar.h"

namespace spacetime {
namespace {

constexpr std::uint64_t seed = 20240118;

// A program of any operations with any operands, and outputs of all three kinds, inputs and numbers among them.
Program wild_program(std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::int32_t>(random() % n); };
  Program program;
  const int inputs = 1 + below(6);
  for (int i = 0; i < inputs; ++i) program.inputs.push_back({InputKind::functional, "", i, 0});
  for (int i = below(4); i > 0; --i) program.numbers.push_back(below(7) - 3);
  const int operations = below(200);
  for (int i = 0; i < operations; ++i) {
    const auto op = static_cast<Op>(below(op_count));
    const auto own = program.value_count();
    const auto operand = [&](int k) { return k < info(op).arity ? below(own) : 0; };
    program.a.push_back(operand(0));
    program.b.push_back(operand(1));
    program.c.push_back(operand(2));
    program.op.push_back(op);
  }
  program.value_operations = below(operations + 1);
  program.jacobian_operations = program.value_operations + below(operations - program.value_operations + 1);
  const auto first = program.first_operation();
  for (int i = below(5); i >= 0; --i) program.values.push_back(below(first + program.value_operations));
  for (int row = 0; row < static_cast<int>(program.values.size()); ++row) {
    for (int input = 0; input < inputs; ++input) {
      if (below(2)) program.jacobian.push_back({row, input, below(first + program.jacobian_operations)});
    }
  }
  for (int row = 0; row < inputs; ++row) {
    for (int column = 0; column <= row; ++column) {
      if (below(2)) program.hessian.push_back({row, column, below(first + operations)});
    }
  }
  return program;
}

// What the program's outputs are, in order, at one point.
std::vector<double> expected(const Program& program, Depth depth, std::span<const double> point) {
  const auto v = scalar(program, point);
  std::vector<double> result;
  for (const auto value : program.values) result.push_back(v[value]);
  if (depth >= Depth::jacobian) {
    for (const auto& entry : program.jacobian) result.push_back(v[entry.value]);
  }
  if (depth >= Depth::hessian) {
    for (const auto& entry : program.hessian) result.push_back(v[entry.value]);
  }
  return result;
}

// Inputs at some samples: columns[i] has one number where uniform[i].
struct Points {
  std::size_t samples;
  std::vector<std::vector<double>> columns;
  std::vector<std::uint8_t> uniform;

  double at(std::size_t input, std::size_t sample) const { return columns[input][uniform[input] ? 0 : sample]; }
  std::vector<double> sample(std::size_t s) const {
    std::vector<double> point;
    for (std::size_t i = 0; i < columns.size(); ++i) point.push_back(at(i, s));
    return point;
  }
};

Points random_points(std::size_t inputs, std::size_t samples, std::mt19937_64& random) {
  Points points{samples, {}, {}};
  for (std::size_t i = 0; i < inputs; ++i) {
    points.uniform.push_back(random() % 3 == 0);
    auto& column = points.columns.emplace_back(points.uniform[i] ? 1 : samples);
    for (auto& x : column) x = std::uniform_real_distribution<double>(-2, 2)(random);
  }
  return points;
}

constexpr double untouched = 12345.678;

// Rows of samples; beyond them, up to the stride, nothing may be written.
std::vector<std::vector<double>> run(const Evaluator& evaluator, Depth depth, const Points& points) {
  std::vector<const double*> inputs;
  for (const auto& column : points.columns) inputs.push_back(column.data());
  const auto stride = points.samples + 3;
  std::vector<double> outputs(evaluator.outputs(depth) * stride, untouched);
  evaluator.run(depth, points.samples, inputs, points.uniform, outputs.data(), stride);
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < evaluator.outputs(depth); ++row) {
    const auto begin = outputs.begin() + static_cast<std::ptrdiff_t>(row * stride);
    rows.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(points.samples));
    for (std::size_t s = points.samples; s < stride; ++s) EXPECT_EQ(begin[static_cast<std::ptrdiff_t>(s)], untouched);
  }
  return rows;
}

bool same_rows(const std::vector<std::vector<double>>& x, const std::vector<std::vector<double>>& y) {
  return std::ranges::equal(x, y, [](const auto& a, const auto& b) { return std::ranges::equal(a, b, same); });
}

constexpr std::size_t sample_counts[] = {0, 1, 7, 8, 9, 24, 25, 63, 64, 65, 100, 128, 152, 153};
constexpr Depth depths[] = {Depth::values, Depth::jacobian, Depth::hessian};

TEST(Evaluate, GenericTargetHasTheScalarsBits) {
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 200; ++trial) {
    const auto program = wild_program(random);
    ASSERT_FALSE(validate(program)) << validate(program)->path;
    const Evaluator evaluator(program, "generic");
    const auto points = random_points(program.inputs.size(), sample_counts[trial % std::size(sample_counts)], random);
    for (const auto depth : depths) {
      const auto rows = run(evaluator, depth, points);
      for (std::size_t s = 0; s < points.samples; ++s) {
        const auto values = expected(program, depth, points.sample(s));
        ASSERT_EQ(values.size(), rows.size());
        for (std::size_t row = 0; row < rows.size(); ++row) {
          ASSERT_TRUE(same(rows[row][s], values[row])) << "trial " << trial << ", row " << row << ", sample " << s;
        }
      }
    }
  }
}

TEST(Evaluate, VectorTargetsHaveTheSameBits) {
  const auto targets = vector_targets();
  std::mt19937_64 random(seed + 1);
  for (int trial = 0; trial < 300; ++trial) {
    const auto program = wild_program(random);
    const auto points = random_points(program.inputs.size(), sample_counts[trial % std::size(sample_counts)], random);
    for (std::size_t k = 1; k < targets.size(); ++k) {
      const Evaluator one(program, targets[k - 1]), other(program, targets[k]);
      for (const auto depth : depths) {
        ASSERT_TRUE(same_rows(run(one, depth, points), run(other, depth, points)))
            << targets[k - 1] << " and " << targets[k] << ", trial " << trial;
      }
    }
  }
}

// The bits themselves, so that a machine with a single vector target is held to those of the others.  They are those of
// glibc 2.36's libmvec and of libstdc++'s distributions.  Where a kernel is meant to change, the new hash is in the
// failure's message; it must be the same for each target.
TEST(Evaluate, VectorTargetsHaveTheKnownBits) {
  for (const auto target : vector_targets()) {
    std::mt19937_64 random(seed + 5);
    BitHash hash;
    for (int trial = 0; trial < 200; ++trial) {
      const auto program = wild_program(random);
      const Evaluator evaluator(program, target);
      const auto points = random_points(program.inputs.size(), sample_counts[trial % std::size(sample_counts)], random);
      for (const auto& row : run(evaluator, Depth::hessian, points)) hash.add(row);
    }
    EXPECT_EQ(hash.value(), 0x2e22d9d5c8394d3cU) << target;
  }
}

TEST(Evaluate, TargetsAgreeOnMechanics) {
  std::mt19937_64 random(seed + 2);
  const auto program = random_program(12, 2000, random);
  ASSERT_FALSE(validate(program));
  Points points = random_points(program.inputs.size(), 100, random);
  for (auto& column : points.columns) {
    for (auto& x : column) x = 0.5 + 0.2 * x;  // within [0.1, 0.9], where this program stays moderate
  }
  for (const auto target : evaluation_targets()) {
    const auto rows = run(Evaluator(program, target), Depth::values, points);
    for (std::size_t s = 0; s < points.samples; ++s) {
      const auto values = expected(program, Depth::values, points.sample(s));
      for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_NEAR(rows[row][s], values[row], 1e-11) << target;
    }
  }
}

TEST(Evaluate, BitsDependNeitherOnPlaceNorOnNumberOfSamples) {
  std::mt19937_64 random(seed + 3);
  for (const auto target : evaluation_targets()) {
    for (int trial = 0; trial < 40; ++trial) {
      const auto program = wild_program(random);
      const Evaluator evaluator(program, target);
      const auto points = random_points(program.inputs.size(), 200, random);
      const auto whole = run(evaluator, Depth::hessian, points);
      const auto from = random() % points.samples, samples = 1 + random() % (points.samples - from);
      Points part = points;
      part.samples = samples;
      for (std::size_t i = 0; i < part.columns.size(); ++i) {
        if (part.uniform[i]) continue;
        part.columns[i].assign(points.columns[i].begin() + static_cast<std::ptrdiff_t>(from),
                               points.columns[i].begin() + static_cast<std::ptrdiff_t>(from + samples));
      }
      const auto rows = run(evaluator, Depth::hessian, part);
      for (std::size_t row = 0; row < rows.size(); ++row) {
        for (std::size_t s = 0; s < samples; ++s) ASSERT_TRUE(same(rows[row][s], whole[row][from + s])) << target;
      }
    }
  }
}

TEST(Evaluate, DeeperRunsRepeatTheShallowerRows) {
  std::mt19937_64 random(seed + 4);
  for (int trial = 0; trial < 50; ++trial) {
    const auto program = wild_program(random);
    const Evaluator evaluator(program);
    EXPECT_EQ(evaluator.outputs(Depth::values), program.values.size());
    EXPECT_EQ(evaluator.outputs(Depth::hessian),
              program.values.size() + program.jacobian.size() + program.hessian.size());
    EXPECT_EQ(evaluator.operations(Depth::values), static_cast<std::size_t>(program.value_operations));
    EXPECT_EQ(evaluator.operations(Depth::jacobian), static_cast<std::size_t>(program.jacobian_operations));
    EXPECT_EQ(evaluator.operations(Depth::hessian), program.op.size());
    const auto points = random_points(program.inputs.size(), 70, random);
    auto deep = run(evaluator, Depth::hessian, points);
    for (const auto depth : {Depth::jacobian, Depth::values}) {
      deep.resize(evaluator.outputs(depth));
      EXPECT_TRUE(same_rows(deep, run(evaluator, depth, points)));
    }
  }
}

TEST(Evaluate, OnceGivesTheBitsOfARun) {
  std::mt19937_64 random(seed + 5);
  for (int trial = 0; trial < 100; ++trial) {
    const auto program = wild_program(random);
    const auto points = random_points(program.inputs.size(), 67, random);
    for (const auto depth : depths) {
      const auto rows = run(Evaluator(program), depth, points);
      for (const std::size_t s : {0, 13, 66}) {
        const auto once = evaluate_once(program, depth, points.sample(s));
        ASSERT_EQ(once.size(), rows.size());
        for (std::size_t row = 0; row < rows.size(); ++row) ASSERT_TRUE(same(once[row], rows[row][s]));
      }
    }
  }
}

TEST(Evaluate, RunsAProgramWithNothingInIt) {
  EXPECT_TRUE(evaluate_once(Program{}, Depth::hessian, {}).empty());
  Program number;
  number.numbers = {2.5};
  number.values = {0, 0};
  EXPECT_EQ(evaluate_once(number, Depth::values, {}), (std::vector{2.5, 2.5}));
}

// More values alive at once than blocks of 64 lanes are allowed memory for: sums of all inputs' pairs, kept to the end.
TEST(Evaluate, HugeProgramsRunInNarrowBlocks) {
  constexpr int alive = 200'000;
  Program program;
  program.inputs = {{InputKind::time, "", 0, 0}};
  program.numbers = {1};
  for (int i = 0; i < 2 * alive; ++i) {
    const bool up = i < alive;  // v[i+1] = v[i] + 1, then the sum of all, the last first
    program.op.push_back(Op::add);
    program.a.push_back(i == 0 ? 0 : i + 1);
    program.b.push_back(up ? 1 : 2 * alive - i + 1);
    program.c.push_back(0);
  }
  program.values = {2 * alive + 1};
  program.value_operations = program.jacobian_operations = 2 * alive;
  ASSERT_FALSE(validate(program)) << validate(program)->path;
  const Evaluator evaluator(program);
  Points points{70, {std::vector<double>(70)}, {0}};
  for (std::size_t s = 0; s < points.samples; ++s) points.columns[0][s] = static_cast<double>(s);
  const auto rows = run(evaluator, Depth::values, points);
  for (std::size_t s = 0; s < points.samples; ++s) {  // t + n, and t + k for every k from 1 to n: integers, so exact
    const double t = static_cast<double>(s), n = alive;
    EXPECT_EQ(rows[0][s], (t + n) + n * t + n * (n + 1) / 2);
  }
}

TEST(Evaluate, ThreadsShareAnEvaluator) {
  std::mt19937_64 random(seed + 6);
  const auto program = random_program(8, 500, random);
  const Evaluator evaluator(program);
  const auto points = random_points(program.inputs.size(), 300, random);
  const auto alone = run(evaluator, Depth::values, points);
  std::vector<std::vector<std::vector<double>>> results(4);
  {
    std::vector<std::jthread> threads;
    for (auto& result : results) {
      threads.emplace_back([&] {
        for (int i = 0; i < 20; ++i) result = run(evaluator, Depth::values, points);
      });
    }
  }
  for (const auto& result : results) EXPECT_TRUE(same_rows(result, alone));
}

TEST(Evaluate, RefusesAnUnknownTarget) {
  EXPECT_THROW(Evaluator(Program{}, "abacus"), std::runtime_error);
  EXPECT_EQ(evaluation_targets().back(), "generic");
}

}  // namespace
}  // namespace spacetime
