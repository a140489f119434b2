// The judge is itself judged, against values from an independent implementation in another language.
#include "tests/optimizer/judge.h"

#include <gtest/gtest.h>

#include "tests/optimizer/reference.h"

namespace spacetime::optimizer {
namespace {

void expect_reference(const judge::Throw& problem, const nlohmann::json& expected) {
  const Eigen::VectorXd x = test_point(judge::unknowns(problem)), d = test_direction(x.size());
  const Eigen::VectorXd lambda = test_multipliers(judge::rows(problem));
  const judge::Point point = judge::evaluate(problem, x);
  const double energy = expected["J"];
  EXPECT_NEAR(point.objective, energy, 1e-12 * energy);
  EXPECT_LE(relative_difference(point.gradient, vector_of(expected["grad"])), 1e-11);
  EXPECT_LE(relative_difference(point.hessian * d, vector_of(expected["Hd"])), 1e-11);
  EXPECT_LE(relative_difference(point.constraints, vector_of(expected["con"])), 1e-12);
  EXPECT_LE(relative_difference(point.jacobian * d, vector_of(expected["A_d"])), 1e-12);
  EXPECT_LE(relative_difference(point.jacobian.transpose() * lambda, vector_of(expected["At_lam"])), 1e-12);
  EXPECT_LE(relative_difference(judge::row_curvature(problem, x, lambda) * d, vector_of(expected["con_hess_d"])),
            1e-12);
}

TEST(Judge, AgreesWithTheReferenceOnP94) {
  expect_reference(judge::p94, reference("eval_vectors.json")["P94"]["x_test"]);
}

TEST(Judge, AgreesWithTheReferenceOnP92) {
  expect_reference(judge::p92, reference("eval_vectors.json")["P92"]["x_test"]);
}

TEST(Judge, KnowsTheMinimaOfP94R) {
  const auto coefficients = reference("p94r_coefs.json"), results = reference("p94r_results.json");
  for (const char* start : {"S0", "S1", "S2", "S3"}) {
    const auto verdict = judge::judge(judge::p94r, vector_of(coefficients[std::string("P94R_") + start]));
    const auto& expected = results[start];
    EXPECT_NEAR(verdict.objective, expected["J"].get<double>(), 1e-9 * verdict.objective) << start;
    EXPECT_LE(verdict.violation, 1e-11) << start;
    EXPECT_LE(verdict.kkt, 1e-9) << start;
    EXPECT_EQ(verdict.rank, 14) << start;
    EXPECT_NEAR(verdict.curvature, expected["min_red_eig"].get<double>(), 1e-5) << start;
  }
}

TEST(Judge, KnowsTheOptimaOfP92AndTheirRank) {
  const auto coefficients = reference("solve_coefs.json");
  const auto verdict = judge::judge(judge::p92, vector_of(coefficients["P92_S0"]));
  EXPECT_NEAR(verdict.objective, 36.769257080791, 1e-9);
  EXPECT_LE(verdict.violation, 1e-11);
  EXPECT_LE(verdict.kkt, 1e-9);
  EXPECT_EQ(verdict.rank, 56);
  EXPECT_GT(verdict.curvature, 0);
}

// A judge that accepts everything would be of no use.
TEST(Judge, RefusesWhatIsNoOptimum) {
  const auto coefficients = reference("p94r_coefs.json");
  Eigen::VectorXd x = vector_of(coefficients["P94R_S0"]);
  x[100] += 1e-3;
  const auto moved = judge::judge(judge::p94r, x);
  EXPECT_GT(moved.kkt, 1e-4);
  x[0] += 1e-6;
  EXPECT_GT(judge::judge(judge::p94r, x).violation, 5e-7);

  // Far from any optimum the Lagrangian bends downwards somewhere.
  EXPECT_LT(judge::judge(judge::p94, test_point(judge::unknowns(judge::p94))).curvature, 0);
}

TEST(Judge, KnowsTorquesOfLongerChains) {
  const auto rows = reference("eval_vectors.json")["nlink"]["rows"];
  ASSERT_EQ(rows.size(), 12U);
  for (const auto& row : rows) {
    const Eigen::Index n = row["n"];
    const auto along = [&](auto f) {
      return Eigen::VectorXd::NullaryExpr(n, [f](Eigen::Index k) { return f(double(k) + 1); });
    };
    const Eigen::VectorXd q = along([](double k) { return std::sin(k); });
    const Eigen::VectorXd rate = along([](double k) { return 2 * std::cos(1.3 * k); });
    const Eigen::VectorXd acceleration = along([](double k) { return 5 * std::sin(0.7 * k + 1); });
    const auto tau = judge::torques(Eigen::VectorXd::Constant(n, 0.3), Eigen::VectorXd::Ones(n), q, rate, acceleration);
    EXPECT_LE(relative_difference(tau, vector_of(row["tau"])), 1e-12) << n << " links";
  }
}

}  // namespace
}  // namespace spacetime::optimizer
