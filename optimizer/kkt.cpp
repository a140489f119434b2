#include "optimizer/kkt.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cmath>

namespace spacetime::optimizer {
namespace {

// Regularisation of unknowns, relative to the mean curvature: gives a pivot to what no term of the objective moves.
constexpr double unknown_regularisation = 1e-9;

// Likewise of limits and soft rows: what they pull on unknowns stays within so many times their own curvature, or the
// digits of everything else would be lost in it.
constexpr double compliant_regularisation = 1e-10;

// The least curvature of an unknown that counts in a row's size, relative to the mean.
constexpr double least_curvature = 1e-6;

// Regularisation of hard rows, relative to the row's size A W^-1 A^T; a row whose size is below `row_floor` of the
// largest counts as that large, so that a vanishing gradient (an arm that hangs straight) asks for no endless step.
constexpr double row_regularisation = 1e-8;
constexpr double row_floor = 1e-8;

// Inertia correction: the shift's unit is this fraction of the mean curvature; the first try, its growth, its decay.
constexpr double shift_unit = 1e-3;
constexpr double first_shift = 1e-2, least_shift = 1e-4, most_shift = 1e12;
constexpr double first_growth = 10, growth = 3;

// A row that is not wanted takes no part: so compliant that it asks nothing.
constexpr double unasked = 1e30;

// Refinement ends when the residual is this small against the right side, or stops falling by half.
constexpr double small_residual = 1e-13, acceptable_residual = 1e-6;
constexpr int max_refinements = 8;

// A factorisation without pivoting can lose its digits where a leading block is nearly singular, which refinement
// tells.  A stronger shift moves away from there; after so many attempts a pivoted solve takes over.
constexpr int max_attempts = 4;

}  // namespace

Kkt::Kkt(const Transcription& t, const Layout& layout)
    : role_(layout.size(), Role::unknown), rows_(static_cast<int>(t.rows.size())) {
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const bool compliant = t.rows[r].kind == Row::Kind::soft || t.rows[r].at_most;
    role_[layout.of_row[r]] = compliant ? Role::compliant : Role::equation;
    any_compliant_ |= compliant;
  }
}

// For each hard row, the sum of A_ri^2 / diagonal_i.
Eigen::VectorXd Kkt::row_sizes(const BorderedMatrix& jacobian, const Eigen::VectorXd& diagonal) const {
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(jacobian.size());
  for_each_entry(jacobian, [&](int i, int j, double a) {
    if (a == 0 || i == j) return;
    if (is_row(i)) {
      sizes[i] += a * a / diagonal[j];
    } else {
      sizes[j] += a * a / diagonal[i];
    }
  });
  // Without any gradient there is nothing to compare with.
  const double largest = sizes.maxCoeff();
  return sizes.cwiseMax(largest > 0 ? row_floor * largest : 1.0);
}

// What soft rows and limits pull on an unknown: A_ri^2 / E_r each.
Eigen::VectorXd Kkt::pulled_curvature(const BorderedMatrix& jacobian, const Eigen::VectorXd& diagonal) const {
  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(jacobian.size());
  for_each_entry(jacobian, [&](int i, int j, double a) {
    if (a == 0 || i == j) return;
    if (role_[i] == Role::compliant) curvature[j] -= a * a / diagonal[i];
    if (role_[j] == Role::compliant) curvature[i] -= a * a / diagonal[j];
  });
  return curvature;
}

