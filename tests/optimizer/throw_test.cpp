// The throws of the two papers, solved from the reference's starts and judged independently: every run must end at a
// feasible point with a vanishing gradient of the Lagrangian and positive curvature.  Which of the many minima it is
// depends on the path, so only the set is compared.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/optimizer/judge.h"
#include "tests/optimizer/reference.h"

namespace spacetime::optimizer {
namespace {

struct Case {
  std::string name, scene, starts;  // starts: prefix of the keys in solve_coefs.json
  judge::Throw problem;
  int most_iterations;
};
const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"P94R", "examples/throw_regularised.scene", "P94_start_", judge::p94r, 75},
      {"P94", "examples/throw_eliminated.scene", "P94_start_", judge::p94, 250},
      {"P92", "tests/golden/p92.scene", "P92_start_", judge::p92, 250},
  };
  return all;
}

struct Solved {
  Motion motion;
  judge::Judgement verdict;
};
Solved solve(const Case& c, int start) {
  const Problem problem = problem_of(file_text(c.scene));
  const auto coefficients = reference("solve_coefs.json");
  const Eigen::VectorXd x = vector_of(coefficients[c.starts + "S" + std::to_string(start)]);
  RunOptions options;
  options.start = motion_of(problem, {x.data(), static_cast<std::size_t>(x.size())});
  Solved solved{run(problem, options), {}};
  const auto reached = coefficients_of(solved.motion);
  solved.verdict =
      judge::judge(c.problem, Eigen::Map<const Eigen::VectorXd>(reached.data(), static_cast<Eigen::Index>(x.size())));
  std::printf("%-4s S%d  %3d iterations  objective %.12g  violation %.1e  KKT %.1e  least curvature %.3e  rank %d\n",
              c.name.c_str(), start, solved.motion.iterations, solved.verdict.objective, solved.verdict.violation,
              solved.verdict.kkt, solved.verdict.curvature, solved.verdict.rank);
  return solved;
}

class Throws : public ::testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(Throws, EndAtAMinimum) {
  const Case& c = cases()[static_cast<std::size_t>(std::get<0>(GetParam()))];
  const auto [motion, verdict] = solve(c, std::get<1>(GetParam()));
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.iterations, c.most_iterations);
  EXPECT_LE(verdict.violation, 1e-9);
  EXPECT_LE(verdict.kkt, 1e-6);
  EXPECT_GT(verdict.curvature, 0);
  // The motion says of itself what the judge says of it.
  EXPECT_NEAR(motion.objective, verdict.objective, 1e-9 * verdict.objective);
  EXPECT_NEAR(motion.violation, verdict.violation, 1e-12);
}
INSTANTIATE_TEST_SUITE_P(FromAllStarts, Throws, ::testing::Combine(::testing::Range(0, 3), ::testing::Range(0, 4)),
                         [](const auto& of) {
                           return cases()[static_cast<std::size_t>(std::get<0>(of.param))].name + "_S" +
                                  std::to_string(std::get<1>(of.param));
                         });

// minima_map of P94R in the reference: what 30 random sketches found.
TEST(Throw, EasyStartsOfP94RFindAKnownMinimum) {
  for (const int start : {0, 1}) {
    const auto [motion, verdict] = solve(cases()[0], start);
    double nearest = INFINITY;
    for (const double known : {10.930342378776, 11.8591, 12.8384, 14.2516, 15.5641, 17.4670}) {
      nearest = std::min(nearest, std::abs(verdict.objective - known));
    }
    EXPECT_LE(nearest, 1e-4) << verdict.objective;
  }
}

// The scene's own underhand sketch leads to the lowest minimum known.
TEST(Throw, UnderhandSketchFindsTheLowestMinimumKnown) {
  const Motion motion = run_scene(file_text("examples/throw_regularised.scene"));
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.objective, 10.930342378776, 1e-9);
  ASSERT_EQ(motion.terms.size(), 2U);
  EXPECT_NEAR(motion.terms[0].second, 4.247919772214, 1e-6);
}

// The reference's thirty random sketches: every one converges, the lowest minimum known is among the ends, and all
// together take no more iterations than an established interior-point solver with exact derivatives needs (1472).
TEST(Throw, ThirtySketchesOfP94RAllConverge) {
  const std::string scene = file_text("examples/throw_regularised.scene");
  const std::string head = scene.substr(0, scene.find("keyframe"));
  const auto runs = reference("p94r_results.json")["map"]["runs"];
  ASSERT_EQ(runs.size(), 30U);
  double lowest = INFINITY;
  int iterations = 0;
  for (const auto& sketch : runs) {
    std::string text = head + "keyframe 0: arm.q = 0\nkeyframe 2: arm.q = 0\n";
    for (const auto& [time, q] : sketch["keys"].items()) {
      text += "keyframe " + time + ": arm.q = (" + q[0].dump() + ", " + q[1].dump() + ", " + q[2].dump() + ")\n";
    }
    const Motion motion = run_scene(text);
    EXPECT_EQ(motion.status, Status::converged) << text << motion.message;
    lowest = std::min(lowest, motion.objective);
    iterations += motion.iterations;
  }
  std::printf("30 sketches: %d iterations, the lowest objective %.9g\n", iterations, lowest);
  EXPECT_NEAR(lowest, 10.930342378776, 1e-8);
  EXPECT_LE(iterations, 1472);
}

// From an optimum of the reference there is next to nothing left to do, and nothing better to go to.
TEST(Throw, StaysAtTheReferencesOptima) {
  const auto coefficients = reference("solve_coefs.json"), results = reference("solve_results.json");
  for (const Case& c : cases()) {
    if (c.name == "P94R") continue;
    const Problem problem = problem_of(file_text(c.scene));
    for (int start = 0; start < 4; ++start) {
      SCOPED_TRACE(c.name + " S" + std::to_string(start));
      const auto x = coefficients[c.name + "_S" + std::to_string(start)].get<std::vector<double>>();
      RunOptions options;
      options.start = motion_of(problem, x);
      const Motion before = [&] {
        RunOptions judged = options;
        judged.iterations = 0;
        return run(problem, judged);
      }();
      const Motion after = run(problem, options);
      EXPECT_EQ(after.status, Status::converged) << after.message;
      EXPECT_LE(after.iterations, 3);
      EXPECT_NEAR(after.objective, before.objective, 1e-8 * before.objective);
    }
  }
}

}  // namespace
}  // namespace spacetime::optimizer
