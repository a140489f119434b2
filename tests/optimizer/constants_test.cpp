// Constants, and the times of every kind of scope.
#include "common/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/diagnostic.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

Quantity at(double number) { return {number, {}, 0}; }

Scope interval(Scope::Kind kind, double from, double to) {
  Scope scope;
  scope.kind = kind;
  scope.from = at(from);
  scope.to = at(to);
  return scope;
}
Scope every(double from, double to, double step) {
  Scope scope = interval(Scope::Kind::every, from, to);
  scope.step = at(step);
  return scope;
}
Scope counted(double from, double to, int count) {
  Scope scope = interval(Scope::Kind::count, from, to);
  scope.count = count;
  return scope;
}

Problem of_two_seconds() {
  Problem problem;
  problem.start = 0;
  problem.end = 2;
  return problem;
}

std::vector<double> times(const Scope& scope, const std::vector<double>& knots = {0, 0.5, 1, 2}) {
  return scope_times(of_two_seconds(), {}, scope, knots, "constraint 1");
}

void expect_times(const Scope& scope, const std::vector<double>& expected) {
  const auto found = times(scope);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-14) << k;
  // The ends are what was asked for, to the last bit.
  EXPECT_EQ(found.front(), expected.front());
  EXPECT_EQ(found.back(), expected.back());
}

void expect_refused(const Scope& scope, const std::string& part) {
  try {
    times(scope);
    FAIL() << "expected a refusal that says: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("constraint 1"), std::string::npos) << error.what();
  }
}

TEST(ScopeTimes, Every) {
  expect_times(every(0, 1, 0.25), {0, 0.25, 0.5, 0.75, 1});
  expect_times(every(0, 1, 0.3), {0, 0.3, 0.6, 0.9, 1});
  expect_times(every(0.5, 1.6, 0.1), {0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6});
}

TEST(ScopeTimes, EveryWithAStepAsLargeAsTheIntervalOrLarger) {
  expect_times(every(0, 1, 1), {0, 1});
  expect_times(every(0, 1, 5), {0, 1});
  expect_times(every(0, 1, std::numeric_limits<double>::max()), {0, 1});
  expect_times(every(1, 1, 0.1), {1});
}

TEST(ScopeTimes, EveryTakesAnAlmostWholeLastStepForWhole) {
  const double h = 0.1;
  for (const double excess : {-0.9e-9, -1e-12, 1e-12, 0.9e-9}) {
    const double to = 10 * h + excess * h;
    const auto found = times(every(0, to, h));
    ASSERT_EQ(found.size(), 11U) << excess;
    EXPECT_EQ(found.back(), to);
  }
  EXPECT_EQ(times(every(0, 10 * h + 1e-8 * h, h)).size(), 12U);
  EXPECT_EQ(times(every(0, 10 * h - 1e-8 * h, h)).size(), 11U);  // the last step a little short
  EXPECT_EQ(times(every(0, 10 * h - 1e-8 * h, h))[9], 9 * h);
}

TEST(ScopeTimes, EveryRefusesStepsThatDoNotLeadOn) {
  expect_refused(every(0, 1, 0), "positive");
  expect_refused(every(0, 1, -0.1), "positive");
  expect_refused(every(0, 1, std::numeric_limits<double>::quiet_NaN()), "not a finite number");
  expect_refused(every(0, 1, std::numeric_limits<double>::infinity()), "not a finite number");
  expect_refused(every(0, 1, 1e-300), "too many");
}

TEST(ScopeTimes, Count) {
  expect_times(counted(0, 1.1, 12), {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1});
  expect_times(counted(0.3, 0.7, 2), {0.3, 0.7});
  expect_times(counted(0.3, 0.3, 1), {0.3});
  expect_refused(counted(0, 1, 0), "at least 1");
  expect_refused(counted(0, 1, -3), "at least 1");
}

TEST(ScopeTimes, KnotsAreTheEndsAndWhatLiesBetween) {
  expect_times(interval(Scope::Kind::knots, 0.25, 1.5), {0.25, 0.5, 1, 1.5});
  expect_times(interval(Scope::Kind::knots, 0.5, 1), {0.5, 1});  // ends that are knots count once
  expect_times(interval(Scope::Kind::knots, 0.6, 0.7), {0.6, 0.7});
  expect_times(interval(Scope::Kind::knots, 0.5, 0.5), {0.5});
}

TEST(ScopeTimes, WholeTakesEveryKnot) {
  Scope whole;
  whole.kind = Scope::Kind::whole;
  expect_times(whole, {0, 0.5, 1, 2});
}

TEST(ScopeTimes, ListedTimesKeepTheirOrder) {
  Scope scope;
  scope.kind = Scope::Kind::times;
  scope.times = {at(1.5), at(0), at(2), at(0)};
  EXPECT_EQ(times(scope), (std::vector<double>{1.5, 0, 2, 0}));
}

TEST(ScopeTimes, OnceHasNoTime) {
  Scope scope;
  scope.kind = Scope::Kind::once;
  const auto found = times(scope);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(std::isnan(found[0]));
}

TEST(ScopeTimes, RefuseWhatLiesOutsideTheTime) {
  Scope listed;
  listed.kind = Scope::Kind::times;
  listed.times = {at(0.5), at(2.001)};
  expect_refused(listed, "outside");
  expect_refused(every(-0.1, 1, 0.1), "outside");
  expect_refused(counted(1, 2.5, 3), "outside");
  expect_refused(interval(Scope::Kind::knots, 1, 3), "outside");
  expect_refused(every(1, 0, 0.1), "backwards");
  expect_refused(counted(1, 0, 3), "backwards");
  expect_refused(interval(Scope::Kind::knots, 1, 0), "backwards");
}

TEST(Constants, FollowOneAnother) {
  Problem problem = problem_of("time [0, 2]\nconstant a = 2\nconstant b = a^2 + 1\nconstant c = 1/(a - 1) + b\n");
  auto values = evaluate_constants(problem);
  EXPECT_EQ(values.at("a"), 2);
  EXPECT_EQ(values.at("b"), 5);
  EXPECT_EQ(values.at("c"), 6);
  problem.constants[0].value = at(3);
  values = evaluate_constants(problem);
  EXPECT_EQ(values.at("b"), 10);
  EXPECT_EQ(values.at("c"), 10.5);
  problem.constants[0].value = at(1);
  try {
    evaluate_constants(problem);
    FAIL() << "1/0 is a constant";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("constant c"), std::string::npos) << error.what();
  }
}

TEST(Constants, MoveScopes) {
  Problem problem = problem_of(
      "time [0, 2]\nconstant end = 1\ntrajectory bspline spans 4\ndof x\n"
      "constrain x = 0 over [0, end] every end/4\n");
  const Scope& scope = problem.constraints.at(0).scope;
  EXPECT_EQ(scope_times(problem, evaluate_constants(problem), scope, {}, "it").back(), 1);
  problem.constants[0].value = at(1.5);
  const auto moved = scope_times(problem, evaluate_constants(problem), scope, {}, "it");
  EXPECT_EQ(moved, (std::vector<double>{0, 0.375, 0.75, 1.125, 1.5}));
}

}  // namespace
}  // namespace spacetime::optimizer