// The matrix without shift and regularisation, and what regularisation is to be.
void Kkt::assemble(const Linearisation& linear, const Eigen::VectorXd& diagonal) {
  exact_ = linear.hessian;
  exact_ += linear.jacobian;

  Eigen::VectorXd curvature = Eigen::VectorXd::Zero(exact_.size());
  double sum = 0;
  for (int k = 0; k < exact_.size(); ++k) {
    curvature[k] = std::abs(linear.hessian.on_diagonal(k));
    sum += curvature[k];
  }
  const int unknowns = exact_.size() - rows_;
  const double mean = sum > 0 ? sum / unknowns : 1;
  scale_ = shift_unit * mean;
  for (int k = 0; k < exact_.size(); ++k) {
    if (role_[k] == Role::unknown) curvature[k] = std::max(curvature[k] + diagonal[k], least_curvature * mean);
    exact_.add(k, k, diagonal[k]);
  }

  const Eigen::VectorXd unpulled = row_sizes(linear.jacobian, curvature);
  const Eigen::VectorXd sizes =
      any_compliant_ ? row_sizes(linear.jacobian, curvature + pulled_curvature(linear.jacobian, diagonal)) : unpulled;
  vanishing_.resize(exact_.size());
  for (int k = 0; k < exact_.size(); ++k) {
    if (role_[k] == Role::unknown) vanishing_[k] = unknown_regularisation * mean;
    if (role_[k] == Role::equation) vanishing_[k] = -row_regularisation * sizes[k];
    if (role_[k] == Role::compliant) vanishing_[k] = -compliant_regularisation * unpulled[k];
  }
}

bool Kkt::regularise_and_factor(double shift) {
  regular_ = exact_;
  for (int k = 0; k < regular_.size(); ++k) {
    regular_.add(k, k, vanishing_[k] + (role_[k] == Role::unknown ? shift * scale_ : 0.0));
  }
  return factorisation_.compute(regular_);
}

std::optional<double> Kkt::factor(double hint, double at_least) {
  double shift = at_least;
  const double from = std::max(hint > 0 ? std::max(hint / growth, least_shift) : first_shift, 2 * at_least);
  for (double next = from;; next *= hint > 0 ? growth : first_growth) {
    if (regularise_and_factor(shift) && factorisation_.negative() == rows_) break;
    if (next > most_shift) return std::nullopt;
    shift = next;
  }
  shift_ = shift;
  return shift;
}

std::optional<Kkt::Step> Kkt::step(const Linearisation& linear, const Eigen::VectorXd& diagonal,
                                   const Eigen::VectorXd& right, double hint) {
  assemble(linear, diagonal);
  double at_least = 0;
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    const auto shift = factor(hint, at_least);
    if (!shift) return std::nullopt;
    if (auto solution = solve(right)) return Step{std::move(*solution), *shift};
    at_least = std::max(first_growth * *shift, hint > 0 ? std::max(hint / growth, least_shift) : least_shift);
  }
  ++pivoted_;
  auto solution = solve_pivoted(right);
  if (!solution) return std::nullopt;
  return Step{std::move(*solution), at_least / first_growth};
}

std::optional<Eigen::VectorXd> Kkt::least_squares_multipliers(const Linearisation& linear,
                                                              const Eigen::VectorXd& gradient) {
  // [ I  A^T ] [ y      ]     [ gradient ]
  // [ A  0   ] [ lambda ] = - [ 0        ],   soft rows and limits left out
  exact_ = linear.jacobian;
  for_each_entry(exact_, [&](int i, int j, double& a) {
    if (role_[i] == Role::compliant || role_[j] == Role::compliant) a = 0;
  });
  for (int i = 0; i < exact_.m; ++i) {  // the upper triangle of the border's block
    for (int j = i + 1; j < exact_.m; ++j) exact_.border(i, exact_.n + j) = exact_.border(j, exact_.n + i);
  }
  vanishing_ = -row_regularisation * row_sizes(exact_, Eigen::VectorXd::Ones(exact_.size()));
  Eigen::VectorXd right = -gradient;
  for (int k = 0; k < exact_.size(); ++k) {
    if (role_[k] != Role::unknown) right[k] = 0;
    if (role_[k] != Role::equation) {
      exact_.add(k, k, 1);
      vanishing_[k] = 0;
    }
  }
  shift_ = 0;
  if (!regularise_and_factor(0)) return std::nullopt;
  return solve(right);
}

