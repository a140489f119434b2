#include "optimizer/sketch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

TEST(ThroughKeys, HitsTheKeysAndIsConstantOutside) {
  const std::vector<double> times{0.1, 0.4, 0.5, 1.7}, values{2, -1, 3, 3.5};
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_DOUBLE_EQ(through_keys(times, values, times[k]), values[k]);
  EXPECT_EQ(through_keys(times, values, -5), 2);
  EXPECT_EQ(through_keys(times, values, 0), 2);
  EXPECT_EQ(through_keys(times, values, 9), 3.5);
  EXPECT_EQ(through_keys(std::vector{1.0}, std::vector{7.0}, 0.3), 7);
}

TEST(ThroughKeys, NeverOvershoots) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> step(0.01, 2), value(-10, 10);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> times{0}, values{value(random)};
    for (int k = 0; k < 6; ++k) {
      times.push_back(times.back() + step(random));
      values.push_back(k % 3 == 2 ? values.back() : value(random));  // some keys repeat a value
    }
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      const double low = std::min(values[k], values[k + 1]), high = std::max(values[k], values[k + 1]);
      double before = values[k];
      for (int i = 1; i <= 50; ++i) {
        const double t = times[k] + (times[k + 1] - times[k]) * i / 50, now = through_keys(times, values, t);
        EXPECT_GE(now, low - 1e-12) << "seed 21, round " << round << ", t " << t;
        EXPECT_LE(now, high + 1e-12) << "seed 21, round " << round << ", t " << t;
        EXPECT_GE((now - before) * (values[k + 1] - values[k]), -1e-10) << "not monotone, round " << round;
        before = now;
      }
    }
  }
}

TEST(ThroughKeys, HasNoCorners) {
  const std::vector<double> times{0, 0.3, 1, 1.2, 2}, values{0, 1, 1.5, 4, 3};
  const double h = 1e-6;
  for (const double t : times) {
    const double left = (through_keys(times, values, t) - through_keys(times, values, t - h)) / h;
    const double right = (through_keys(times, values, t + h) - through_keys(times, values, t)) / h;
    EXPECT_NEAR(left, right, 1e-3) << t;
  }
}

TEST(ThroughKeys, GoesOnWhereKeysRise) {
  // A key in the middle of a rise must not stop the motion.
  const std::vector<double> times{0, 1, 2}, values{0, 1, 2};
  const double h = 1e-6;
  EXPECT_GT((through_keys(times, values, 1 + h) - through_keys(times, values, 1 - h)) / (2 * h), 0.5);
}

const char* const two = R"(time [0, 2]
constant c = 0.5
trajectory bspline spans 16
dof x = 3
dof y
)";

std::vector<double> sketched(const Problem& problem) { return sketch(problem, evaluate_constants(problem)); }

TEST(Sketch, KeyedAndUnkeyed) {
  const Problem problem = problem_of(std::string(two) + "keyframe 0: y = 1\nkeyframe c: y = 2\nkeyframe 2: y = -1\n");
  const auto x = sketched(problem);
  ASSERT_EQ(x.size(), 38U);
  for (int k = 0; k < 19; ++k) EXPECT_EQ(x[k], 3);
  const std::span<const double> y(x.data() + 19, 19);
  const Basis& basis = problem.dofs[1].basis;
  EXPECT_NEAR(value(basis, y, 0), 1, 1e-12);
  EXPECT_NEAR(value(basis, y, 2), -1, 1e-12);
  EXPECT_NEAR(value(basis, y, 0.5), 2, 0.02);
  const std::vector<double> times{0, 0.5, 2}, values{1, 2, -1};
  for (double t = 0; t <= 2; t += 0.01) EXPECT_NEAR(value(basis, y, t), through_keys(times, values, t), 0.02) << t;
}

TEST(Sketch, KeysFollowConstants) {
  Problem problem = problem_of(std::string(two) + "keyframe c: y = c\n");
  EXPECT_NEAR(sketched(problem)[19], 0.5, 1e-14);
  problem.constants[0].value.number = 1.5;
  EXPECT_NEAR(sketched(problem)[19], 1.5, 1e-14);
  problem.constants[0].value.number = 2.5;
  EXPECT_THROW(sketched(problem), InputError);
}

TEST(Sketch, RefusesTwoKeysAtOneTime) {
  Problem problem = problem_of(std::string(two) + "keyframe 1: y = 1\nkeyframe 2*c + 1: y = 2\n");
  EXPECT_EQ(sketched(problem).size(), 38U);
  problem.constants[0].value.number = 0;
  EXPECT_THROW(sketched(problem), InputError);
}

TEST(SketchFrom, AMotionOnTheSameBasisIsCopied) {
  const Problem problem = problem_of(two);
  std::vector<double> x(38);
  for (int k = 0; k < 38; ++k) x[k] = std::sin(k);
  EXPECT_EQ(sketch_from(problem, evaluate_constants(problem), motion_of(problem, x)), x);
}

TEST(SketchFrom, ACoarserCurveIsTheSameOnAFinerBasis) {
  const Problem coarse = problem_of(with_spans(two, 4)), fine = problem_of(two);
  std::vector<double> x(14);
  for (int k = 0; k < 14; ++k) x[k] = std::sin(1.7 * k);
  const Motion motion = motion_of(coarse, x);
  const auto found = sketch_from(fine, evaluate_constants(fine), motion);
  const std::span<const double> y(found.data() + 19, 19);
  for (double t = 0; t <= 2; t += 0.01) {
    const double expected = value(coarse.dofs[1].basis, motion.dofs[1].coefficients, t);
    EXPECT_NEAR(value(fine.dofs[1].basis, y, t), expected, 1e-12) << t;
  }
}

TEST(SketchFrom, GoesByName) {
  const Problem problem = problem_of(two);
  Motion motion = motion_of(problem, std::vector<double>(38, 7.0));
  motion.dofs.erase(motion.dofs.begin());  // of x the motion knows nothing
  motion.dofs[0].coefficients[3] = 8;
  motion.dofs.push_back({"stranger", problem.dofs[0].basis, std::vector<double>(19, 1.0)});
  const auto x = sketch_from(problem, evaluate_constants(problem), motion);
  for (int k = 0; k < 19; ++k) EXPECT_EQ(x[k], 3);
  EXPECT_EQ(x[19], 7);
  EXPECT_EQ(x[19 + 3], 8);
}

TEST(SketchFrom, AShorterMotionGoesOnAsItEnds) {
  const Problem longer = problem_of(two);
  const Problem shorter = problem_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\ndof y\n");
  std::vector<double> x(14, 1.0);
  for (int k = 0; k < 7; ++k) x[k] = k / 6.0;
  const auto found = sketch_from(longer, evaluate_constants(longer), motion_of(shorter, x));
  EXPECT_NEAR(value(longer.dofs[0].basis, {found.data(), 19}, 2), 1, 1e-9);
  EXPECT_NEAR(value(longer.dofs[0].basis, {found.data(), 19}, 1.6), 1, 1e-2);
}

TEST(SketchFrom, RefusesAMotionThatDoesNotFitItself) {
  const Problem problem = problem_of(two);
  Motion motion = motion_of(problem, std::vector<double>(38, 0.0));
  motion.dofs[1].coefficients.pop_back();
  EXPECT_THROW(sketch_from(problem, evaluate_constants(problem), motion), InputError);
}

}  // namespace
}  // namespace spacetime::optimizer
