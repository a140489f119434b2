// What people read: it must name what matters.
#include "optimizer/summary.h"

#include <gtest/gtest.h>

#include "common/diagnostic.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string scene = R"(time [0, 2]
constant release = 1.5
trajectory bspline spans 8
dof x
let height = 2*x
constrain ends: x = 0  at 0
constrain far:  x = 3  at 2
constrain near: x = 1  at 2  weight 4
minimize effort: integral(x''^2)
minimize shape:  integral((x' - 1.5)^2)
)";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Summary, AsksTheQuestion) {
  const std::string text = question(problem_of(scene));
  for (const char* part : {"11 unknowns: x, 2 s", "effort, shape", "ends, far, near (1 soft)"}) {
    EXPECT_TRUE(contains(text, part)) << part << " in\n" << text;
  }
  EXPECT_TRUE(contains(question(problem_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\n")), "nothing"));
}

TEST(Summary, TellsTheAnswer) {
  const Problem problem = problem_of(scene);
  const Motion motion = run(problem, {});
  const std::string text = summary(problem, motion, {parse_show(problem, "height@release")});
  for (const char* part :
       {"converged", "iterations 1", "effort", "shape", "near 8", "violation", "height at 1.5 s: 4.5", "evaluating"}) {
    EXPECT_TRUE(contains(text, part)) << part << " in\n" << text;
  }
}

TEST(Summary, NamesTheWorstFirst) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain small: x = 1e-3 at 0\nconstrain large: x = 5 at "
      "1\niterate 0\n");
  const std::string text = summary(problem, run(problem, {}), {});
  ASSERT_TRUE(contains(text, "large                5          5 at 1 s")) << text;
  ASSERT_TRUE(contains(text, "small                4      0.001 at 0 s")) << text;
  EXPECT_LT(text.find("large     "), text.find("small     "));
}

TEST(Summary, OneLineAnIteration) {
  const std::string text = line({7, 12.5, {}, 1e-3, 2e-4, 0.6, 0.01, 0.25});
  for (const char* part : {"7", "12.5", "1.00e-03", "2.00e-04", "6.00e-01"}) EXPECT_TRUE(contains(text, part)) << text;
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Show, KnowsPlotsTimesAndConstants) {
  const Problem problem = problem_of(scene);
  EXPECT_EQ(parse_show(problem, "height@release").time, "release");
  EXPECT_EQ(parse_show(problem, "height@0.25").plot, "height");
  for (const char* wrong : {"height", "heights@1", "height@2.5", "height@-1", "height@1s", "height@", "@1", ""}) {
    EXPECT_THROW(parse_show(problem, wrong), InputError) << wrong;
  }
}

}  // namespace
}  // namespace spacetime::optimizer