Eigen::VectorXd Kkt::row_sizes(const BorderedMatrix& jacobian) const {
  return row_sizes(jacobian, Eigen::VectorXd::Ones(jacobian.size()));
}

bool Kkt::factor_feasibility(const Linearisation& linear, const Eigen::VectorXd& wanted, const Eigen::VectorXd& sizes,
                             double damping) {
  exact_ = linear.jacobian;
  for (int k = 0; k < exact_.size(); ++k) {
    exact_.add(k, k, role_[k] == Role::unknown ? 1 : wanted[k] != 0 ? -damping * sizes[k] : -unasked);
  }
  vanishing_ = Eigen::VectorXd::Zero(exact_.size());
  shift_ = 0;
  return regularise_and_factor(0);
}

bool Kkt::factor_feasibility(const Linearisation& linear, const BorderedMatrix& curvature,
                             const Eigen::VectorXd& wanted, const Eigen::VectorXd& sizes, double damping) {
  exact_ = linear.jacobian;
  exact_ += curvature;
  for (int k = 0; k < exact_.size(); ++k) {
    exact_.add(k, k, role_[k] == Role::unknown ? damping : wanted[k] != 0 ? -sizes[k] : -unasked);
  }
  vanishing_ = Eigen::VectorXd::Zero(exact_.size());
  shift_ = 0;
  return regularise_and_factor(0) && factorisation_.negative() == rows_;
}

std::optional<Eigen::VectorXd> Kkt::solve(const Eigen::VectorXd& right) const {
  // The rows' residual may be impossible to remove (rows that contradict one another); the unknowns' must vanish.
  const auto size_of = [&](const Eigen::VectorXd& residual) {
    double largest = 0;
    for (int k = 0; k < residual.size(); ++k) {
      if (role_[k] == Role::unknown) largest = std::max(largest, std::abs(residual[k]));
    }
    return largest;
  };
  const double unit = right.cwiseAbs().maxCoeff();
  // The shift is meant: refinement must not take it back.
  const auto product = [&](const Eigen::VectorXd& v) {
    Eigen::VectorXd result = multiply(exact_, v);
    for (int k = 0; shift_ > 0 && k < v.size(); ++k) {
      if (role_[k] == Role::unknown) result[k] += shift_ * scale_ * v[k];
    }
    return result;
  };
  Eigen::VectorXd x = factorisation_.solve(right);
  Eigen::VectorXd residual = right - product(x);
  double all = residual.cwiseAbs().maxCoeff();
  for (int k = 0; k < max_refinements && all > small_residual * unit; ++k) {
    const Eigen::VectorXd better = x + factorisation_.solve(residual);
    const Eigen::VectorXd remaining = right - product(better);
    const double now = remaining.cwiseAbs().maxCoeff();
    if (!(now < all)) break;
    const bool slow = now > all / 2;
    x = better;
    residual = remaining;
    all = now;
    if (slow) break;
  }
  if (!x.allFinite() || !(size_of(residual) <= acceptable_residual * unit)) return std::nullopt;
  return x;
}

// Last resort: a sparse LU with pivoting of the matrix as it was regularised.
std::optional<Eigen::VectorXd> Kkt::solve_pivoted(const Eigen::VectorXd& right) const {
  std::vector<Eigen::Triplet<double>> entries;
  for_each_entry(regular_, [&](int i, int j, double value) {
    if (value == 0) return;
    entries.emplace_back(i, j, value);
    if (i != j) entries.emplace_back(j, i, value);
  });
  Eigen::SparseMatrix<double> sparse(regular_.size(), regular_.size());
  sparse.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(sparse);
  if (lu.info() != Eigen::Success) return std::nullopt;
  Eigen::VectorXd x = lu.solve(right);
  if (!x.allFinite()) return std::nullopt;
  return x;
}

}  // namespace spacetime::optimizer
