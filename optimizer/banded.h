// Symmetric matrices with a band and a dense border, and their LDL^T factorisation without pivoting.
//
//   [ K  B^T ]   K: n x n, entries only within `width` of the diagonal
//   [ B  C   ]   B: m x n, C: m x m, dense, m small
//
// The cost of a factorisation is n * width^2 + n * width * m, linear in the length of the animation.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace spacetime::optimizer {

struct BorderedMatrix {
  int n = 0, width = 0, m = 0;
  std::vector<double> band;                                                       // lower: (i, j) at j*(width+1) + i-j
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> border;  // m x (n + m): [B C]

  BorderedMatrix() = default;
  BorderedMatrix(int n, int width, int m);

  int size() const { return n + m; }
  void set_zero();
  double at_diagonal(int j) const { return band[static_cast<std::size_t>(j) * (width + 1)]; }     // j < n
  double& at(int i, int j) { return band[static_cast<std::size_t>(j) * (width + 1) + (i - j)]; }  // j <= i < n

  // Adds to the entries (i, j) and (j, i), anywhere.
  void add(int i, int j, double value);
};

// y = M x
Eigen::VectorXd multiply(const BorderedMatrix& matrix, const Eigen::VectorXd& x);

// LDL^T of the band and of the border's Schur complement S = C - B K^-1 B^T.
class Factorisation {
 public:
  // False where a pivot vanishes or is not finite.
  bool compute(const BorderedMatrix& matrix);

  // Numbers of negative eigenvalues (Sylvester's law of inertia: the signs of the pivots, and of S's eigenvalues).
  int negative() const { return negative_; }

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  void solve_band(double* x) const;

  BorderedMatrix l_;               // unit lower triangle below, pivots on the diagonal; border: B K^-1
  Eigen::MatrixXd schur_vectors_;  // S = V diag(values) V^T
  Eigen::VectorXd schur_values_;
  int negative_ = 0;
};

}  // namespace spacetime::optimizer
