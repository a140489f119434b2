// The independent reference values in tests/reference, for tests of the optimizer.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {

inline nlohmann::json reference(const std::string& file) {
  return nlohmann::json::parse(file_text("tests/reference/" + file));
}

inline Eigen::VectorXd vector_of(const nlohmann::json& numbers) {
  const auto listed = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(listed.data(), static_cast<Eigen::Index>(listed.size()));
}

// The formulas of eval_vectors.json.
inline Eigen::VectorXd test_point(Eigen::Index n) {
  return Eigen::VectorXd::NullaryExpr(
      n, [](Eigen::Index i) { return 0.8 * std::sin(0.37 * double(i)) + 0.3 * std::cos(1.1 * double(i)); });
}
inline Eigen::VectorXd test_direction(Eigen::Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(0.7 * double(i) + 0.3); });
}
inline Eigen::VectorXd test_multipliers(Eigen::Index n) {
  return Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index k) { return std::cos(double(k) + 1); });
}

// The largest difference, over the largest component of what was expected.
inline double relative_difference(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  EXPECT_EQ(found.size(), expected.size());
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace spacetime::optimizer
