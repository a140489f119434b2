// Objective, constraints and derivatives of the throws, from scene text through transcription, against values from an
// independent implementation.
#include <gtest/gtest.h>

#include "tests/optimizer/evaluated.h"
#include "tests/optimizer/reference.h"

namespace spacetime::optimizer {
namespace {

constexpr double agreement = 1e-9;  // relative to the largest component

// Where the rows of the scenes stand in the reference's order.  `rest` has, for each end, q1 q2 q3 and then their
// rates (as one statement or two); the reference has q1(0) q1(T) q2(0) ..., then the rates.
std::vector<int> order_of_p94() {
  std::vector<int> order;
  for (int d = 0; d < 2; ++d) {
    for (int end = 0; end < 2; ++end) {
      for (int dof = 0; dof < 3; ++dof) order.push_back(6 * d + 2 * dof + end);
    }
  }
  order.insert(order.end(), {12, 13});
  return order;
}
std::vector<int> order_of_p92() {
  std::vector<int> order;
  for (int end = 0; end < 2; ++end) {
    for (int d = 0; d < 2; ++d) {
      for (int dof = 0; dof < 3; ++dof) order.push_back(6 * d + 2 * dof + end);
    }
  }
  for (int k = 0; k < 12; ++k) order.insert(order.end(), {40 + k, 52 + k});
  for (int k = 0; k < 26; ++k) order.push_back(12 + k);
  order.insert(order.end(), {38, 39});
  return order;
}

void expect_reference(const std::string& scene, const std::vector<int>& order, const nlohmann::json& expected) {
  const Problem problem = problem_of(scene);
  Evaluated e(problem);
  ASSERT_EQ(e.t.rows.size(), order.size());
  const Eigen::VectorXd x = test_point(e.t.unknowns()), d = test_direction(x.size());
  const Eigen::VectorXd lambda = test_multipliers(static_cast<Eigen::Index>(order.size()));
  e.at(x);

  const double energy = expected["J"];
  EXPECT_NEAR(e.values.objective, energy, agreement * energy);
  EXPECT_LE(relative_difference(e.of_unknowns(e.linear.gradient), vector_of(expected["grad"])), agreement);
  EXPECT_EQ(e.of_rows(e.linear.gradient).cwiseAbs().maxCoeff(), 0);
  EXPECT_LE(
      relative_difference(e.of_unknowns(multiply(e.linear.hessian, e.unknowns_placed(d))), vector_of(expected["Hd"])),
      agreement);

  Eigen::VectorXd constraints(lambda.size()), a_d(lambda.size());
  const Eigen::VectorXd found = e.of_rows(multiply(e.linear.jacobian, e.unknowns_placed(d)));
  for (std::size_t r = 0; r < order.size(); ++r) {
    constraints[order[r]] = e.values.residual[r];
    a_d[order[r]] = found[static_cast<Eigen::Index>(r)];
  }
  EXPECT_LE(relative_difference(constraints, vector_of(expected["con"])), agreement);
  EXPECT_LE(relative_difference(a_d, vector_of(expected["A_d"])), agreement);

  const Eigen::VectorXd ours = lambda(order);
  EXPECT_LE(relative_difference(e.of_unknowns(multiply(e.linear.jacobian, e.rows_placed(ours))),
                                vector_of(expected["At_lam"])),
            agreement);

  e.linear.hessian.set_zero();
  e.add_curvature(ours);
  EXPECT_LE(relative_difference(e.of_unknowns(multiply(e.linear.hessian, e.unknowns_placed(d))),
                                vector_of(expected["con_hess_d"])),
            agreement);
}

TEST(EvaluationReference, P94) {
  expect_reference(file_text("examples/throw_eliminated.scene"), order_of_p94(),
                   reference("eval_vectors.json")["P94"]["x_test"]);
}

TEST(EvaluationReference, P92) {
  expect_reference(file_text("tests/golden/p92.scene"), order_of_p92(),
                   reference("eval_vectors.json")["P92"]["x_test"]);
}

TEST(EvaluationReference, P94AtTheStarts) {
  const Problem problem = problem_of(file_text("examples/throw_eliminated.scene"));
  const auto expected = reference("eval_vectors.json")["P94"], coefficients = reference("solve_coefs.json");
  const auto order = order_of_p94();
  Evaluated e(problem);
  for (const char* start : {"S0", "S1", "S2", "S3"}) {
    SCOPED_TRACE(start);
    const auto& here = expected[start];
    e.at(vector_of(coefficients[std::string("P94_start_") + start]));
    const double energy = here["J"];
    EXPECT_NEAR(e.values.objective, energy, agreement * std::max(energy, 1e-3));
    const Eigen::VectorXd gradient = vector_of(here["grad"]);
    EXPECT_LE((e.of_unknowns(e.linear.gradient) - gradient).cwiseAbs().maxCoeff(),
              agreement * std::max(gradient.cwiseAbs().maxCoeff(), 1.0));
    for (std::size_t r = 0; r < order.size(); ++r) {
      EXPECT_NEAR(e.values.residual[r], here["con"][static_cast<std::size_t>(order[r])].get<double>(), agreement);
    }
    for (int k = 0; k < 2; ++k) {
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(14);
      unit[12 + k] = 1;
      const double norm = e.of_unknowns(multiply(e.linear.jacobian, e.rows_placed(unit))).norm();
      EXPECT_NEAR(norm, here["throw_jac_norms"][static_cast<std::size_t>(k)].get<double>(), agreement);
    }
  }
}

// The same arm on 16 to 4096 spans.
TEST(EvaluationReference, GrowthInTime) {
  const std::string scene = file_text("examples/throw_eliminated.scene");
  const auto rows = reference("eval_vectors.json")["Nscaling"]["rows"];
  ASSERT_EQ(rows.size(), 5U);
  for (const auto& row : rows) {
    const int spans = row["N"];
    SCOPED_TRACE(spans);
    const Problem problem = problem_of(with_spans(scene, spans));
    Evaluated e(problem);
    const int n = spans + 3;
    Eigen::VectorXd x(3 * n);
    for (int k = 0; k < n; ++k) {
      const double s = double(k) / n;
      x[k] = std::sin(3 * s);
      x[n + k] = 0.5 * std::cos(5 * s);
      x[2 * n + k] = 0.7 * std::sin(4 * s + 1);
    }
    e.at(x);
    const double energy = row["J"], norm = row["grad_norm"];
    EXPECT_NEAR(e.values.objective, energy, agreement * energy);
    EXPECT_NEAR(e.linear.gradient.norm(), norm, agreement * norm);
  }
}

std::string chain(int links) {
  std::string text = "time [0, 2]\ntrajectory bspline spans 16\ncreature chain {\n  gravity (0, -9.81, 0)\n";
  for (int k = 1; k <= links; ++k) {
    const std::string own = std::to_string(k);
    text += "  link part" + own + " { revolute q" + own + (k == 1 ? "; offset -pi/2" : "") + "; a 0.3; mass 1; rod }\n";
  }
  return text + "}\nminimize energy: integral(dot(chain.force, chain.force))\n";
}

// Sums of the band's and the border's squares, each off-diagonal entry counted twice.
double frobenius(const BorderedMatrix& matrix) {
  double squares = 0;
  for_each_entry(matrix, [&](int i, int j, double entry) { squares += (i == j ? 1 : 2) * entry * entry; });
  return std::sqrt(squares);
}

TEST(EvaluationReference, GrowthInLinks) {
  const auto rows = reference("eval_vectors.json")["nlink"]["rows"];
  ASSERT_EQ(rows.size(), 12U);
  for (const auto& row : rows) {
    const int links = row["n"];
    SCOPED_TRACE(links);
    const Problem problem = problem_of(chain(links));
    Evaluated e(problem);
    e.at(test_point(e.t.unknowns()));
    const double energy = row["P94style_N16_J"], norm = row["grad_norm"], size = row["H_fro"];
    EXPECT_NEAR(e.values.objective, energy, agreement * energy);
    EXPECT_NEAR(e.linear.gradient.norm(), norm, agreement * norm);
    EXPECT_NEAR(frobenius(e.linear.hessian), size, agreement * size);
  }
}

}  // namespace
}  // namespace spacetime::optimizer
