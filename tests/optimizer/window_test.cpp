// Windows: what is free moves as if the rest were data, and the rest does not move at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "optimizer/evaluation.h"
#include "optimizer/freedom.h"
#include "optimizer/layout.h"
#include "optimizer/window.h"
#include "tests/optimizer/evaluated.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string head = R"(time [0, 2]
trajectory bspline spans 20
dof x = 0.3
dof y = 0.1
minimize bend: integral(x''^2 + y''^2 + cosh(x - 2*y) + sin(3*t)*x + x^2)
)";

const std::vector<double>& of(const Motion& motion, const std::string& dof) {
  return std::ranges::find(motion.dofs, dof, &Trajectory::name)->coefficients;
}

// Coefficients whose support [knots[k], knots[k + 4]] lies within [0.5, 1.2], knots 0.1 apart: k = 8 ... 11.
TEST(Window, FreesTheCoefficientsWhoseSupportLiesInside) {
  const Problem problem = problem_of(head + "solve\n");
  const Window window{Interval{{0.5, {}, 0}, {1.2, {}, 0}}, {"y"}};
  const Freedom freedom = within(problem, evaluate_constants(problem), window);
  for (int k = 0; k < 23; ++k) {
    EXPECT_FALSE(freedom.has(0, k));
    EXPECT_EQ(freedom.has(1, k), k >= 8 && k <= 11) << k;
  }
}

TEST(Window, LeavesTheRestBitForBit) {
  const std::string scene = head + "constrain x = 1 at 0, 2\nconstrain y = x at 0.8, 1.7\niterate 1\n";
  const Motion before = run_scene(scene);
  const Motion after = run_scene(scene + "control y 9 = 0.7\nwindow [0.5, 1.2] of y\nsolve\n");
  EXPECT_EQ(after.status, Status::converged) << after.message;
  EXPECT_EQ(of(before, "x"), of(after, "x"));
  for (int k = 0; k < 23; ++k) {
    const bool free = k >= 8 && k <= 11;
    EXPECT_EQ(of(before, "y")[k] == of(after, "y")[k], !free) << k;
  }
}

// The gradient of the whole Lagrangian vanishes where something is free.
TEST(Window, FindsTheOptimumOfWhatIsFree) {
  const Problem problem = problem_of(head + "iterate 0\nwindow [0.3, 1.6]\nsolve\n");
  const Motion motion = run(problem, {});
  ASSERT_EQ(motion.status, Status::converged) << motion.message;
  Evaluated whole(problem);
  const auto x = coefficients_of(motion);
  whole.at(Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size())));
  const Freedom freedom = within(problem, evaluate_constants(problem), {Interval{{0.3, {}, 0}, {1.6, {}, 0}}, {}});
  const Eigen::VectorXd gradient = whole.gradient();
  double inside = 0, outside = 0;
  for (int u = 0; u < whole.t.unknowns(); ++u) {
    double& largest = freedom.has(u / 23, u % 23) ? inside : outside;
    largest = std::max(largest, std::abs(gradient[u]));
  }
  EXPECT_LE(inside, 1e-8);
  EXPECT_GT(outside, 1e-2);
  EXPECT_NEAR(whole.values.objective, motion.objective, 1e-12 * std::abs(motion.objective));
}

// An integral over the whole time is met by what is free, and depends on what is not.
TEST(Window, FunctionalsCountWhatLiesOutside) {
  const Motion motion = run_scene(head +
                                  "let area = integral(x)\nconstrain sum: area*at(y, 1) = 0.5\nconstrain x = 1 at 0\n"
                                  "iterate 0\nwindow [0.4, 1.8]\nsolve\n");
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  const auto sum = std::ranges::find(motion.violations, "sum", &Violation::name);
  EXPECT_LE(sum->max, 1e-8);
  EXPECT_EQ(of(motion, "x").front(), 0.3);  // outside of the window: not met, and said so
  EXPECT_NEAR(motion.violation, 0.7, 1e-12);
  EXPECT_NE(motion.message.find("over the whole time 'constraint 2' (line 8) is off by 0.7"), std::string::npos)
      << motion.message;
}

