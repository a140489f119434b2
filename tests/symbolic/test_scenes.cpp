// The examples and reference scenes, against values computed independently (tests/reference).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <variant>

#include "protocol/problem_json.h"
#include "tests/symbolic/scene_texts.h"

namespace spacetime::symbolic {
namespace {

using nlohmann::json;

json reference(const std::string& name) { return json::parse(file_text("tests/reference/" + name)); }

State state_of(const Problem& problem, const json& q, const json& v, const json& a) {
  State out;
  for (std::size_t i = 0; i < problem.dofs.size(); ++i) {
    const std::string& name = problem.dofs[i].name;
    out.dofs[{name, 0}] = q.at(i).get<double>();
    out.dofs[{name, 1}] = v.at(i).get<double>();
    out.dofs[{name, 2}] = a.at(i).get<double>();
  }
  return out;
}

// The reference's test point: 0.8 sin(0.37 i) + 0.3 cos(1.1 i).
std::vector<double> test_point(const Problem& problem) {
  std::vector<double> out;
  for (const Dof& dof : problem.dofs)
    for (int k = 0; k < dof.basis.size(); ++k) {
      const auto i = static_cast<double>(out.size());
      out.push_back(0.8 * std::sin(0.37 * i) + 0.3 * std::cos(1.1 * i));
    }
  return out;
}

// The objective by four Gauss-Legendre points a span, as the reference has it.
double objective(const Problem& problem, const std::vector<double>& x) {
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double heavy = (18 + std::sqrt(30.0)) / 36, light = (18 - std::sqrt(30.0)) / 36;
  const std::array<std::pair<double, double>, 4> points{
      {{-outer, light}, {-inner, heavy}, {inner, heavy}, {outer, light}}};
  const std::vector<double> knots = breakpoints(problem.dofs[0].basis);
  double sum = 0;
  for (const Term& term : problem.objective)
    for (const Piece& piece : term.pieces)
      for (std::size_t k = 0; k + 1 < knots.size(); ++k)
        for (const auto& [point, weight] : points) {
          const double half = (knots[k + 1] - knots[k]) / 2, t = (knots[k] + knots[k + 1]) / 2 + half * point;
          const auto values = run(problem, piece.program, state_at(problem, x, t));
          sum += value_of(problem, term.weight) * weight * half * values.at(static_cast<std::size_t>(piece.output));
        }
  return sum;
}

// Residuals of a constraint at its instances (times, or evenly spaced), instance after instance.
std::vector<double> residuals(const Problem& problem, const Constraint& constraint, const std::vector<double>& x) {
  std::vector<double> times;
  for (const Quantity& time : constraint.scope.times) times.push_back(value_of(problem, time));
  const double from = value_of(problem, constraint.scope.from), to = value_of(problem, constraint.scope.to);
  for (int i = 0; i < constraint.scope.count; ++i)
    times.push_back(from + (to - from) * i / (constraint.scope.count - 1));
  std::vector<double> out;
  for (const double t : times)
    for (const double r : run(problem, constraint.program, state_at(problem, x, t))) out.push_back(r);
  return out;
}

TEST(Scenes, ArmTorquesAreTheReferences) {
  const Problem problem = problem_of(file_text("examples/throw_eliminated.scene"));
  const std::string integrand = problem.objective.at(0).pieces.at(0).program;
  const json samples = reference("arm3_samples.json").at("samples");
  ASSERT_FALSE(samples.empty());
  for (const json& sample : samples) {
    const State state = state_of(problem, sample.at("q"), sample.at("qd"), sample.at("qdd"));
    const auto force = plotted(problem, "arm.force", state);
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double torque = sample.at("tau").at(i).get<double>();
      EXPECT_NEAR(force.at(i), torque, 1e-12 * (1 + std::abs(torque)));
      sum += torque * torque;
    }
    EXPECT_NEAR(run(problem, integrand, state).at(0), sum, 1e-12 * (1 + sum));
  }
}

TEST(Scenes, ThrowRowsAreTheClosedForm) {
  const Problem problem = problem_of(file_text("examples/throw_eliminated.scene"));
  const double q[3] = {0.4, -0.9, 1.3}, v[3] = {2, -3, 5}, l[3] = {0.5, 0.4, 0.2};
  const State state = state_of(problem, q, v, json{0, 0, 0});
  double angle = -std::acos(-1.0) / 2, rate = 0, x = 0, y = 0, vx = 0, vy = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    angle += q[k], rate += v[k];
    x += l[k] * std::cos(angle), y += l[k] * std::sin(angle);
    vx -= l[k] * std::sin(angle) * rate, vy += l[k] * std::cos(angle) * rate;
  }
  const Constraint &throw_x = problem.constraints.at(2), &throw_y = problem.constraints.at(3);
  EXPECT_EQ(throw_x.scope.kind, Scope::Kind::times);
  EXPECT_EQ(value_of(problem, throw_x.scope.times.at(0)), 1.0);
  EXPECT_NEAR(run(problem, throw_x.program, state).at(0), x + vx * 0.6 - 2.5, 1e-14);
  EXPECT_NEAR(run(problem, throw_y.program, state).at(0), y + vy * 0.6 - 9.81 / 2 * 0.36 - 0.5, 1e-14);
  EXPECT_TRUE(problem.functionals.empty());
}

