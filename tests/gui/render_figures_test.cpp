// Figures against kinematics written out by hand, and against `sample`.
#include "gui/render/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "common/sample.h"
#include "gui/render/compose.h"
#include "symbolic/compile.h"

namespace spacetime::gui {
namespace {

// Knots and coefficients that make q(t) = from + rate t exactly: coefficients on the Greville abscissae.
Trajectory line(const std::string& name, double from, double rate) {
  Trajectory dof{name, uniform_basis(0, 2, 5), {}};
  for (const double t : greville(dof.basis)) dof.coefficients.push_back(from + rate * t);
  return dof;
}

Problem problem_of(const std::string& text) { return symbolic::compile(text).problem.value(); }

const std::string pendulum = R"(time [0, 2]
trajectory bspline spans 5
constant reach = 0.5
creature arm {
  link upper { revolute q1; a reach; mass 1; rod }
  link fore  { revolute q2; a 0.25; mass 1; rod; capsule 0.03 }
  point hand on fore (0, 0.1, 0)
}
creature crate { link body { prismatic X axis (0, 1, 0); mass 1; box (0.2, 0.4, 0.6) } }
let shade = (arm.hand.x, 0)
)";

Motion swing() {
  Motion motion;
  motion.start = 0, motion.end = 2;
  motion.dofs = {line("arm.q1", 0.2, 0.7), line("arm.q2", -1, 1.5), line("crate.X", 1, -0.5)};
  motion.constants = {{"reach", 0.5}};
  return motion;
}

void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6F) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

glm::vec3 other_end(const Solid& solid) { return glm::vec3(solid.pose * glm::vec4(solid.extent, 1)); }

TEST(Figures, StandWhereTheirJointsPutThem) {
  const Figures figures(problem_of(pendulum));
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures.name(1), "arm.fore");
  for (const double t : {0.0, 0.6, 2.0}) {
    const double a = 0.2 + 0.7 * t, b = a - 1 + 1.5 * t;
    const glm::vec3 elbow{0.5 * std::cos(a), 0.5 * std::sin(a), 0};
    const glm::vec3 hand = elbow + glm::vec3{0.25 * std::cos(b), 0.25 * std::sin(b), 0};
    const auto solids = figures.solids(swing(), t, Theme::light);
    ASSERT_EQ(solids.size(), 3U);
    expect_near(glm::vec3(solids[0].pose[3]), elbow);
    expect_near(other_end(solids[0]), {0, 0, 0});
    expect_near(glm::vec3(solids[1].pose[3]), hand);
    expect_near(other_end(solids[1]), elbow);
    EXPECT_FLOAT_EQ(solids[1].radius, 0.03F);
    EXPECT_EQ(solids[2].shape, Solid::Shape::box);
    expect_near(glm::vec3(solids[2].pose[3]), {0, 1 - 0.5 * t, 0});
    expect_near(solids[2].extent, {0.2F, 0.4F, 0.6F});
    EXPECT_EQ(solids[0].colour, figures.colour(0, Theme::light));
    EXPECT_NE(solids[0].colour, solids[2].colour);
  }
}

TEST(Figures, PosesAreThoseOfSample) {
  const Problem problem = problem_of(pendulum);
  const Motion motion = swing();
  const auto times = even_times(0, 2, 7);
  const auto poses = Figures(problem).poses(motion, times);
  const Samples samples = sample(problem, motion, {}, times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    for (std::size_t p = 0; p < problem.bodies.size(); ++p) {
      const auto& row = samples.poses.at(problem.bodies[p].name)[i];
      for (int k = 0; k < 12; ++k) EXPECT_EQ(poses[i][p][k % 4][k / 4], static_cast<float>(row[k]));
      EXPECT_EQ(poses[i][p][3][3], 1);
    }
  }
}

TEST(Figures, SizesFollowConstants) {
  Motion motion = swing();
  motion.constants = {{"reach", 1.5}};
  const auto solids = Figures(problem_of(pendulum)).solids(motion, 0, Theme::light);
  EXPECT_FLOAT_EQ(glm::length(glm::vec3(solids[0].pose[3])), 1.5F);
  expect_near(other_end(solids[0]), {0, 0, 0});
}

TEST(Figures, AMotionThatCarriesItsBodiesIsDrawnByItself) {
  const Problem problem = problem_of(pendulum);
  Motion motion = swing();
  motion.bodies = problem.bodies;
  motion.programs = problem.programs;
  const auto alone = Figures(motion).solids(motion, 0.7, Theme::dark);
  const auto with = Figures(problem).solids(motion, 0.7, Theme::dark);
  ASSERT_EQ(alone.size(), with.size());
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_EQ(alone[i].pose, with[i].pose);
}