TEST(Window, WhatNothingFreeTouchesIsNotThere) {
  const Problem problem = problem_of(head +
                                     "constrain integral(x) = 1\nconstrain at(y, 0.1)*at(y, 1.9) = 1\n"
                                     "constrain x = y over [0, 2] every 0.1\n");
  const Freedom freedom = within(problem, evaluate_constants(problem), {Interval{{0.5, {}, 0}, {1.2, {}, 0}}, {"y"}});
  const Transcription t = transcribe(problem, freedom);
  EXPECT_EQ(t.functional_row, (std::vector<int>{-1, -1, -1}));
  // Instances inside: at 0.6 ... 1.1; at the ends 0.5 and 1.2 a free coefficient's value is 0.
  ASSERT_EQ(t.rows.size(), 6U);
  for (const Row& row : t.rows) {
    EXPECT_GT(row.time, 0.55);
    EXPECT_LT(row.time, 1.15);
  }
  // Samples of the objective lie within 7 of 20 spans.
  for (const Batch& batch : t.batches) {
    if (batch.summed()) {
      EXPECT_EQ(batch.samples(), 4 * 7);
    }
  }
  EXPECT_EQ(arrange(t).size(), 4 + 6);
}

// The same free unknowns and rows: the same derivatives as in the whole.
TEST(Window, DerivativesAreThoseOfTheWhole) {
  const Problem problem = problem_of(head +
                                     "constrain s: integral(x*y) = 1\nconstrain x*y = 1 over [0, 2] every 0.1\n"
                                     "constrain l: x^2 <= y over [0, 2] every 0.2\n");
  const Freedom freedom = within(problem, evaluate_constants(problem), {Interval{{0.4, {}, 0}, {1.5, {}, 0}}, {}});
  Evaluated whole(problem);
  Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(
      whole.t.unknowns(), [](Eigen::Index k) { return 0.5 + 0.1 * std::sin(1.3 * static_cast<double>(k)); });
  std::vector<double> all(x.begin(), x.end());
  settle_functionals(whole.t, all, whole.workspace);
  whole.at(Eigen::Map<const Eigen::VectorXd>(all.data(), x.size()));

  Transcription part = transcribe(problem, freedom);
  settle_elsewhere(whole.t, part, all);
  const auto own = taken(whole.t, part, all);
  const Layout layout = arrange(part);
  Workspace workspace;
  Linearisation linear = start_linearisation(layout);
  const Values values = evaluate(part, own, workspace);
  linearise(part, layout, own, workspace, linear);
  for (const double z : std::span(values.residual).first(1)) EXPECT_NEAR(z, 0, 1e-14);

  const Eigen::MatrixXd jacobian = dense(linear.jacobian), of_whole = whole.jacobian();
  const Eigen::VectorXd gradient = whole.gradient();
  std::size_t row_of_whole = 0;
  for (std::size_t r = 0; r < part.rows.size(); ++r) {
    const auto same = [&](const Row& row) {
      return row.kind == part.rows[r].kind && row.statement == part.rows[r].statement &&
             (row.time == part.rows[r].time || std::isnan(row.time));
    };
    while (!same(whole.t.rows[row_of_whole])) ++row_of_whole;
    EXPECT_NEAR(values.residual[r], whole.values.residual[row_of_whole], 1e-14);
    for (const int u : layout.free) {
      int of = u - part.first_functional() + whole.t.first_functional();
      for (int dof = 0; dof < 2; ++dof) {
        if (part.first[dof] <= u && u < part.first[dof + 1]) of = u - part.origin(dof) + whole.t.origin(dof);
      }
      EXPECT_NEAR(jacobian(layout.of_row[r], layout.of_unknown[u]), of_whole(row_of_whole, of), 1e-14);
      EXPECT_NEAR(linear.gradient[layout.of_unknown[u]], gradient[of], 1e-12);
    }
    ++row_of_whole;
  }
}

