#include "optimizer/sqp92.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimizer/conjugate.h"

namespace spacetime::optimizer {
namespace {

// Sufficient decrease of the merit function, and the shortest step tried [Nocedal and Wright 2006, algorithm 18.3].
constexpr double sufficient_decrease = 1e-4, shortest_step = 1e-10;

// A soft inequality that is met: so compliant that it asks nothing.
constexpr double inert = 1e30;

// Conjugate gradients: the residual of the normal equations, and the most iterations, in units of the system's size.
// Exact arithmetic would take one round; at condition numbers of 1e12 and more, squared, rounding asks for many.
constexpr double cg_tolerance = 1e-12;
constexpr int cg_rounds = 100;

// Curvatures below this fraction of the mean, and rows smaller than this (after scaling), are not scaled up further.
constexpr double least_curvature = 1e-3, least_row = 1e-6;

// The correction of the Hessian, in units of its mean diagonal: the first try, its growth, and the last.
constexpr double first_shift = 1e-4, shift_growth = 10, most_shift = 1e8;

}  // namespace

Sqp92::Sqp92(const Transcription& transcription, const Layout& layout, bool linear_cg)
    : t_(transcription), layout_(layout), linear_cg_(linear_cg), kkt_(transcription, layout) {
  refuse_conditions(t_, "sqp92");
  refuse_limits(t_, "sqp92");
}

Sqp92State Sqp92::start(std::vector<double> x) {
  settle_functionals(t_, x, workspace_);
  const std::vector<double> zero(t_.rows.size(), 0.0);
  return resume(std::move(x), zero, zero);
}

Sqp92State Sqp92::resume(std::vector<double> x, std::vector<double> multipliers, const std::vector<double>& weights) {
  Sqp92State state;
  state.x = std::move(x);
  state.multipliers = std::move(multipliers);
  state.merit_weights = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) state.merit_weights[layout_.of_row[r]] = weights[r];
  state.linear = start_linearisation(layout_);
  {
    const Stopwatch watch(state.seconds.evaluate);
    state.values = evaluate(t_, state.x, workspace_);
  }
  judge(state);
  return state;
}

// Derivatives and measures at state.x.
void Sqp92::judge(Sqp92State& state) {
  const Stopwatch watch(state.seconds.evaluate);
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values);
  state.condition = StepResult::not_finite;
  state.measures = {};
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (is_hard(r)) state.measures.violation = std::max(state.measures.violation, std::abs(state.values.residual[r]));
  }
  if (!state.values.finite) return;
  linearise(t_, layout_, state.x, workspace_, state.linear);
  const Eigen::VectorXd of_soft = soft_weights(t_, layout_, c).cwiseProduct(c);
  Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (is_hard(r)) multipliers[layout_.of_row[r]] = state.multipliers[r];
  }
  state.gradient = state.linear.gradient + multiply(state.linear.jacobian, of_soft);
  const Eigen::VectorXd pulled = state.gradient + multiply(state.linear.jacobian, multipliers);
  state.measures.stationarity = stationarity_of(layout_, pulled, state.gradient);
  add_row_curvature(t_, layout_, state.x, state.values, state.multipliers, workspace_, state.linear);
  if (state.gradient.allFinite() && std::isfinite(state.measures.stationarity)) state.condition = StepResult::stepped;
}

std::optional<Sqp92::Direction> Sqp92::factored(Sqp92State& state) {
  const Stopwatch watch(state.seconds.factor);
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values), weights = soft_weights(t_, layout_, c);
  Eigen::VectorXd right = state.linear.gradient + c, diagonal = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (is_hard(r)) continue;
    const int k = layout_.of_row[r];
    diagonal[k] = weights[k] > 0 ? -1 / weights[k] : -inert;
    if (weights[k] == 0) right[k] = 0;
  }
  auto step = kkt_.step(state.linear, diagonal, -right, 0);
  if (!step) return std::nullopt;
  Direction result{step->solution, step->solution, step->shift};
  for (int k = 0; k < layout_.size(); ++k) (kkt_.is_row(k) ? result.d : result.multipliers)[k] = 0;
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (!is_hard(r)) result.multipliers[layout_.of_row[r]] = 0;
  }
  return result;
}

// What brings the system's rows and columns to one size: 1 / sqrt |W_ii| at unknowns, after that 1 / |A_i| at
// equations; 0 at soft rows, whose part is in W.
Eigen::VectorXd Sqp92::scales(const Sqp92State& state, double mean) const {
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(layout_.size());
  for (const int u : layout_.free) {
    const int k = layout_.of_unknown[u];
    scale[k] = 1 / std::sqrt(std::max(std::abs(state.linear.hessian.on_diagonal(k)), least_curvature * mean));
  }
  const Eigen::VectorXd of_unknowns = scale;
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (!is_hard(r)) continue;
    const int k = layout_.of_row[r];
    const Eigen::VectorXd row = multiply(state.linear.jacobian, Eigen::VectorXd::Unit(layout_.size(), k));
    scale[k] = 1 / std::max(row.cwiseProduct(of_unknowns).norm(), least_row);
  }
  return scale;
}

