#include "optimizer/limits.h"

#include <algorithm>
#include <cmath>

namespace spacetime::optimizer {
namespace {

// A start is pushed this far inside its bounds: of their distance, and of max(1, |bound|) where there is only one.
constexpr double push = 1e-2;

// A limit that is met by less than this starts with this slack, in units of max(1, |c|).
constexpr double least_slack = 1e-2;

// A step keeps at least 1 - this of its distance to every limit.
constexpr double least_fraction = 0.99;

// Multipliers stay within this factor of mu / slack.
constexpr double most_ratio = 1e10;

// Multipliers of an earlier solve are taken over within this factor of mu / slack.
constexpr double carried_ratio = 1e3;

double fraction(double mu) { return std::max(least_fraction, 1 - mu); }

// The largest length up to 1 with value + length * change >= (1 - fraction) value, value being positive.
double longest(double value, double change, double fraction, double so_far) {
  return change < 0 ? std::min(so_far, -fraction * value / change) : so_far;
}

}  // namespace

Limits::Limits(const Transcription& t, const Layout& layout) : size_(layout.size()) {
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    if (t.rows[r].kind == Row::Kind::hard && t.rows[r].at_most) rows_.push_back(layout.of_row[r]);
  }
  for (int u = 0; u < t.unknowns(); ++u) {
    const auto bound = [&](double value) {
      const double margin = push * std::min(std::max(1.0, std::abs(value)), t.upper[u] - t.lower[u]);
      return Bound{u, layout.of_unknown[u], value, margin};
    };
    if (std::isfinite(t.lower[u])) lower_.push_back(bound(t.lower[u]));
    if (std::isfinite(t.upper[u])) upper_.push_back(bound(t.upper[u]));
  }
}

void Limits::push_inside(std::vector<double>& x, double part) const {
  for (const Bound& b : lower_) x[b.unknown] = std::max(x[b.unknown], b.value + part * b.margin);
  for (const Bound& b : upper_) x[b.unknown] = std::min(x[b.unknown], b.value - part * b.margin);
}

void Limits::carry(const Carried& carried, const Layout& layout, const Eigen::VectorXd& c, const std::vector<double>& x,
                   Barrier& barrier) const {
  const double mu = barrier.mu;
  const auto fitting = [&](double dual, double room) {
    return std::clamp(dual, mu / (carried_ratio * room), carried_ratio * mu / room);
  };
  for (std::size_t r = 0; r < carried.dual.size(); ++r) {
    const int k = layout.of_row[r];
    const double dual = carried.dual[r];
    if (dual <= 0 || barrier.dual[k] <= 0) continue;
    // A limit that was far from its multiplier's scale keeps the slack of a first start.
    const double slack = std::max(-c[k], mu / dual);
    if (slack > barrier.slack[k] && -c[k] < barrier.slack[k]) continue;
    barrier.slack[k] = slack;
    barrier.dual[k] = fitting(dual, slack);
  }
  for (const Bound& b : lower_) {
    const double dual = carried.lower_dual[b.unknown];
    if (dual > 0) barrier.lower_dual[b.position] = fitting(dual, x[b.unknown] - b.value);
  }
  for (const Bound& b : upper_) {
    const double dual = carried.upper_dual[b.unknown];
    if (dual > 0) barrier.upper_dual[b.position] = fitting(dual, b.value - x[b.unknown]);
  }
}

Barrier Limits::start(const std::vector<double>& x, const Eigen::VectorXd& c, double mu) const {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
  Barrier barrier{none() ? 0 : mu, zero, zero, zero, zero};
  for (const int k : rows_) {
    barrier.slack[k] = std::max(-c[k], least_slack * std::max(1.0, std::abs(c[k])));
    barrier.dual[k] = mu / barrier.slack[k];
  }
  for (const Bound& b : lower_) barrier.lower_dual[b.position] = mu / (x[b.unknown] - b.value);
  for (const Bound& b : upper_) barrier.upper_dual[b.position] = mu / (b.value - x[b.unknown]);
  return barrier;
}

Eigen::VectorXd Limits::diagonal(const std::vector<double>& x, const Barrier& barrier) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size_);
  for (const int k : rows_) result[k] = -barrier.slack[k] / barrier.dual[k];
  for (const Bound& b : lower_) result[b.position] += barrier.lower_dual[b.position] / (x[b.unknown] - b.value);
  for (const Bound& b : upper_) result[b.position] += barrier.upper_dual[b.position] / (b.value - x[b.unknown]);
  return result;
}

