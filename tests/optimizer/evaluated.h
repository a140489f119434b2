// A problem at a point, with its derivatives in the order of unknowns and rows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {

inline Eigen::MatrixXd dense(const BorderedMatrix& matrix) {
  Eigen::MatrixXd all(matrix.size(), matrix.size());
  for (int k = 0; k < matrix.size(); ++k) all.col(k) = multiply(matrix, Eigen::VectorXd::Unit(matrix.size(), k));
  return all;
}

struct Evaluated {
  // The problem must outlive it.
  explicit Evaluated(const Problem& problem)
      : t(transcribe(problem)), layout(arrange(t)), linear(start_linearisation(layout)) {}

  void at(const Eigen::VectorXd& point) {
    x.assign(point.begin(), point.end());
    values = evaluate(t, x, workspace);
    linearise(t, layout, x, workspace, linear);
  }
  // Adds the curvature of the rows; the multipliers of soft rows are not read.
  void add_curvature(const Eigen::VectorXd& multipliers) {
    const std::vector<double> listed(multipliers.begin(), multipliers.end());
    add_row_curvature(t, layout, x, values, listed, workspace, linear);
  }

  int rows() const { return static_cast<int>(t.rows.size()); }
  Eigen::VectorXd residual() const { return Eigen::Map<const Eigen::VectorXd>(values.residual.data(), rows()); }
  Eigen::VectorXd gradient() const { return of_unknowns(linear.gradient); }
  Eigen::MatrixXd jacobian() const { return dense(linear.jacobian)(layout.of_row, layout.of_unknown); }
  Eigen::MatrixXd hessian() const { return dense(linear.hessian)(layout.of_unknown, layout.of_unknown); }

  // Between vectors in the positions of the KKT matrix and in the order of unknowns or rows.
  Eigen::VectorXd of_unknowns(const Eigen::VectorXd& positions) const { return positions(layout.of_unknown); }
  Eigen::VectorXd of_rows(const Eigen::VectorXd& positions) const { return positions(layout.of_row); }
  Eigen::VectorXd unknowns_placed(const Eigen::VectorXd& v) const { return placed(layout.of_unknown, v); }
  Eigen::VectorXd rows_placed(const Eigen::VectorXd& v) const { return placed(layout.of_row, v); }
  Eigen::VectorXd placed(const std::vector<int>& where, const Eigen::VectorXd& v) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(layout.size());
    all(where) = v;
    return all;
  }

  Transcription t;
  Layout layout;
  Linearisation linear;
  Workspace workspace;
  std::vector<double> x;
  Values values;
};

}  // namespace spacetime::optimizer