TEST(Scenes, P94AtTheTestPoint) {
  const Problem problem = problem_of(file_text("examples/throw_eliminated.scene"));
  const json expected = reference("eval_vectors.json").at("P94").at("x_test");
  const std::vector<double> x = test_point(problem);
  EXPECT_NEAR(objective(problem, x), expected.at("J").get<double>(), 1e-6);
  // The reference lists q1(0), q1(T), q2(0), ..., the scene its tuple at 0, then at T.
  for (std::size_t kind = 0; kind < 2; ++kind) {
    const auto own = residuals(problem, problem.constraints.at(kind), x);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t end = 0; end < 2; ++end)
        EXPECT_NEAR(own.at(3 * end + i), expected.at("con").at(6 * kind + 2 * i + end).get<double>(), 1e-12);
  }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(residuals(problem, problem.constraints.at(2 + i), x).at(0), expected.at("con").at(12 + i).get<double>(),
                1e-12);
}

TEST(Scenes, P92AtTheTestPoint) {
  const Problem problem = problem_of(file_text("tests/golden/p92.scene"));
  const json expected = reference("eval_vectors.json").at("P92").at("x_test");
  const json& con = expected.at("con");
  const std::vector<double> x = test_point(problem);
  ASSERT_EQ(x.size(), 135U);
  EXPECT_NEAR(objective(problem, x), expected.at("J").get<double>(), 1e-8);
  const auto rest = residuals(problem, problem.constraints.at(0), x);
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t end = 0; end < 2; ++end)
        EXPECT_NEAR(rest.at(6 * end + 3 * kind + i), con.at(6 * kind + 2 * i + end).get<double>(), 1e-12);
  const auto held = residuals(problem, problem.constraints.at(1), x);
  const auto flight = residuals(problem, problem.constraints.at(2), x);
  const auto goal = residuals(problem, problem.constraints.at(3), x);
  ASSERT_EQ(held.size(), 24U);
  ASSERT_EQ(flight.size(), 26U);
  for (std::size_t i = 0; i < 26; ++i) EXPECT_NEAR(flight[i], con.at(12 + i).get<double>(), 1e-11);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(goal.at(i), con.at(38 + i).get<double>(), 1e-12);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(held[2 * i + axis], con.at(40 + 12 * axis + i).get<double>(), 1e-12);
}

TEST(Scenes, PlayersForcesAndHandAreTheReferences) {
  const Problem problem = problem_of(file_text("examples/player_craig.scene"));
  const json samples = reference("player_samples.json").at("samples");
  ASSERT_FALSE(samples.empty());
  for (const json& sample : samples) {
    const State state = state_of(problem, sample.at("q"), sample.at("qd"), sample.at("qdd"));
    const auto force = plotted(problem, "player.force", state), hand = plotted(problem, "player.hand", state);
    for (std::size_t i = 0; i < 6; ++i) {
      const double expected = sample.at("F").at(i).get<double>();
      EXPECT_NEAR(force.at(i), expected, 1e-11 * (1 + std::abs(expected)));
    }
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(hand.at(i), sample.at("tip").at(i).get<double>(), 1e-13);
  }
}

// An acrobat on a sliding foot: a creature whose links have axes in place of a table of rows.
TEST(Scenes, AcrobatsForcesAreTheReferences) {
  const Problem problem = problem_of(R"(time [0, 1]
trajectory bspline spans 4
creature acrobat {
  gravity (0, -9.81, 0)
  link slide { prismatic X axis (1, 0, 0) }
  link lift  { prismatic Y axis (0, 1, 0) }
  link legs  { revolute FOOT axis (0, 0, 2); offset pi/2; mass 5; rod (0.5, 0, 0) }
  link trunk { revolute WAIST axis (0, 0, 1) origin (0.5, 0, 0); mass 5; com (0.25, 0, 0); inertia (0, 5/48, 5/48) }
}
)");
  const json samples = reference("acrobat_samples.json").at("samples");
  ASSERT_FALSE(samples.empty());
  for (const json& sample : samples) {
    const State state = state_of(problem, sample.at("s"), sample.at("sd"), sample.at("sdd"));
    const auto force = plotted(problem, "acrobat.force", state);
    for (std::size_t i = 0; i < 4; ++i) {
      const double expected = sample.at("F").at(i).get<double>();
      EXPECT_NEAR(force.at(i), expected, 1e-11 * (1 + std::abs(expected)));
    }
  }
}

