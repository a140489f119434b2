#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "symbolic/derivative.h"
#include "symbolic/mechanics.h"
#include "symbolic/value.h"
#include "tests/symbolic/planar_arm.h"
#include "tests/symbolic/random_linkage.h"

namespace spacetime::symbolic {
namespace {

constexpr double tolerance = 1e-12;  // relative
constexpr std::uint64_t seed = 19920726;

nlohmann::json reference(const std::string& file) {
  return nlohmann::json::parse(std::ifstream(SPACETIME_SOURCE_DIR "/tests/reference/" + file));
}

// The graph's inputs at given values of the coordinates; everything else is zero.
class Point {
 public:
  explicit Point(const Graph& graph) : graph_(graph), inputs_(graph.inputs().size()) {}
  void set(Expr input, double value) { inputs_[graph_.node(input).input] = value; }
  void set(const Coordinate& c, double q, double v, double a) { set(c.q, q), set(c.v, v), set(c.a, a); }
  double at(Expr e) const { return evaluate<double>(graph_, {&e, 1}, inputs_)[0]; }
  std::vector<double> at(const std::vector<Expr>& e) const { return evaluate<double>(graph_, e, inputs_); }

 private:
  const Graph& graph_;
  std::vector<double> inputs_;
};

void expect_near(double value, double expected, double scale, const std::string& what) {
  EXPECT_NEAR(value, expected, tolerance * std::fmax(scale, std::fabs(expected))) << what;
}

TEST(Mechanics, ThreeLinkArm) {
  const auto data = reference("arm3_samples.json");
  Graph g;
  const auto arm = planar_arm(g, 3);
  const auto tau = generalised_forces(g, arm);
  const auto inputs = arm_inputs(arm);
  const Expr sum = summed_squares(g, tau);
  const auto j = jacobian(g, tau, inputs);
  const auto h = hessian(g, sum, inputs);
  for (const auto& sample : data.at("samples")) {
    Point point(g);
    for (int k = 0; k < 3; ++k) {
      point.set(*arm.links[k].coordinate, sample["q"][k], sample["qd"][k], sample["qdd"][k]);
    }
    double jacobian_scale = 0, hessian_scale = 0;
    for (const auto& row : sample["J"]) {
      for (const double x : row) jacobian_scale = std::fmax(jacobian_scale, std::fabs(x));
    }
    for (const double x : sample["H_sum_tau2"]) hessian_scale = std::fmax(hessian_scale, std::fabs(x));
    for (int k = 0; k < 3; ++k) expect_near(point.at(tau[k]), sample["tau"][k], 1, "torque");
    std::vector<double> full(27);
    for (const auto& entry : j) full[entry.row * 9 + entry.column] = point.at(entry.value);
    for (int i = 0; i < 27; ++i) expect_near(full[i], sample["J"][i / 9][i % 9], jacobian_scale, "Jacobian");
    std::vector<double> lower(81);
    for (const auto& entry : h) lower[entry.row * 9 + entry.column] = point.at(entry.value);
    for (int row = 0, i = 0; row < 9; ++row) {
      for (int column = row; column < 9; ++column, ++i) {
        expect_near(lower[column * 9 + row], sample["H_sum_tau2"][i], hessian_scale, "Hessian");
      }
    }
  }
}

// Modified rows, as Craig has them, become a fixed link ahead of each joint; the base is turned so that z of the first
// row points along x.
TEST(Mechanics, Player) {
  const auto data = reference("player_samples.json");
  Graph g;
  Linkage player;
  player.gravity = {g.number(0), g.number(-9.81), g.number(0)};
  Link base;
  base.theta = base.alpha = g.pi(0.5);
  player.links.push_back(base);
  const auto exact = [&](double angle) { return g.pi(std::round(angle / M_PI * 2) / 2); };
  for (int k = 0; k < 6; ++k) {
    const auto& row = data["dh_rows_alpha_a_d_theta_type"][k];
    Link ahead;
    ahead.parent = static_cast<int>(player.links.size()) - 1;
    ahead.alpha = exact(row[0]);
    ahead.a = g.number(row[1]);
    player.links.push_back(ahead);
    Link link;
    link.parent = ahead.parent + 1;
    link.coordinate = coordinate(g, data["names"][k]);
    link.joint = row[4] == "R" ? Link::Joint::revolute : Link::Joint::prismatic;
    link.d = g.number(row[2]);
    link.theta = exact(row[3]);
    link.mass = g.number(data["masses"][k]);
    for (int i = 0; i < 3; ++i) {
      link.com[i] = g.number(data["com_in_link_frame"][k][i]);
      link.inertia[i] = g.number(data["inertia_about_com_in_link_frame"][k][i][i]);
    }
    player.links.push_back(link);
  }
  const auto force = generalised_forces(g, player);
  ASSERT_EQ(force.size(), 6u);
  const auto poses = frames(g, player);
  const auto tip = transform(g, poses.back(), {g.number(data["tip_in_last_frame"][0]), g.number(0), g.number(0)});
  for (const auto& sample : data["samples"]) {
    Point point(g);
    for (int k = 0; k < 6; ++k) {
      point.set(*player.links[2 + 2 * k].coordinate, sample["q"][k], sample["qd"][k], sample["qdd"][k]);
    }
    double scale = 0;
    for (const double x : sample["F"]) scale = std::fmax(scale, std::fabs(x));
    for (int k = 0; k < 6; ++k) expect_near(point.at(force[k]), sample["F"][k], scale, data["names"][k]);
    for (int k = 0; k < 3; ++k) expect_near(point.at(tip[k]), sample["tip"][k], 1, "tip");
  }
}

TEST(Mechanics, Acrobat) {
  const auto data = reference("acrobat_samples.json");
  Graph g;
  Linkage acrobat;
  acrobat.gravity = {g.number(0), g.number(-data["g"].get<double>()), g.number(0)};
  const std::array<Vector3, 2> axes{Vector3{g.number(1), g.number(0), g.number(0)},
                                    Vector3{g.number(0), g.number(1), g.number(0)}};
  for (int k = 0; k < 4; ++k) {
    Link link;
    link.parent = k - 1;
    link.coordinate = coordinate(g, data["names"][k]);
    link.joint = k < 2 ? Link::Joint::prismatic : Link::Joint::revolute;
    if (k < 2) {
      link.axis = axes[k];
    } else {
      const double l = data["l"][k - 2], m = data["m"][k - 2];
      link.offset = k == 2 ? g.pi(0.5) : g.number(0);
      link.a = g.number(l);
      link.mass = g.number(m);
      link.com[0] = g.number(-l / 2);
      link.inertia[1] = link.inertia[2] = g.number(m * l * l / 12);
    }
    acrobat.links.push_back(link);
  }
  const auto force = generalised_forces(g, acrobat);
  for (const auto& sample : data["samples"]) {
    Point point(g);
    for (int k = 0; k < 4; ++k) {
      point.set(*acrobat.links[k].coordinate, sample["s"][k], sample["sd"][k], sample["sdd"][k]);
    }
    double scale = 0;
    for (const double x : sample["F"]) scale = std::fmax(scale, std::fabs(x));
    for (int k = 0; k < 4; ++k) expect_near(point.at(force[k]), sample["F"][k], scale, data["names"][k]);
  }
}

TEST(Mechanics, ArmsOfOneToTwelveLinks) {
  const auto rows = reference("eval_vectors.json")["nlink"]["rows"];
  ASSERT_EQ(rows.size(), 12u);
  for (const auto& row : rows) {
    const int n = row["n"];
    Graph g;
    const auto arm = planar_arm(g, std::vector<double>(n, 0.3), std::vector<double>(n, 1.0));
    const auto tau = generalised_forces(g, arm);
    Point point(g);
    for (int k = 1; k <= n; ++k) {
      point.set(*arm.links[k - 1].coordinate, std::sin(k), 2 * std::cos(1.3 * k), 5 * std::sin(0.7 * k + 1));
    }
    double scale = 0;
    for (const double x : row["tau"]) scale = std::fmax(scale, std::fabs(x));
    for (int k = 0; k < n; ++k) expect_near(point.at(tau[k]), row["tau"][k], scale, "torque");
  }
}

// The same frames from 4x4 matrices of numbers, link by link.
using Pose = std::array<std::array<double, 4>, 4>;
Pose product(const Pose& m, const Pose& n) {
  Pose result{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) result[i][j] += m[i][k] * n[k][j];
    }
  }
  return result;
}
Pose move(double x, double y, double z) { return {{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}, {0, 0, 0, 1}}}; }
Pose turn_z(double q) {
  return {{{std::cos(q), -std::sin(q), 0, 0}, {std::sin(q), std::cos(q), 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}
Pose turn_x(double q) {
  return {{{1, 0, 0, 0}, {0, std::cos(q), -std::sin(q), 0}, {0, std::sin(q), std::cos(q), 0}, {0, 0, 0, 1}}};
}
// By z to u, which is the turn about u by half a turn of the bisector ... written as two turns that bring z onto u.
Pose turn_about(double x, double y, double z, double q) {
  const double around = std::atan2(y, x), tilt = std::acos(z / std::sqrt(x * x + y * y + z * z));
  const auto turn_y = [](double p) {
    return Pose{{{std::cos(p), 0, std::sin(p), 0}, {0, 1, 0, 0}, {-std::sin(p), 0, std::cos(p), 0}, {0, 0, 0, 1}}};
  };
  return product(product(turn_z(around), turn_y(tilt)), product(turn_z(q), product(turn_y(-tilt), turn_z(-around))));
}

struct RandomMechanics : testing::Test {
  std::mt19937_64 random{seed};
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  Point random_point(const Graph& g, const RandomLinkage& made) {
    Point point(g);
    for (const auto& c : made.coordinates) point.set(c, uniform(-3, 3), uniform(-2, 2), uniform(-5, 5));
    return point;
  }
  RandomMechanics() { RecordProperty("seed", std::to_string(seed)); }
};

TEST_F(RandomMechanics, FramesAgainstMatricesOfNumbers) {
  for (int trial = 0; trial < 100; ++trial) {
    Graph g;
    const auto made = random_linkage(g, 6, random);
    const auto poses = frames(g, made.linkage);
    const auto point = random_point(g, made);
    std::vector<Pose> expected;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto& link = made.linkage.links[i];
      const double q = link.coordinate ? point.at(link.coordinate->q) : 0;
      const double joint = q + point.at(link.offset);
      const bool slides = link.joint == Link::Joint::prismatic;
      Pose step;
      if (link.axis) {
        const auto u = point.at(std::vector<Expr>(link.axis->begin(), link.axis->end()));
        const double length = std::hypot(u[0], u[1], u[2]) / joint;
        step =
            product(move(point.at(link.origin[0]), point.at(link.origin[1]), point.at(link.origin[2])),
                    slides ? move(u[0] / length, u[1] / length, u[2] / length) : turn_about(u[0], u[1], u[2], joint));
      } else {
        const double theta = point.at(link.theta) + (slides ? 0 : joint), d = point.at(link.d) + (slides ? joint : 0);
        step = product(product(turn_z(theta), move(point.at(link.a), 0, d)), turn_x(point.at(link.alpha)));
      }
      expected.push_back(link.parent < 0 ? step : product(expected[link.parent], step));
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          EXPECT_NEAR(point.at(poses[i].rotation[row][column]), expected[i][row][column], 1e-13) << trial;
        }
        EXPECT_NEAR(point.at(poses[i].position[row]), expected[i][row][3], 1e-12) << trial;
      }
    }
  }
}

