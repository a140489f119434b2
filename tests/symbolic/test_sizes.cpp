// How large derivatives get.  The bounds are what was reached, with a little room: a change that costs more than that
// should know why.  The peer's figures (CasADi) and those of other formulations are in tests/reference.
#include <gtest/gtest.h>

#include "symbolic/derivative.h"
#include "symbolic/emit.h"
#include "tests/symbolic/planar_arm.h"
#include "tests/symbolic/random_linkage.h"

namespace spacetime::symbolic {
namespace {

struct Sizes {
  Size torques, gradient, hessian;  // the torques; value and gradient of their summed squares; with the Hessian
  Program program;
};

Sizes sizes(int links) {
  Graph g;
  const auto arm = planar_arm(g, links);
  const auto tau = generalised_forces(g, arm);
  const auto inputs = arm_inputs(arm);
  const Expr sum = summed_squares(g, tau);
  Sizes result;
  result.torques = size_of(g, tau);
  std::vector<Expr> roots{sum};
  for (const auto& entry : jacobian(g, roots, inputs)) roots.push_back(entry.value);
  result.gradient = size_of(g, roots);
  const auto second = hessian(g, sum, inputs);
  EXPECT_EQ(second.size(), static_cast<std::size_t>(3 * links * (3 * links + 1) / 2));
  for (const auto& entry : second) roots.push_back(entry.value);
  result.hessian = size_of(g, roots);
  result.program = emit(g, {&sum, 1}, Derivatives::second);
  return result;
}

// The 1994 paper: 145,584 nodes shrink to 2,932 by sharing.
TEST(Sizes, ThreeLinkArm) {
  const auto s = sizes(3);
  EXPECT_GT(s.hessian.tree, 50'000);
  EXPECT_LE(s.torques.shared, 85u);
  EXPECT_LE(s.gradient.shared, 180u);
  EXPECT_LE(s.hessian.shared,
            640u);  // the peer's: 1,587; a closed form in absolute angles: 635 with sums of many terms
  EXPECT_LE(s.program.value_operations, 50);
  EXPECT_LE(s.program.jacobian_operations, 115);
  EXPECT_LE(s.program.op.size(), 445u);
}

TEST(Sizes, SixLinkArm) {
  const auto s = sizes(6);
  EXPECT_LE(s.hessian.shared, 3'600u);  // the peer's: 6,004
  EXPECT_LE(s.program.op.size(), 2'350u);
}

TEST(Sizes, TwelveLinkArm) {
  const auto s = sizes(12);
  EXPECT_GT(s.hessian.tree, 1e11);
  EXPECT_LE(s.hessian.shared, 22'500u);  // the peer's: 23,776
  EXPECT_LE(s.program.op.size(), 13'500u);
}

// Values and gradients grow linearly with the number of links.
TEST(Sizes, GradientsGrowLinearly) {
  const auto six = sizes(6).program, twelve = sizes(12).program;
  EXPECT_LE(twelve.jacobian_operations, 2.4 * six.jacobian_operations);
}

// A six-axis arm as they are built: three pairs of axes at right angles, full inertia tensors.
TEST(Sizes, SpatialArm) {
  Graph g;
  Linkage arm;
  arm.gravity = {g.number(0), g.number(-9.81), g.number(0)};
  for (int k = 0; k < 6; ++k) {
    Link link;
    link.parent = k - 1;
    link.joint = Link::Joint::revolute;
    link.coordinate = coordinate(g, numbered("q", static_cast<std::size_t>(k)));
    link.alpha = g.pi(k == 1 ? 0 : k % 2 == 1 ? -0.5 : 0.5);
    link.a = g.number(k == 1 ? 0.4 : 0);
    link.d = g.number(k == 3 ? 0.4 : 0);
    link.mass = g.number(6 - k);
    link.com = {g.number(k == 1 ? -0.2 : 0), g.number(0), g.number(0.1)};
    for (int i = 0; i < 3; ++i) link.inertia[i] = g.number(0.02 + 0.01 * i);
    arm.links.push_back(link);
  }
  const auto tau = generalised_forces(g, arm);
  const Expr sum = summed_squares(g, tau);
  const auto p = emit(g, {&sum, 1}, Derivatives::second);
  EXPECT_LE(p.value_operations, 330);  // Luh, Walker and Paul count 150 n - 48 multiplications and 131 n - 48 additions
  EXPECT_LE(p.jacobian_operations, 900);
  EXPECT_LE(p.op.size(), 6'500u);
}

}  // namespace
}  // namespace spacetime::symbolic