TEST(Figures, WaysOfBodiesCreaturesAndNamedPoints) {
  const Figures figures(problem_of(pendulum));
  const std::vector<double> times{0, 0.6};
  const double a = 0.2 + 0.7 * 0.6, b = a - 1 + 1.5 * 0.6;
  const glm::vec3 wrist{0.5 * std::cos(a) + 0.25 * std::cos(b), 0.5 * std::sin(a) + 0.25 * std::sin(b), 0};
  const glm::vec3 hand = wrist + glm::vec3{-0.1 * std::sin(b), 0.1 * std::cos(b), 0};
  expect_near(figures.way(swing(), "arm.fore", times)[1], wrist);
  expect_near(figures.way(swing(), "arm", times)[1], wrist);
  expect_near(figures.way(swing(), "arm.hand", times)[1], hand);
  expect_near(figures.way(swing(), "shade", times)[1], {hand.x, 0, 0});
  try {
    figures.way(swing(), "nose", times);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("arm.hand"), std::string::npos) << error.what();
  }
  // A motion alone knows the point where it has sampled it.
  Motion motion = swing();
  motion.samples = Samples{{0, 1, 2}, {{"nose", {{0, 0}, {1, 2}, {4, 4}}}}, {}};
  expect_near(Figures(motion).way(motion, "nose", std::vector<double>{1.5})[0], {2.5F, 3, 0});
}

TEST(Figures, BoundsHoldTheWholeMotion) {
  const Figures figures(problem_of(pendulum));
  const Box box = figures.bounds(swing());
  for (const double t : even_times(0, 2, 50)) {
    for (const Solid& solid : figures.solids(swing(), t, Theme::light)) {
      const Box part = bounds(solid);
      EXPECT_TRUE(glm::all(glm::greaterThan(part.low, box.low - 1e-3F)));
      EXPECT_TRUE(glm::all(glm::lessThan(part.high, box.high + 1e-3F)));
    }
  }
  EXPECT_NEAR(box.high.y, 1.2F, 1e-5);  // the crate at the start, 1 m up and 0.4 m high
  EXPECT_NEAR(box.low.z, -0.3F, 1e-5);
}

TEST(Figures, GhostsAreLayersThatGrowPalerBackInTime) {
  const Figures figures(problem_of(pendulum));
  const auto ghosts = figures.ghosts(swing(), even_times(0, 2, 4), Theme::light, 0.2F);
  ASSERT_EQ(ghosts.size(), 12U);
  EXPECT_EQ(ghosts.front().layer, 1);
  EXPECT_EQ(ghosts.back().layer, 4);
  EXPECT_FLOAT_EQ(ghosts.front().opacity, 0.2F);
  EXPECT_FLOAT_EQ(ghosts.back().opacity, 1);
}

TEST(Figures, CoordinatesAreBeadsAndOthersOnlyWhereThereIsNothingElse) {
  const auto parts = [](const std::string& dofs) {
    std::string scene = "time [0, 2]\ntrajectory bspline spans 5\n";
    for (std::size_t at = 0; at < dofs.size();) {
      const auto end = std::min(dofs.find(' ', at), dofs.size());
      scene += "dof " + dofs.substr(at, end - at) + "\n";
      at = end + 1;
    }
    const Figures figures(problem_of(scene));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < figures.size(); ++i) names.push_back(figures.name(static_cast<int>(i)));
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(parts("x y"), (Names{"x,y"}));
  EXPECT_EQ(parts("X Y Z height"), (Names{"X,Y,Z"}));
  EXPECT_EQ(parts("catX mouseX catY mouseY"), (Names{"catX,catY", "mouseX,mouseY"}));
  EXPECT_EQ(parts("x1 y1 x2 y2"), (Names{"x1,y1", "x2,y2"}));
  EXPECT_EQ(parts("height angle"), (Names{"height", "angle"}));

  Motion motion;
  motion.start = 0, motion.end = 2;
  motion.dofs = {line("y", 1, 2), line("x", 3, -1)};
  expect_near(Figures(motion).way(motion, "y,x", std::vector<double>{0.5})[0], {2.5F, 2, 0});
}

TEST(Figures, TheGroundIsBeneathWhatMoves) {
  EXPECT_EQ(ground_height({{0, 0.5F, 0}, {1, 2, 1}}), 0);
  EXPECT_EQ(ground_height({{0, -0.05F, 0}, {1, 2, 1}}), 0);  // the sole of a foot
  EXPECT_EQ(ground_height({{0, -1.1F, 0}, {1, 2, 1}}), -1.1F);
  EXPECT_TRUE(planar({{0, 0, -0.05F}, {1, 2, 0.05F}}));
  EXPECT_FALSE(planar({{0, 0, -1}, {1, 2, 1}}));
}

TEST(Compose, AMomentHasItsTrailSoFarAndAStripAllOfIt) {
  const Figures figures(problem_of(pendulum));
  const Look look{Theme::light, {"arm.hand"}};
  const Picture now = moment(figures, swing(), 0.6, look);
  ASSERT_EQ(now.lines.size(), 1U);
  expect_near(now.lines[0].points.back(), figures.way(swing(), "arm.hand", std::vector<double>{0.6})[0]);
  const Picture all = strip(figures, swing(), 5, look);
  EXPECT_EQ(all.solids.size(), 15U);
  EXPECT_EQ(all.solids.back().layer, 0);
  expect_near(all.lines[0].points.back(), figures.way(swing(), "arm.hand", std::vector<double>{2.0})[0]);
  const glm::vec2 size{640, 360};
  const Camera camera = overview(figures.bounds(swing()), View::front, size);
  for (const Solid& solid : all.solids) {  // all of it is in the picture
    const auto at = project(camera, size, glm::vec3(solid.pose[3]));
    ASSERT_TRUE(at);
    EXPECT_TRUE(at->x > 0 && at->x < 640 && at->y > 0 && at->y < 360);
  }
}

}  // namespace
}  // namespace spacetime::gui