// Kinetic energy from the frames alone: 1/2 m |c'|^2 + 1/2 trace(R' S R'^T).
Expr energy_of_frames(Graph& g, const Linkage& linkage, const std::vector<Frame>& poses) {
  Expr twice;
  const auto rate = [&](Expr e) { return *time_derivative(g, e); };
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& link = linkage.links[i];
    for (const Expr x : transform(g, poses[i], link.com)) {
      twice = g.add(twice, g.multiply(link.mass, g.multiply(rate(x), rate(x))));
    }
    const auto [xx, yy, zz, xy, xz, yz] = link.inertia;
    const auto second = [&](Expr a, Expr b, Expr c) { return g.multiply(g.number(0.5), g.subtract(g.add(a, b), c)); };
    const Matrix3 s{Vector3{second(yy, zz, xx), g.negate(xy), g.negate(xz)},
                    Vector3{g.negate(xy), second(xx, zz, yy), g.negate(yz)},
                    Vector3{g.negate(xz), g.negate(yz), second(xx, yy, zz)}};
    for (const auto& row : poses[i].rotation) {
      const Vector3 moving{rate(row[0]), rate(row[1]), rate(row[2])};
      twice = g.add(twice, dot(g, moving, multiply(g, s, moving)));
    }
  }
  return g.multiply(g.number(0.5), twice);
}

