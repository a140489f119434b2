// LDL^T: the sparse rows, the band with its long rows, the border.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "optimizer/banded.h"
#include "optimizer/clones.h"

namespace spacetime::optimizer {
namespace {

bool usable(double pivot) { return std::abs(pivot) > 1e-300 && std::isfinite(pivot); }

// y -= a x
inline void subtract(double a, const double* x, int count, double* y) {
  for (int k = 0; k < count; ++k) y[k] -= a * x[k];
}

// Where a long row's entry in column j stands: far from the diagonal, or within the band.
double& entry(double* band, int width, double* far, const Pattern::LongRow& row, int j) {
  return j < row.row - width ? far[row.offset + (j - row.from)]
                             : band[static_cast<std::ptrdiff_t>(j) * (width + 1) + (row.row - j)];
}

// Eliminates column j, whose pivot is `pivot`, from the long rows that have an entry there.
void eliminate_from_long_rows(const std::vector<const Pattern::LongRow*>& reached, double* band, int n, int width,
                              double* far, int j, double pivot) {
  const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
  const int below = j + width < n ? width : n - 1 - j;
  const auto in_column = [&](const Pattern::LongRow& row) -> double& { return far[row.offset + (j - row.from)]; };
  for (const auto* row : reached) {
    for (const auto* other : reached) {
      if (other->row >= row->row) continue;
      entry(band, width, far, *row, other->row) -= in_column(*row) / pivot * in_column(*other);
    }
  }
  for (const auto* row : reached) {
    const double a = in_column(*row);
    const double l = a / pivot;
    const int within = std::min(below, row->row - width - 1 - j);  // columns that stand far from the row's diagonal
    subtract(l, column + 1, within, far + row->offset + (j + 1 - row->from));
    for (int k = within + 1; k <= below; ++k) entry(band, width, far, *row, j + k) -= l * column[k];
    band[static_cast<std::ptrdiff_t>(row->row) * (width + 1)] -= l * a;
    in_column(*row) = l;
  }
}

// Factorises columns [from, to) in place: after column j, l(i, j) = k(i, j) / d(j) and the trailing block has
// k(i, k) -= l(i, j) d(j) l(k, j).  Returns the number of negative pivots, or -1 where one vanishes.
SPACETIME_CLONES int factor_columns(double* band, int n, int width, int from, int to) {
  const std::ptrdiff_t step = width + 1;
  int negative = 0;
  for (int j = from; j < to; ++j) {
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

int factor_band(BorderedMatrix& l) {
  const Pattern& p = *l.pattern;
  if (p.long_rows.empty()) return factor_columns(l.band.data(), p.n, p.width, 0, p.n);
  std::vector<const Pattern::LongRow*> waiting, reached;
  for (const auto& row : p.long_rows) waiting.push_back(&row);
  std::ranges::stable_sort(waiting, [](const auto* a, const auto* b) { return a->from > b->from; });
  int negative = 0;
  for (int j = 0; j < p.n;) {
    while (!waiting.empty() && waiting.back()->from == j) {
      reached.push_back(waiting.back());
      waiting.pop_back();
    }
    std::erase_if(reached, [&](const auto* row) { return row->row - p.width <= j; });
    int next = j + 1;
    if (reached.empty()) {
      next = waiting.empty() ? p.n : waiting.back()->from;
    } else {
      const double pivot = l.on_diagonal(j);
      if (!usable(pivot)) return -1;
      eliminate_from_long_rows(reached, l.band.data(), p.n, p.width, l.far.data(), j, pivot);
    }
    const int here = factor_columns(l.band.data(), p.n, p.width, j, next);
    if (here < 0) return -1;
    negative += here;
    j = next;
  }
  return negative;
}

SPACETIME_CLONES void forward(const double* band, int n, int width, int from, int to, double* x) {
  for (int j = from; j < to; ++j) {
    const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    const double value = x[j];
    for (int k = 1; k <= below; ++k) x[j + k] -= column[k] * value;
  }
}

// For the unknowns to - 1 down to `from`.
void backward(const double* band, int n, int width, int from, int to, double* x) {
  for (int j = to - 1; j >= from; --j) {
    const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    double sum = x[j];
    for (int k = 1; k <= below; ++k) sum -= column[k] * x[j + k];
    x[j] = sum;
  }
}

}  // namespace

void Factorisation::solve_band(double* x) const {
  const Pattern& p = *l_.pattern;
  const double* band = l_.band.data();
  int from = 0;
  for (const auto& row : p.long_rows) {
    forward(band, p.n, p.width, from, row.row, x);
    from = row.row;
    double sum = 0;
    for (int j = row.from; j < row.row - p.width; ++j) sum += l_.far[row.offset + (j - row.from)] * x[j];
    x[row.row] -= sum;
  }
  forward(band, p.n, p.width, from, p.n, x);
  for (int j = 0; j < p.n; ++j) x[j] /= band[static_cast<std::size_t>(j) * (p.width + 1)];
  int to = p.n;
  for (auto row = p.long_rows.rbegin(); row != p.long_rows.rend(); ++row) {
    backward(band, p.n, p.width, row->row, to, x);
    to = row->row;
    subtract(x[row->row], l_.far.data() + row->offset, row->row - p.width - row->from, x + row->from);
  }
  backward(band, p.n, p.width, 0, to, x);
}

// K -= A^T D^-1 A
bool Factorisation::condense() {
  const Pattern& p = *l_.pattern;
  for (int r = 0; r < p.sparse_rows(); ++r) {
    const double pivot = l_.diagonal[r];
    if (!usable(pivot)) return false;
    negative_ += pivot < 0;
    for (int e = p.start[r]; e < p.start[r + 1]; ++e) {
      const double scaled = l_.sparse[e] / pivot;
      for (int f = p.start[r]; f <= e; ++f) l_.add(p.column[e], p.column[f], -scaled * l_.sparse[f]);
    }
  }
  return true;
}

bool Factorisation::compute(const BorderedMatrix& matrix) {
  l_ = matrix;
  negative_ = 0;
  if (!condense()) return false;
  const int in_band = factor_band(l_);
  if (in_band < 0) return false;
  negative_ += in_band;
  return l_.m == 0 || factor_border(matrix);
}

bool Factorisation::factor_border(const BorderedMatrix& matrix) {
  // Row k of B K^-1; then S = C - (B K^-1) B^T.
  const int n = l_.n, m = l_.m;
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
  const Pattern& p = *l_.pattern;
  const int n = p.n, m = p.m;
  Eigen::VectorXd x = right;
  for (int r = 0; r < p.sparse_rows(); ++r) {
    x[n + m + r] /= l_.diagonal[r];
    for (int e = p.start[r]; e < p.start[r + 1]; ++e) x[p.column[e]] -= l_.sparse[e] * x[n + m + r];
  }
  if (m > 0) {
    // S x2 = r2 - B K^-1 r1;  K x1 = r1 - B^T x2, with K^-1 B^T kept.
    const Eigen::VectorXd reduced = x.segment(n, m) - l_.border.leftCols(n) * x.head(n);
    x.segment(n, m) = schur_vectors_ * (schur_vectors_.transpose() * reduced).cwiseQuotient(schur_values_);
  }
  solve_band(x.data());
  if (m > 0) x.head(n).noalias() -= l_.border.leftCols(n).transpose() * x.segment(n, m);
  for (int r = 0; r < p.sparse_rows(); ++r) {
    double sum = 0;
    for (int e = p.start[r]; e < p.start[r + 1]; ++e) sum += l_.sparse[e] * x[p.column[e]];
    x[n + m + r] -= sum / l_.diagonal[r];
  }
  return x;
}

}  // namespace spacetime::optimizer
