#include "optimizer/banded.h"

#include <algorithm>

#include "optimizer/clones.h"

namespace spacetime::optimizer {
namespace {

// y += M x for the band.
SPACETIME_CLONES void multiply_band(const double* band, int n, int width, const double* x, double* y) {
  for (int j = 0; j < n; ++j) {
    const double* column = band + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    const double value = x[j];
    for (int k = 1; k <= below; ++k) y[j + k] += column[k] * value;
  }
}

}  // namespace

std::size_t Pattern::far_entries() const {
  if (long_rows.empty()) return 0;
  const auto& [row, from, offset] = long_rows.back();
  return offset + static_cast<std::size_t>(row - width - from);
}

const Pattern::LongRow* Pattern::long_row(int row) const {
  const auto found = std::ranges::lower_bound(long_rows, row, {}, &LongRow::row);
  return found != long_rows.end() && found->row == row ? &*found : nullptr;
}

BorderedMatrix::BorderedMatrix(std::shared_ptr<const Pattern> p)
    : pattern(std::move(p)),
      n(pattern->n),
      width(pattern->width),
      m(pattern->m),
      band(static_cast<std::size_t>(n) * (width + 1)),
      far(pattern->far_entries()),
      border(m, n + m),
      sparse(pattern->column.size()),
      diagonal(pattern->sparse_rows()) {
  border.setZero();
}

void BorderedMatrix::set_zero() {
  for (auto* part : {&band, &far, &sparse, &diagonal}) std::fill(part->begin(), part->end(), 0.0);
  border.setZero();
}

BorderedMatrix& BorderedMatrix::operator+=(const BorderedMatrix& other) {
  const auto add_all = [](std::vector<double>& to, const std::vector<double>& from) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] += from[k];
  };
  add_all(band, other.band);
  add_all(far, other.far);
  add_all(sparse, other.sparse);
  add_all(diagonal, other.diagonal);
  border += other.border;
  return *this;
}

double BorderedMatrix::on_diagonal(int k) const {
  if (k < n) return band[static_cast<std::size_t>(k) * (width + 1)];
  return k < n + m ? border(k - n, k) : diagonal[k - n - m];
}

double BorderedMatrix::at(int i, int j) const {
  if (i < j) std::swap(i, j);
  if (i == j) return on_diagonal(i);
  if (i < n && i - j <= width) return band[static_cast<std::size_t>(j) * (width + 1) + (i - j)];
  if (i < n) {
    const auto* row = pattern->long_row(i);
    return row && j >= row->from ? far[row->offset + (j - row->from)] : 0;
  }
  if (i < n + m) return border(i - n, j);
  for (int e = pattern->start[i - n - m]; e < pattern->start[i - n - m + 1]; ++e) {
    if (pattern->column[e] == j) return sparse[e];
  }
  return 0;
}

void BorderedMatrix::add_beyond(int i, int j, double value) {
  if (i < n) {
    const auto* row = pattern->long_row(i);
    far[row->offset + (j - row->from)] += value;
  } else if (i < n + m) {
    border(i - n, j) += value;
    if (j >= n && i != j) border(j - n, i) += value;
  } else if (i == j) {
    diagonal[i - n - m] += value;
  } else {
    int e = pattern->start[i - n - m];
    while (pattern->column[e] != j) ++e;
    sparse[e] += value;
  }
}

Eigen::VectorXd multiply(const BorderedMatrix& matrix, const Eigen::VectorXd& x) {
  const Pattern& p = *matrix.pattern;
  const int n = p.n, m = p.m, width = p.width;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(matrix.size());
  multiply_band(matrix.band.data(), n, width, x.data(), y.data());
  for (int j = 0; j < n; ++j) {
    const double* column = matrix.band.data() + static_cast<std::ptrdiff_t>(j) * (width + 1);
    const int below = j + width < n ? width : n - 1 - j;
    double sum = column[0] * x[j];
    for (int k = 1; k <= below; ++k) sum += column[k] * x[j + k];
    y[j] += sum;
  }
  for (const auto& [row, from, offset] : p.long_rows) {
    for (int j = from; j < row - width; ++j) {
      const double a = matrix.far[offset + (j - from)];
      y[row] += a * x[j];
      y[j] += a * x[row];
    }
  }
  if (m > 0) {
    y.head(n).noalias() += matrix.border.leftCols(n).transpose() * x.segment(n, m);
    y.segment(n, m).noalias() += matrix.border * x.head(n + m);
  }
  for (int r = 0; r < p.sparse_rows(); ++r) {
    const int position = n + m + r;
    double sum = matrix.diagonal[r] * x[position];
    for (int e = p.start[r]; e < p.start[r + 1]; ++e) {
      sum += matrix.sparse[e] * x[p.column[e]];
      y[p.column[e]] += matrix.sparse[e] * x[position];
    }
    y[position] = sum;
  }
  return y;
}

}  // namespace spacetime::optimizer
