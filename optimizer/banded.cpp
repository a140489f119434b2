#include "optimizer/banded.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "optimizer/clones.h"

namespace spacetime::optimizer {
namespace {

// Factorises in place, column by column: after column j, l(i, j) = k(i, j) / d(j) and the trailing block has
// k(i, k) -= l(i, j) d(j) l(k, j).  Returns the number of negative pivots, or -1 where one vanishes.
SPACETIME_CLONES int factor_band(double* band, int n, int width) {
  const std::ptrdiff_t step = width + 1;
  int negative = 0;
  for (int j = 0; j < n; ++j) {
    double* column = band + j * step;
    const double pivot = column[0];
    if (!(std::abs(pivot) > 1e-300) || !std::isfinite(pivot)) return -1;
    negative += pivot < 0;
    const double inverse = 1 / pivot;
    const int below = j + width < n ? width : n - 1 - j;
    for (int k = 1; k <= below; ++k) {
      const double l = column[k] * inverse;
      if (l == 0) continue;
      double* target = band + (j + k) * step;
      const double* source = column + k;
      const int length = below - k;
      for (int i = 0; i <= length; ++i) target[i] -= l * source[i];
    }
    for (int k = 1; k <= below; ++k) column[k] *= inverse;
  }
  return negative;
}

SPACETIME_CLONES void forward(const double* band, int n, int width, double* x) {
  for (int j = 0; j < n; ++j) {
    const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    const double value = x[j];
    for (int k = 1; k <= below; ++k) x[j + k] -= column[k] * value;
  }
}

void backward(const double* band, int n, int width, double* x) {
  for (int j = n - 1; j >= 0; --j) {
    const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    double sum = x[j];
    for (int k = 1; k <= below; ++k) sum -= column[k] * x[j + k];
    x[j] = sum;
  }
}

}  // namespace

BorderedMatrix::BorderedMatrix(int n_, int width_, int m_)
    : n(n_), width(width_), m(m_), band(static_cast<std::size_t>(n_) * (width_ + 1)), border(m_, n_ + m_) {
  border.setZero();
}

void BorderedMatrix::set_zero() {
  std::fill(band.begin(), band.end(), 0.0);
  border.setZero();
}

void BorderedMatrix::add(int i, int j, double value) {
  if (i < j) std::swap(i, j);
  if (i < n) {
    at(i, j) += value;
    return;
  }
  border(i - n, j) += value;
  if (j >= n && i != j) border(j - n, i) += value;
}

Eigen::VectorXd multiply(const BorderedMatrix& matrix, const Eigen::VectorXd& x) {
  const int n = matrix.n, m = matrix.m, width = matrix.width;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n + m);
  for (int j = 0; j < n; ++j) {
    const double* column = matrix.band.data() + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    double sum = column[0] * x[j];
    for (int k = 1; k <= below; ++k) {
      sum += column[k] * x[j + k];
      y[j + k] += column[k] * x[j];
    }
    y[j] += sum;
  }
  if (m > 0) {
    y.head(n).noalias() += matrix.border.leftCols(n).transpose() * x.tail(m);
    y.tail(m).noalias() += matrix.border * x;
  }
  return y;
}

void Factorisation::solve_band(double* x) const {
  forward(l_.band.data(), l_.n, l_.width, x);
  for (int j = 0; j < l_.n; ++j) x[j] /= l_.band[static_cast<std::size_t>(j) * (l_.width + 1)];
  backward(l_.band.data(), l_.n, l_.width, x);
}

bool Factorisation::compute(const BorderedMatrix& matrix) {
  l_ = matrix;
  negative_ = factor_band(l_.band.data(), l_.n, l_.width);
  if (negative_ < 0) return false;
  const int n = l_.n, m = l_.m;
  if (m == 0) return true;

  // Row k of B K^-1; then S = C - (B K^-1) B^T.
  for (int k = 0; k < m; ++k) solve_band(&l_.border(k, 0));
  Eigen::MatrixXd schur = matrix.border.rightCols(m) - l_.border.leftCols(n) * matrix.border.leftCols(n).transpose();
  schur = (0.5 * (schur + schur.transpose())).eval();
  if (!schur.allFinite()) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(schur);
  schur_vectors_ = eigen.eigenvectors();
  schur_values_ = eigen.eigenvalues();
  if (!(schur_values_.cwiseAbs().minCoeff() > 1e-300)) return false;
  negative_ += static_cast<int>((schur_values_.array() < 0).count());
  return true;
}

Eigen::VectorXd Factorisation::solve(const Eigen::VectorXd& right) const {
  const int n = l_.n, m = l_.m;
  Eigen::VectorXd x = right;
  if (m > 0) {
    // S x2 = r2 - B K^-1 r1;  K x1 = r1 - B^T x2, with K^-1 B^T kept.
    const Eigen::VectorXd reduced = right.tail(m) - l_.border.leftCols(n) * right.head(n);
    x.tail(m) = schur_vectors_ * (schur_vectors_.transpose() * reduced).cwiseQuotient(schur_values_);
  }
  solve_band(x.data());
  if (m > 0) x.head(n).noalias() -= l_.border.leftCols(n).transpose() * x.tail(m);
  return x;
}

}  // namespace spacetime::optimizer