TEST_F(RandomMechanics, EnergyRisesByThePowerPutIn) {
  for (int trial = 0; trial < 60; ++trial) {
    Graph g;
    const auto made = random_linkage(g, 6, random);
    const auto poses = frames(g, made.linkage);
    const auto force = generalised_forces(g, made.linkage);
    ASSERT_EQ(force.size(), made.coordinates.size());
    const Expr kinetic = kinetic_energy(g, made.linkage), potential = potential_energy(g, made.linkage, poses);
    const Expr rise = *time_derivative(g, g.add(kinetic, potential));
    Expr power;
    for (std::size_t k = 0; k < force.size(); ++k) {
      power = g.add(power, g.multiply(force[k], made.coordinates[k].v));
    }
    for (const auto& outside : made.linkage.forces) {
      const auto at = transform(g, poses[outside.link], outside.point);
      for (int k = 0; k < 3; ++k) power = g.add(power, g.multiply(outside.force[k], *time_derivative(g, at[k])));
    }
    const auto point = random_point(g, made);
    expect_near(point.at(rise), point.at(power), 100, "trial " + std::to_string(trial));
    expect_near(point.at(kinetic), point.at(energy_of_frames(g, made.linkage, poses)), 10, "kinetic energy");
  }
}

// d/dt dT/dq' - dT/dq + dV/dq = what the motors supply + J^T F.
TEST_F(RandomMechanics, LagrangesEquations) {
  for (int trial = 0; trial < 40; ++trial) {
    Graph g;
    const auto made = random_linkage(g, 5, random);
    const auto poses = frames(g, made.linkage);
    const auto force = generalised_forces(g, made.linkage);
    const Expr kinetic = energy_of_frames(g, made.linkage, poses);
    const Expr potential = potential_energy(g, made.linkage, poses);
    const auto by = [&](Expr e, Expr input) {
      const auto entries = jacobian(g, {&e, 1}, {&input, 1});
      return entries.empty() ? Expr{} : entries[0].value;
    };
    const auto point = random_point(g, made);
    for (std::size_t k = 0; k < force.size(); ++k) {
      const auto& [q, v, a] = made.coordinates[k];
      const Expr momentum = *time_derivative(g, by(kinetic, v));
      const Expr lagrange = g.add(g.subtract(momentum, by(kinetic, q)), by(potential, q));
      double work = 0;
      for (const auto& outside : made.linkage.forces) {
        const auto at = transform(g, poses[outside.link], outside.point);
        for (int i = 0; i < 3; ++i) work += point.at(by(at[i], q)) * point.at(outside.force[i]);
      }
      expect_near(point.at(force[k]) + work, point.at(lagrange), 100, "trial " + std::to_string(trial));
    }
  }
}

