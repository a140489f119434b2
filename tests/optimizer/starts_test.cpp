// Many starts: the best is kept, the distinct minima are listed, and threads do not show.
#include "optimizer/starts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

// Two valleys, x near 1 and the deeper one near -1; the start lies in the shallow one.
const std::string valleys = R"(time [0, 1]
trajectory bspline spans 8
dof x = 0.2
minimize integral(x'^2 + 20*(x^2 - 1)^2 + x)
)";

TEST(Starts, KeepTheBestAndListTheMinima) {
  const Motion one = run_scene(valleys + "solve\n");
  EXPECT_GT(one.objective, 0.9);
  EXPECT_TRUE(one.minima.empty());
  const Motion many = run_scene(valleys + "solve starts 20\n");
  EXPECT_EQ(many.status, Status::converged) << many.message;
  EXPECT_LT(many.objective, -0.9);
  ASSERT_EQ(many.minima.size(), 2U) << many.message;
  EXPECT_EQ(many.minima[0].objective, many.objective);
  EXPECT_NEAR(many.minima[1].objective, one.objective, 1e-9);
  EXPECT_EQ(many.minima[0].dofs, many.dofs);
  EXPECT_EQ(many.minima[1].starts.front(), 0);  // the motion as it stood is the first start
  EXPECT_EQ(many.minima[0].starts.size() + many.minima[1].starts.size(), 20U);
  EXPECT_NE(many.message.find("Of 20 starts 20 converged, to 2 distinct minima."), std::string::npos) << many.message;
  EXPECT_GT(many.iterations, 40);
}

TEST(Starts, ThreadsDoNotShow) {
  const Problem problem = problem_of(file_text("examples/throw_regularised.scene"));
  Problem many = problem;
  Solve solve;
  solve.starts = 5;
  many.actions = {{solve, {}}};
  RunOptions options;
  options.threads = 1;
  Motion one = run(many, options);
  options.threads = 3;
  Motion three = run(many, options);
  one.seconds = three.seconds = {};
  EXPECT_EQ(one, three);
  EXPECT_EQ(one.status, Status::converged) << one.message;
}

TEST(Starts, StayInTheWindow) {
  const std::string scene =
      "time [0, 1]\ntrajectory bspline spans 16\ndof x = 0.8\ndof y\n"
      "minimize integral(x'^2 + 20*(x^2 - 1)^2 + x + (y - x)^2)\n";
  const Motion before = run_scene(scene + "iterate 0\n");
  const Motion after = run_scene(scene + "window [0.25, 0.75] of x\nsolve starts 4\n");
  EXPECT_EQ(after.dofs[1], before.dofs[1]);
  EXPECT_EQ(after.dofs[0].coefficients.front(), 0.8);
  EXPECT_NE(after.dofs[0], before.dofs[0]);
}

// Each start that has ended is told of in its turn, with the best so far; so the record does not depend on the threads.
TEST(Starts, AreToldOfOneByOne) {
  RunOptions options;
  options.record = true;
  std::vector<IterationRecord> lines;
  options.progress = [&](const IterationRecord& line) { lines.push_back(line); };
  std::vector<std::vector<IterationRecord>> records;
  for (const int threads : {1, 3}) {
    options.threads = threads;
    lines.clear();
    Motion motion = run_scene(valleys + "solve starts 20\n", options);
    EXPECT_EQ(lines, motion.record);
    ASSERT_EQ(lines.size(), 21U);  // the first is the start
    for (std::size_t k = 2; k < lines.size(); ++k) {
      EXPECT_GT(lines[k].iteration, lines[k - 1].iteration);
      EXPECT_LE(lines[k].objective, lines[k - 1].objective);
    }
    EXPECT_EQ(lines.back().objective, motion.objective);
    EXPECT_EQ(lines.back().iteration, motion.iterations);
    for (IterationRecord& line : motion.record) line.seconds = 0;
    records.push_back(motion.record);
  }
  EXPECT_EQ(records[0], records[1]);
}

// What was reached when the run is interrupted is kept, and is told as interrupted even where it has converged.
TEST(Starts, CanBeInterrupted) {
  RunOptions options;
  int told = 0;
  options.progress = [&](const IterationRecord&) { ++told; };
  for (const int most : {1, 4}) {
    told = 0;
    options.interrupted = [&] { return told >= most; };  // the first line is the start
    const Motion motion = run_scene(valleys + "solve starts 50\n", options);
    EXPECT_EQ(motion.status, Status::stopped) << motion.message;
    EXPECT_TRUE(motion.message.starts_with("Interrupted")) << motion.message;
    if (most == 1) {
      EXPECT_NE(motion.message.find("before the first of 50 starts"), std::string::npos) << motion.message;
      EXPECT_EQ(motion.iterations, 0);
      EXPECT_TRUE(motion.minima.empty());
    } else {
      std::size_t converged = 0;
      for (const Minimum& minimum : motion.minima) converged += minimum.starts.size();
      EXPECT_GE(converged, 3U) << motion.message;
      const auto at = motion.message.find("of 50 starts ");
      ASSERT_NE(at, std::string::npos) << motion.message;
      EXPECT_GE(std::stoi(motion.message.substr(at + 13)), 3) << motion.message;
      EXPECT_NE(motion.message.find("It has converged."), std::string::npos) << motion.message;
      ASSERT_FALSE(motion.minima.empty());
      EXPECT_EQ(motion.minima[0].objective, motion.objective);
    }
  }
}

TEST(Starts, AreNewtons) { EXPECT_THROW(run_scene(valleys + "solve method bfgs starts 2\n"), InputError); }

}  // namespace
}  // namespace spacetime::optimizer