TEST(Scenes, AnOutsideForceIsTakenOffTheMotors) {
  const std::string scene = R"(time [0, 1]
trajectory bspline spans 4
creature cart {
  link body { prismatic X axis (1, 0, 0); mass 2 }
  point nose on body (0.3, 0, 0)
  force on nose = (-3*cart.nose.x', 0, 0)
}
)";
  const Problem problem = problem_of(scene);
  const auto force = plotted(problem, "cart.force", state_of(problem, {0.5}, {4}, {7}));
  EXPECT_DOUBLE_EQ(force.at(0), 2 * 7 + 3 * 4);
}

TEST(Scenes, CreaturesPlotsAndBodies) {
  const Problem problem = problem_of(file_text("examples/throw.scene"));
  std::vector<std::string> names;
  for (const Plot& plot : problem.plots) names.push_back(plot.name);
  EXPECT_EQ(names, (std::vector<std::string>{"arm.hand", "arm.upper", "arm.fore", "arm.palm", "arm.com", "arm.force",
                                             "arm.shoulder.force", "arm.elbow.force", "arm.wrist.force", "arm.kinetic",
                                             "arm.potential", "ball.slideX", "ball.slideY", "ball.com", "ball.force",
                                             "ball.X.force", "ball.Y.force", "ball.kinetic", "ball.potential"}));
  const json q{0.1, 0.2, 0.3, 2, 3}, v{1, 2, 3, 4, 5}, a{0, 0, 0, 0, 0};
  const State state = state_of(problem, q, v, a);
  EXPECT_DOUBLE_EQ(plotted(problem, "ball.kinetic", state).at(0), 0.1 * (16 + 25));
  EXPECT_DOUBLE_EQ(plotted(problem, "ball.potential", state).at(0), 0.2 * 9.81 * 3);
  ASSERT_EQ(problem.bodies.size(), 4U);
  const Body& fore = problem.bodies[1];
  EXPECT_EQ(fore.name, "arm.fore");
  EXPECT_EQ(fore.shape, Body::Shape::capsule);
  ASSERT_EQ(fore.size.size(), 4U);
  EXPECT_DOUBLE_EQ(value_of(problem, fore.size[1]), -0.4);
  // The pose's last column is the frame's place; the capsule's other end is the elbow.
  const auto values = run(problem, fore.program, state);
  const auto frame = plotted(problem, "arm.fore", state), elbow = plotted(problem, "arm.upper", state);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto at = [&](std::size_t column) {
      return values.at(static_cast<std::size_t>(fore.outputs.at(4 * row + column)));
    };
    EXPECT_DOUBLE_EQ(at(3), frame[row]);
    EXPECT_NEAR(at(3) - 0.4 * at(0), elbow[row], 1e-15);
  }
}

TEST(Scenes, FixedLinksAreShiftedByTheirOrigin) {
  const Problem problem = problem_of(R"(time [0, 1]
trajectory bspline spans 4
creature c {
  link turn { revolute angle axis (0, 0, 1) origin (1, 0, 0) }
  link arm  { fixed; origin (2, 0, 0) }
}
)");
  const auto at = plotted(problem, "c.arm", state_of(problem, {std::acos(-1.0) / 2}, {0}, {0}));
  EXPECT_NEAR(at.at(0), 1, 1e-15);
  EXPECT_NEAR(at.at(1), 2, 1e-15);
}

// The manual's blocks, one after another, are a scene.
TEST(Scenes, TheManualCompiles) {
  std::string scene;
  for (const std::string& block : manual_blocks()) scene += block;
  const Problem problem = problem_of(scene);
  EXPECT_EQ(problem.constraints.size(), 7U);  // one of them a replacement
  EXPECT_EQ(problem.objective.size(), 3U);    // likewise
  EXPECT_EQ(problem.dofs.size(), 5U);         // without the one eliminated
  EXPECT_EQ(problem.parameters.size(), 1U);
  // The manual has an example of every action, and of every other statement that is built.
  std::set<std::size_t> actions;
  for (const PlacedAction& action : problem.actions) actions.insert(action.action.index());
  EXPECT_EQ(actions.size(), std::variant_size_v<Action>);
  for (const std::string word : {"time", "constant", "parameter", "trajectory", "dof", "let", "define", "eliminate",
                                 "creature", "constrain", "minimize", "keyframe"})
    EXPECT_NE(("\n" + scene).find("\n" + word + " "), std::string::npos) << word;
  EXPECT_EQ(read_problem(write(problem)), problem);
}

TEST(Scenes, EveryExampleCompilesAndSurvivesWritingAndReading) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SPACETIME_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".scene") continue;
    const std::string text = file_text("examples/" + entry.path().filename().string());
    EXPECT_TRUE(text.starts_with("# ")) << entry.path();
    const Problem problem = problem_of(text);
    EXPECT_EQ(read_problem(write(problem)), problem) << entry.path();
    EXPECT_FALSE(problem.actions.empty()) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace spacetime::symbolic