Eigen::VectorXd Limits::gradient(const std::vector<double>& x, const Barrier& barrier) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(size_);
  for (const Bound& b : lower_) result[b.position] -= barrier.mu / (x[b.unknown] - b.value);
  for (const Bound& b : upper_) result[b.position] += barrier.mu / (b.value - x[b.unknown]);
  return result;
}

Eigen::VectorXd Limits::pull(const Barrier& barrier) const { return barrier.upper_dual - barrier.lower_dual; }

Eigen::VectorXd Limits::right(const Eigen::VectorXd& c, const Barrier& barrier) const {
  // From c + A d + s + ds = 0 and s lambda+ + lambda ds = mu:  A d - (s/lambda) lambda+ = -(c + s + mu/lambda)
  Eigen::VectorXd result = c;
  for (const int k : rows_) result[k] += barrier.slack[k] + barrier.mu / barrier.dual[k];
  return result;
}

double Limits::value(const std::vector<double>& x, const Barrier& barrier) const {
  double sum = 0;
  for (const int k : rows_) sum += std::log(barrier.slack[k]);
  for (const Bound& b : lower_) sum += std::log(x[b.unknown] - b.value);
  for (const Bound& b : upper_) sum += std::log(b.value - x[b.unknown]);
  return -barrier.mu * sum;
}

Limits::Change Limits::change(const std::vector<double>& x, const Barrier& barrier, const Eigen::VectorXd& c,
                              const Eigen::VectorXd& slope, const Eigen::VectorXd& solution) const {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(size_);
  Change change{zero, zero, zero, zero, 1, 1};
  const double keep = fraction(barrier.mu);
  for (const int k : rows_) {
    change.slack[k] = -(c[k] + barrier.slack[k]) - slope[k];
    change.dual[k] = solution[k] - barrier.dual[k];
    change.most_primal = longest(barrier.slack[k], change.slack[k], keep, change.most_primal);
    change.most_dual = longest(barrier.dual[k], change.dual[k], keep, change.most_dual);
  }
  for (const Bound& b : lower_) {
    const double room = x[b.unknown] - b.value, z = barrier.lower_dual[b.position], d = solution[b.position];
    change.lower_dual[b.position] = (barrier.mu - z * d) / room - z;
    change.most_primal = longest(room, d, keep, change.most_primal);
    change.most_dual = longest(z, change.lower_dual[b.position], keep, change.most_dual);
  }
  for (const Bound& b : upper_) {
    const double room = b.value - x[b.unknown], z = barrier.upper_dual[b.position], d = solution[b.position];
    change.upper_dual[b.position] = (barrier.mu + z * d) / room - z;
    change.most_primal = longest(room, -d, keep, change.most_primal);
    change.most_dual = longest(z, change.upper_dual[b.position], keep, change.most_dual);
  }
  return change;
}

double Limits::gap(const std::vector<double>& x, const Barrier& barrier, double mu) const {
  double sum = 0;
  const auto count = [&](double room, double dual) { sum += std::abs(room * dual - mu); };
  for (const int k : rows_) count(barrier.slack[k], barrier.dual[k]);
  for (const Bound& b : lower_) count(x[b.unknown] - b.value, barrier.lower_dual[b.position]);
  for (const Bound& b : upper_) count(b.value - x[b.unknown], barrier.upper_dual[b.position]);
  return sum;
}

void Limits::widen(Barrier& barrier, const Eigen::VectorXd& c) const {
  for (const int k : rows_) barrier.slack[k] = std::max(barrier.slack[k], -c[k]);
}

void Limits::guard(const std::vector<double>& x, Barrier& barrier) const {
  const auto clamped = [&](double dual, double room) {
    return std::clamp(dual, barrier.mu / (most_ratio * room), most_ratio * barrier.mu / room);
  };
  for (const int k : rows_) barrier.dual[k] = clamped(barrier.dual[k], barrier.slack[k]);
  for (const Bound& b : lower_) {
    barrier.lower_dual[b.position] = clamped(barrier.lower_dual[b.position], x[b.unknown] - b.value);
  }
  for (const Bound& b : upper_) {
    barrier.upper_dual[b.position] = clamped(barrier.upper_dual[b.position], b.value - x[b.unknown]);
  }
}

}  // namespace spacetime::optimizer
