// Limits, conditions and windows against values found independently: tests/reference/README.md and extras.json.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/optimizer/reference.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

// Exactly 4/(9 l) while l lies between 0 and 1/6 [Bryson and Ho 1975, §3.11].
TEST(LimitsReference, BrysonDenhamForThreeCeilings) {
  for (const double ceiling : {1.0 / 9, 1.0 / 8, 1.0 / 6.5}) {
    const std::string head = "time [0, 1]\nconstant l = " + std::to_string(ceiling) + "\ntrajectory bspline spans 64\n";
    const std::string rest =
        "constrain (x, x') = (0, 1) at 0\nconstrain (x, x') = (0, -1) at 1\nminimize 0.5*integral(x''^2)\nsolve\n";
    for (const Motion& motion : {run_scene(head + "dof x\nconstrain low: x <= l over [0, 1]\n" + rest),
                                 run_scene(head + "dof x in [-1, l]\n" + rest)}) {
      EXPECT_EQ(motion.status, Status::converged) << motion.message;
      EXPECT_NEAR(motion.objective, 4 / (9 * ceiling), 1e-4) << ceiling;
    }
  }
}

// The straight line where the cat looks ahead over all time; longer ways with shorter windows.
TEST(LimitsReference, CatAndMouse) {
  const auto extras = reference("extras.json");
  const std::string scene = file_text("examples/cat_and_mouse.scene");
  const Motion chase = run_scene(scene);
  EXPECT_EQ(chase.status, Status::converged) << chase.message;
  EXPECT_NEAR(chase.objective, extras["cat_win16_8"]["J"].get<double>(), 1e-6);

  const Motion line = run_scene(scene.substr(0, scene.find("set goal")) + "set goal = 6\nsolve\n");
  EXPECT_NEAR(line.objective, extras["cat_full"]["J_analytic"].get<double>(), 1e-9);
  const auto &x = line.dofs[0].coefficients, &y = line.dofs[1].coefficients;
  const double slope = (y.back() + 1) / (x.back() + 1);
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(y[k] + 1, slope * (x[k] + 1), 1e-9) << k;
}

TEST(LimitsReference, AnAcrobatFlipsWithoutPullingOnTheGround) {
  const Motion motion = run_scene(file_text("examples/acrobat_flip.scene"));
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.violation, 1e-8);
  EXPECT_LT(motion.objective, 41053.98874);  // the reference's, which holds still where this one may crouch
}

TEST(LimitsReference, AnAcrobatJumpsWithoutPullingOnTheGround) {
  const Motion motion = run_scene(file_text("examples/acrobat_jump.scene"));
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_LE(motion.violation, 1e-8);
  EXPECT_LT(motion.objective, 34463.84096);  // the reference's, which pulls with 965 N and sinks 0.56 m into the ground
}

// A floor that ends at x = 1: from ten shaken starts the same motion, over the edge and down.
TEST(LimitsReference, AFloorThatEnds) {
  for (int seed = 1; seed <= 10; ++seed) {
    const Motion motion = run_scene(
        "time [0, 2]\ntrajectory bspline spans 32\ndof x\ndof y\n"
        "constrain from: (x, y, x', y') = (0, 0.5, 0, 0) at 0\nconstrain to: (x, y, x', y') = (2, -1, 0, 0) at 2\n"
        "constrain floor: y >= 0 over [0, 2] when x < 1\nminimize integral(x''^2 + y''^2)\n"
        "shake amplitude 1 seed " +
        std::to_string(seed) + "\nsolve\n");
    EXPECT_EQ(motion.status, Status::converged) << "seed " << seed << ": " << motion.message;
    EXPECT_NEAR(motion.objective, 10.875, 1e-6) << "seed " << seed;
  }
}

}  // namespace
}  // namespace spacetime::optimizer
