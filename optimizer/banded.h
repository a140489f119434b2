// Symmetric matrices of an iteration, and their LDL^T factorisation without pivoting.
//
//   [ D  A    ]      D: diagonal, k x k; A: sparse, within the columns of K
//   [ A^T K  B^T ]   K: n x n, entries within `width` of the diagonal, but for a few long rows
//   [     B  C   ]   B: m x n, C: m x m, dense, m small
//
// They are eliminated in this order.  D makes limits and soft rows, which come by the dozen a knot span, cost no band;
// long rows make coarse curves beside fine ones cost none: a coefficient that touches a hundred times as many
// others as its neighbours stands after them all, and its row alone is long.  (George and Liu 1981, §4: envelopes.)
// A factorisation costs n width^2 + the length of long rows times width, so it is linear in the animation's length.
// Positions are K's, then the border's, then D's.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace spacetime::optimizer {

// Where a matrix may have entries.
struct Pattern {
  // Entries (row, from) ... (row, row - width - 1), from far[offset] on.
  struct LongRow {
    int row, from;
    std::size_t offset;
  };

  int n = 0, width = 0, m = 0;
  std::vector<LongRow> long_rows;  // by rising `row`
  std::vector<int> start{0};       // of row r of A: its columns are column[start[r]] ... column[start[r + 1] - 1]
  std::vector<int> column;

  int sparse_rows() const { return static_cast<int>(start.size()) - 1; }
  int size() const { return n + m + sparse_rows(); }
  std::size_t far_entries() const;
  const LongRow* long_row(int row) const;  // nothing where the row is within the band
};

struct BorderedMatrix {
  std::shared_ptr<const Pattern> pattern;
  int n = 0, width = 0, m = 0;                                                    // the pattern's
  std::vector<double> band;                                                       // lower: (i, j) at j*(width+1) + i-j
  std::vector<double> far;                                                        // of long rows
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> border;  // m x (n + m): [B C]
  std::vector<double> sparse, diagonal;                                           // A and D

  BorderedMatrix() = default;
  explicit BorderedMatrix(std::shared_ptr<const Pattern> pattern);

  int size() const { return n + m + static_cast<int>(diagonal.size()); }
  void set_zero();
  BorderedMatrix& operator+=(const BorderedMatrix& other);  // of the same pattern
  double on_diagonal(int k) const;
  double at(int i, int j) const;  // 0 where the pattern has no entry

  // Adds to the entries (i, j) and (j, i), which the pattern must have unless the value is 0.
  void add(int i, int j, double value) {
    const int high = i > j ? i : j, low = i > j ? j : i;
    if (high < n && high - low <= width) {
      band[static_cast<std::size_t>(low) * (width + 1) + (high - low)] += value;
    } else if (value != 0) {
      add_beyond(high, low, value);
    }
  }

 private:
  void add_beyond(int high, int low, double value);  // outside the band
};

// Calls visit(i, j, value) for every entry of the lower triangle that may be nonzero, by reference.
template <typename Matrix, typename Visit>
void for_each_entry(Matrix& matrix, Visit visit) {
  const Pattern& p = *matrix.pattern;
  for (int j = 0; j < p.n; ++j) {
    auto* column = matrix.band.data() + static_cast<std::ptrdiff_t>(j) * (p.width + 1);
    for (int k = 0; k <= p.width && j + k < p.n; ++k) visit(j + k, j, column[k]);
  }
  for (const auto& [row, from, offset] : p.long_rows) {
    for (int j = from; j < row - p.width; ++j) visit(row, j, matrix.far[offset + (j - from)]);
  }
  for (int i = 0; i < p.m; ++i) {
    for (int j = 0; j <= p.n + i; ++j) visit(p.n + i, j, matrix.border(i, j));
  }
  for (int r = 0; r < p.sparse_rows(); ++r) {
    for (int e = p.start[r]; e < p.start[r + 1]; ++e) visit(p.n + p.m + r, p.column[e], matrix.sparse[e]);
    visit(p.n + p.m + r, p.n + p.m + r, matrix.diagonal[r]);
  }
}

// y = M x
Eigen::VectorXd multiply(const BorderedMatrix& matrix, const Eigen::VectorXd& x);

class Factorisation {
 public:
  // False where a pivot vanishes or is not finite.
  bool compute(const BorderedMatrix& matrix);

  // Numbers of negative eigenvalues (Sylvester's law of inertia: the signs of the pivots, and of the eigenvalues of the
  // border's Schur complement).
  int negative() const { return negative_; }

  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

 private:
  bool condense();
  bool factor_border(const BorderedMatrix& matrix);
  void solve_band(double* x) const;

  BorderedMatrix l_;  // unit lower triangle below, pivots on the diagonal; border: B K^-1; A and D as given
  Eigen::MatrixXd schur_vectors_;  // S = V diag(values) V^T
  Eigen::VectorXd schur_values_;
  int negative_ = 0;
};

}  // namespace spacetime::optimizer