TEST(Window, ParametersAreData) {
  const std::string scene = head + "parameter p = 0.25\nconstrain x = p at 1\nwindow [0.4, 1.6]\nsolve\n";
  const Motion held = run_scene(scene);
  EXPECT_EQ(held.status, Status::converged) << held.message;
  EXPECT_EQ(held.parameters.at(0).second, 0.25);
  const Motion freed = run_scene(scene + "window all\nsolve\n");
  EXPECT_EQ(freed.status, Status::converged) << freed.message;
  EXPECT_NE(freed.parameters.at(0).second, 0.25);
}

// Over all there is, in pieces that overlap, a chain comes to the same end as the whole.
TEST(Window, AChainApproachesTheWhole) {
  const std::string scene = head + "constrain x = 1 at 0, 1, 2\nconstrain y = x at 0.5\n";
  std::string chain = scene + "iterate 1\n";
  for (int round = 0; round < 12; ++round) {
    for (const char* window : {"[0, 1]", "[0.3, 1.3]", "[0.7, 1.7]", "[1, 2]"}) {
      chain += std::string("window ") + window + "\niterate 4\n";
    }
  }
  const double whole = run_scene(scene).objective, pieces = run_scene(chain).objective;
  EXPECT_GT(pieces, whole - 1e-9);
  EXPECT_NEAR(pieces, whole, 1e-3 * std::abs(whole));
}

TEST(Window, Refusals) {
  const auto message = [](const std::string& actions) -> std::string {
    try {
      run_scene(head + actions);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  // The language refuses a window that does not meet the time; a message may bring one.
  Problem problem = problem_of(head);
  problem.actions = {{Window{Interval{{3, {}, 0}, {4, {}, 0}}, {}}, {8, 1}}};
  try {
    run(problem, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "line 8: the window [3, 4] does not meet the animation's time, [0, 2]");
  }
  EXPECT_NE(message("window [0.5, 0.8]\nsolve\n").find("nothing is free in the window"), std::string::npos);
  EXPECT_NE(message("window [0.5, 1]\ncontrol x 0 = 1\n").find("coefficient 0 of 'x' is not free in the window"),
            std::string::npos);
}

double value_of(const Motion& motion, int dof, double t) {
  const Trajectory& trajectory = motion.dofs[dof];
  return value(trajectory.basis, trajectory.coefficients, t);
}

// The largest distance of hand and ball around the release, between instances too.
double largest_gap(const Motion& motion) {
  double largest = 0;
  for (int k = 0; k <= 400; ++k) {
    const double t = 0.7 + 0.001 * k;
    const double upper = value_of(motion, 0, t) - std::numbers::pi / 2;
    const double fore = upper + value_of(motion, 1, t), palm = fore + value_of(motion, 2, t);
    const double x = 0.5 * std::cos(upper) + 0.4 * std::cos(fore) + 0.2 * std::cos(palm);
    const double y = 0.5 * std::sin(upper) + 0.4 * std::sin(fore) + 0.2 * std::sin(palm);
    largest = std::max(largest, std::hypot(x - value_of(motion, 3, t), y - value_of(motion, 4, t)));
  }
  return largest;
}

// [Cohen 1992, section 5.1]
TEST(Window, TightensTheGripAtLeastTwentyfold) {
  const std::string scene = file_text("examples/throw_window.scene");
  const Motion coarse = run_scene(scene.substr(0, scene.find("refine"))), tight = run_scene(scene);
  EXPECT_EQ(coarse.status, Status::converged) << coarse.message;
  EXPECT_EQ(tight.status, Status::converged) << tight.message;
  EXPECT_LE(tight.violation, 1e-8);
  EXPECT_LT(20 * largest_gap(tight), largest_gap(coarse));
}

}  // namespace
}  // namespace spacetime::optimizer