std::optional<Sqp92::Direction> Sqp92::conjugate(Sqp92State& state) const {
  const Stopwatch watch(state.seconds.factor);
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values), weights = soft_weights(t_, layout_, c);
  Eigen::VectorXd unknown = Eigen::VectorXd::Zero(layout_.size());  // 1 there
  double mean = 0;
  for (const int u : layout_.free) {
    const int k = layout_.of_unknown[u];
    unknown[k] = 1;
    mean += std::abs(state.linear.hessian.on_diagonal(k)) / static_cast<double>(layout_.free.size());
  }
  if (mean == 0) mean = 1;
  const Eigen::VectorXd scale = scales(state, mean), row = Eigen::VectorXd::Ones(layout_.size()) - unknown;
  const Eigen::VectorXd right = -scale.cwiseProduct(state.gradient + row.cwiseProduct(c));

  for (double shift = 0; shift <= most_shift; shift = std::max(first_shift, shift_growth * shift)) {
    const auto product = [&](const Eigen::VectorXd& scaled) {
      const Eigen::VectorXd v = scale.cwiseProduct(scaled), d = unknown.cwiseProduct(v);
      const Eigen::VectorXd slope = multiply(state.linear.jacobian, d), pull = v - d + weights.cwiseProduct(slope);
      const Eigen::VectorXd top = multiply(state.linear.hessian, d) + multiply(state.linear.jacobian, pull);
      const Eigen::VectorXd all = unknown.cwiseProduct(top) + shift * mean * d + row.cwiseProduct(slope);
      return Eigen::VectorXd(scale.cwiseProduct(all));
    };
    const Eigen::VectorXd found =
        scale.cwiseProduct(least_squares_cg(product, right, cg_tolerance, cg_rounds * layout_.size()).solution);
    const Direction result{unknown.cwiseProduct(found), row.cwiseProduct(found), shift};
    const Eigen::VectorXd slope = multiply(state.linear.jacobian, result.d);
    const double curvature = result.d.dot(multiply(state.linear.hessian, result.d) + shift * mean * result.d) +
                             weights.dot(slope.cwiseAbs2());
    if (found.allFinite() && curvature >= 0) return result;
  }
  return std::nullopt;
}

StepResult Sqp92::step(Sqp92State& state, double tolerance) {
  if (state.condition != StepResult::stepped) return state.condition;
  if (state.measures.within(tolerance)) return StepResult::converged;
  const auto direction = linear_cg_ ? conjugate(state) : factored(state);
  if (!direction) return StepResult::singular;

  const Eigen::VectorXd& d = direction->d;
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values), slope = multiply(state.linear.jacobian, d);
  // w = max(|l+|, (w + |l+|) / 2), row by row.
  const Eigen::VectorXd size = direction->multipliers.cwiseAbs();
  state.merit_weights = size.cwiseMax((state.merit_weights + size) / 2);
  const auto violation = [&](const Eigen::VectorXd& residual) { return state.merit_weights.dot(residual.cwiseAbs()); };
  const double merit = state.values.objective + violation(c), noise = rounding * std::abs(merit);
  // The merit's slope along d, at most; a direction that is not exact may promise nothing.
  const double promised = std::min(0.0, state.gradient.dot(d) - (violation(c) - violation(c + slope)));
  const double longest = std::min(1.0, most_length(t_, layout_, d));
  for (double length = longest; length > shortest_step * longest; length /= 2) {
    std::vector<double> x = state.x;
    for (const int u : layout_.free) x[u] += length * d[layout_.of_unknown[u]];
    Values values;
    {
      const Stopwatch watch(state.seconds.evaluate);
      values = evaluate(t_, x, workspace_);
    }
    const double there = values.objective + violation(residual_of(t_, layout_, values));
    if (!values.finite || !(there <= merit + sufficient_decrease * length * promised + noise)) continue;
    state.x = std::move(x);
    state.values = std::move(values);
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      double& lambda = state.multipliers[r];
      if (is_hard(r)) lambda += length * (direction->multipliers[layout_.of_row[r]] - lambda);
    }
    state.step = length * d.cwiseAbs().maxCoeff();
    state.shift = direction->shift;
    judge(state);
    return StepResult::stepped;
  }
  return StepResult::exhausted;
}

}  // namespace spacetime::optimizer