TEST_F(RandomMechanics, OutsideForcesDoVirtualWork) {
  for (int trial = 0; trial < 40; ++trial) {
    Graph g;
    const auto made = random_linkage(g, 6, random);
    auto free = made.linkage;
    free.forces.clear();
    const auto with = generalised_forces(g, made.linkage), without = generalised_forces(g, free);
    const auto poses = frames(g, made.linkage);
    const auto point = random_point(g, made);
    for (std::size_t k = 0; k < with.size(); ++k) {
      double work = 0;
      for (const auto& outside : made.linkage.forces) {
        const auto at = transform(g, poses[outside.link], outside.point);
        for (const auto& entry : jacobian(g, at, {&made.coordinates[k].q, 1})) {
          work += point.at(entry.value) * point.at(outside.force[entry.row]);
        }
      }
      expect_near(point.at(without[k]) - point.at(with[k]), work, 100, "trial " + std::to_string(trial));
    }
  }
}

TEST(Mechanics, CentreOfMassAndAFreeBall) {
  Graph g;
  Linkage ball;
  ball.gravity = {g.number(0), g.number(-9.81), g.number(0)};
  for (int k = 0; k < 2; ++k) {
    Link slide;
    slide.parent = k - 1;
    slide.joint = Link::Joint::prismatic;
    slide.axis = Vector3{g.number(k == 0), g.number(k == 1), g.number(0)};
    slide.coordinate = coordinate(g, k == 0 ? "X" : "Y");
    if (k == 1) slide.mass = g.number(0.2);
    ball.links.push_back(slide);
  }
  const auto force = generalised_forces(g, ball);
  const Expr x = ball.links[0].coordinate->a, y = ball.links[1].coordinate->a;
  EXPECT_EQ(force[0], g.multiply(g.number(0.2), x));
  EXPECT_EQ(force[1], g.multiply(g.number(0.2), g.add(y, g.number(9.81))));
  const auto poses = frames(g, ball);
  const auto com = centre_of_mass(g, ball, poses);
  EXPECT_EQ(com[0], ball.links[0].coordinate->q);
  EXPECT_EQ(com[1], ball.links[1].coordinate->q);
  EXPECT_EQ(com[2], g.number(0));

  const auto arm = planar_arm(g, 3);
  const auto arm_com = centre_of_mass(g, arm, frames(g, arm));
  Point point(g);  // hanging straight down
  EXPECT_NEAR(point.at(arm_com[0]), 0, 1e-15);
  EXPECT_NEAR(point.at(arm_com[1]), -(2 * 0.25 + 1.5 * 0.7 + 0.5 * 1.0) / 4, 1e-15);
}

// A right angle leaves no dust: the joints of a spatial arm turn about axes of zeros and ones.
TEST(Mechanics, RightAnglesAreExact) {
  Graph g;
  Linkage arm;
  for (int k = 0; k < 2; ++k) {
    Link link;
    link.parent = k - 1;
    link.joint = Link::Joint::revolute;
    link.coordinate = coordinate(g, numbered("q", static_cast<std::size_t>(k)));
    link.alpha = g.pi(0.5);
    arm.links.push_back(link);
  }
  const auto pose = frames(g, arm)[0];
  const Expr q = arm.links[0].coordinate->q;
  EXPECT_EQ(pose.rotation[0][0], g.cosine(q));
  EXPECT_EQ(pose.rotation[0][1], g.number(0));
  EXPECT_EQ(pose.rotation[0][2], g.sine(q));
  EXPECT_EQ(pose.rotation[2][1], g.number(1));
  EXPECT_EQ(pose.rotation[2][2], g.number(0));
}

}  // namespace
}  // namespace spacetime::symbolic
