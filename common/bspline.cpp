#include "common/bspline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "common/assert.h"

namespace spacetime {
namespace {

constexpr int degree = 3;

// The last knot interval [u[j], u[j+1]) that is not empty and begins at or before t.
int interval(const Basis& basis, double t) {
  const auto& u = basis.knots;
  const double slack = 1e-9 * (u.back() - u.front());  // s; rounding in a caller's times, not a licence to extrapolate
  SPACETIME_ASSERT(t >= u.front() - slack && t <= u.back() + slack);
  const auto last = u.end() - (degree + 1);
  return static_cast<int>(std::upper_bound(u.begin() + degree + 1, last, t) - u.begin()) - 1;
}

// The normal equations of a fit: a symmetric matrix of half-bandwidth three, by rows of its lower triangle.
struct Banded {
  std::vector<std::array<double, degree + 1>> row;  // row[i][k] = A(i, i - k)
};

// A = L D L^T in place (D on the diagonal, L below it).  A must be positive definite.
void factorise(Banded& A) {
  const int n = static_cast<int>(A.row.size());
  for (int i = 0; i < n; ++i) {
    for (int k = std::min(i, degree); k >= 0; --k) {
      const int j = i - k;
      double sum = A.row[i][k];
      for (int m = std::max({0, i - degree, j - degree}); m < j; ++m) {
        sum -= A.row[i][i - m] * A.row[m][0] * A.row[j][j - m];
      }
      A.row[i][k] = k == 0 ? sum : sum / A.row[j][0];
    }
  }
}

void solve(const Banded& A, std::vector<double>& x) {
  const int n = static_cast<int>(A.row.size());
  for (int i = 0; i < n; ++i) {
    for (int k = 1; k <= std::min(i, degree); ++k) x[i] -= A.row[i][k] * x[i - k];
  }
  for (int i = 0; i < n; ++i) x[i] /= A.row[i][0];
  for (int i = n - 1; i >= 0; --i) {
    for (int k = 1; k <= std::min(i, degree); ++k) x[i - k] -= A.row[i][k] * x[i];
  }
}

}  // namespace

Basis basis_on(std::span<const double> points) {
  SPACETIME_ASSERT(points.size() >= 2);
  SPACETIME_ASSERT(std::adjacent_find(points.begin(), points.end(), [](double x, double y) { return !(x < y); }) ==
                   points.end());
  Basis basis;
  basis.knots.assign(degree, points.front());
  basis.knots.insert(basis.knots.end(), points.begin(), points.end());
  basis.knots.insert(basis.knots.end(), degree, points.back());
  return basis;
}

Basis uniform_basis(double start, double end, int spans) {
  SPACETIME_ASSERT(start < end && spans >= 1);
  std::vector<double> points;
  points.reserve(spans + 1);
  for (int i = 0; i < spans; ++i) points.push_back(start + (end - start) * i / spans);
  points.push_back(end);  // exactly
  return basis_on(points);
}

std::vector<double> breakpoints(const Basis& basis) {
  auto points = basis.knots;
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

BasisValues basis_values(const Basis& basis, double t) {
  const auto& u = basis.knots;
  const int j = interval(basis, t);

  // The Cox-de Boor recurrence, one degree after another: B[p][k] is B_{j-p+k, p}(t), k = 0..p.
  //   B_{i,p} = (t - u[i]) / (u[i+p] - u[i]) B_{i,p-1}  +  (u[i+p+1] - t) / (u[i+p+1] - u[i+1]) B_{i+1,p-1}
  std::array<std::array<double, degree + 1>, degree + 1> B{};
  B[0][0] = 1;
  for (int p = 1; p <= degree; ++p) {
    for (int k = 0; k < p; ++k) {  // B_{i,p-1} goes into B_{i,p} and B_{i-1,p}
      const int i = j - p + 1 + k;
      const double share = B[p - 1][k] / (u[i + p] - u[i]);
      B[p][k] += (u[i + p] - t) * share;
      B[p][k + 1] += (t - u[i]) * share;
    }
  }

  // d/dt B_{i,p} = p (B_{i,p-1} / (u[i+p] - u[i])  -  B_{i+1,p-1} / (u[i+p+1] - u[i+1])), applied d times.
  BasisValues result;
  result.first = j - degree;
  result.b[0] = B[degree];
  for (int d = 1; d <= max_derivative; ++d) {
    auto D = B[degree - d];
    for (int p = degree - d + 1; p <= degree; ++p) {
      std::array<double, degree + 1> raised{};
      for (int k = 0; k < p; ++k) {
        const int i = j - p + 1 + k;
        const double share = p * D[k] / (u[i + p] - u[i]);
        raised[k] -= share;
        raised[k + 1] += share;
      }
      D = raised;
    }
    result.b[d] = D;
  }
  return result;
}

double value(const Basis& basis, std::span<const double> coefficients, double t, int derivative) {
  SPACETIME_ASSERT(derivative >= 0 && derivative <= max_derivative);
  SPACETIME_ASSERT(static_cast<int>(coefficients.size()) == basis.size());
  const auto at = basis_values(basis, t);
  double sum = 0;
  for (int k = 0; k <= degree; ++k) sum += at.b[derivative][k] * coefficients[at.first + k];
  return sum;
}

std::vector<double> greville(const Basis& basis) {
  const auto& u = basis.knots;
  std::vector<double> times(basis.size());
  for (int k = 0; k < basis.size(); ++k) times[k] = (u[k + 1] + u[k + 2] + u[k + 3]) / 3;
  times.front() = u.front();  // exactly, whatever the division rounds to
  times.back() = u.back();
  return times;
}

// Minimises sum_s (B(t_s) c - v_s)^2.  Where the times leave some combination of coefficients free, a very weak pull
// towards small second differences settles it; two refinements against the true residual take the pull out of
// everything that the times do settle.
std::vector<double> fit(const Basis& basis, std::span<const double> times, std::span<const double> values) {
  SPACETIME_ASSERT(times.size() == values.size() && !times.empty());
  const int n = basis.size();
  std::vector<double> c(n, 0.0);
  bool pinned_start = false, pinned_end = false;
  std::vector<BasisValues> rows;
  rows.reserve(times.size());
  Banded A{std::vector<std::array<double, degree + 1>>(n)};
  for (std::size_t s = 0; s < times.size(); ++s) {
    const auto& at = rows.emplace_back(basis_values(basis, times[s]));
    for (int i = 0; i <= degree; ++i) {
      for (int k = 0; k <= i; ++k) A.row[at.first + i][k] += at.b[0][i] * at.b[0][i - k];
    }
    if (times[s] == basis.knots.front() && !pinned_start) pinned_start = true, c.front() = values[s];
    if (times[s] == basis.knots.back() && !pinned_end) pinned_end = true, c.back() = values[s];
  }
  constexpr double pull = 1e-10;  // relative to a coefficient's weight of about one time; far above rounding
  for (int i = 2; i < n; ++i) {
    const double difference[] = {1, -2, 1};
    for (int p = 0; p < 3; ++p) {
      for (int q = 0; q <= p; ++q) A.row[i - 2 + p][p - q] += pull * difference[p] * difference[q];
    }
  }
  // A coefficient that is pinned becomes an equation of its own: the corrections below leave it alone.
  const auto pin = [&](int i) {
    for (int k = 1; k <= std::min(i, degree); ++k) A.row[i][k] = 0;
    for (int k = 1; k <= degree && i + k < n; ++k) A.row[i + k][k] = 0;
    A.row[i][0] = 1;
  };
  if (pinned_start) pin(0);
  if (pinned_end) pin(n - 1);
  factorise(A);

  for (int pass = 0; pass < 3; ++pass) {
    std::vector<double> step(n, 0.0);
    for (std::size_t s = 0; s < rows.size(); ++s) {
      double residual = values[s];
      for (int k = 0; k <= degree; ++k) residual -= rows[s].b[0][k] * c[rows[s].first + k];
      for (int k = 0; k <= degree; ++k) step[rows[s].first + k] += rows[s].b[0][k] * residual;
    }
    if (pinned_start) step.front() = 0;
    if (pinned_end) step.back() = 0;
    solve(A, step);
    for (int i = 0; i < n; ++i) c[i] += step[i];
  }
  return c;
}

// A new coefficient is the old curve's polar form at its three inner knots.
std::vector<double> insert_knots(Basis& basis, std::span<const double> c, std::span<const double> times) {
  const auto& u = basis.knots;
  SPACETIME_ASSERT(static_cast<int>(c.size()) == basis.size());
  std::vector<double> v;
  v.reserve(u.size() + times.size());
  std::ranges::merge(u, times, std::back_inserter(v));
  std::vector<double> d(v.size() - degree - 1);
  int span = 0;  // of the old knots: u[span] <= v[k] < u[span + 1]
  for (int k = 0; k < static_cast<int>(d.size()); ++k) {
    while (u[span + 1] <= v[k]) ++span;
    int kept = span - degree;
    while (kept <= span && !std::equal(&u[kept + 1], &u[kept + 1] + degree, &v[k + 1])) ++kept;
    if (kept <= span) {
      d[k] = c[kept];
      continue;
    }
    std::array<double, degree + 1> p;
    for (int i = 0; i <= degree; ++i) p[i] = c[span - degree + i];
    for (int r = 1; r <= degree; ++r) {
      for (int i = degree; i >= r; --i) {
        const int j = span - degree + i;
        const double a = (v[k + r] - u[j]) / (u[j + degree + 1 - r] - u[j]);
        p[i] = (1 - a) * p[i - 1] + a * p[i];
      }
    }
    d[k] = p[degree];
  }
  basis.knots = std::move(v);
  return d;
}

}  // namespace spacetime
