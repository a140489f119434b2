// Inequalities and bounds: Bryson and Denham's problem, against its analytic optimum and an active-set solver's values.
//   min integral(u^2)/2, x'' = u, x(0) = x(1) = 0, x'(0) = 1 = -x'(1), x <= l = 1/9:   J = 4/(9 l) = 4
#include <gtest/gtest.h>

#include <cmath>

#include "common/bspline.h"
#include "tests/optimizer/reference.h"

namespace spacetime::optimizer {
namespace {

std::string bryson_denham(int spans, const std::string& instants) {
  const bool bound = instants == "coefficients<=l";
  std::string text = "time [0, 1]\nconstant l = 1/9\ntrajectory bspline spans " + std::to_string(spans) + "\ndof x";
  text += bound ? " in [-9, l]\n" : "\n";
  text += "constrain start: (x, x') = (0, 1)  at 0\nconstrain end: (x, x') = (0, -1)  at 1\n";
  const int per_span = instants == "4perspan" ? 4 : instants == "16perspan" ? 16 : 1;
  if (!bound) text += "constrain limit: x <= l  over [0, 1] count " + std::to_string(per_span * spans + 1) + "\n";
  return text + "minimize integral(x''^2)/2\n";
}

TEST(BrysonDenham, AsTheReference) {
  const auto rows = reference("analytic_problems.json")["bryson_denham"];
  ASSERT_EQ(rows.size(), 40U);
  for (const auto& row : rows) {
    const int spans = row["N"];
    const std::string instants = row["instants"];
    SCOPED_TRACE(instants + ", " + std::to_string(spans) + " spans");
    const Motion motion = run_scene(bryson_denham(spans, instants));
    EXPECT_EQ(motion.status, Status::converged) << motion.message;
    EXPECT_LE(motion.violation, 1e-8);
    EXPECT_LE(motion.iterations, 100);
    EXPECT_NEAR(motion.objective, row["J"].get<double>(), 2e-7);
    if (instants == "coefficients<=l") {
      const auto x = coefficients_of(motion);
      EXPECT_LE(*std::ranges::max_element(x), 1.0 / 9 + 1e-8);
    }
  }
}

TEST(BrysonDenham, HasItsThreeArcs) {
  const Motion motion = run_scene(bryson_denham(96, "knots"));
  const double l = 1.0 / 9;
  for (double t = 0; t <= 0.5; t += 0.02) {
    const double exact = t < 3 * l ? l * (1 - std::pow(1 - t / (3 * l), 3)) : l;
    const Trajectory& x = motion.dofs[0];
    EXPECT_NEAR(value(x.basis, x.coefficients, t), exact, 1e-5) << t;
    EXPECT_NEAR(value(x.basis, x.coefficients, 1 - t), exact, 1e-5) << t;
  }
}

}  // namespace
}  // namespace spacetime::optimizer
