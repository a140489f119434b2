#include "optimizer/bfgs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/diagnostic.h"
#include "optimizer/wolfe.h"

namespace spacetime::optimizer {
namespace {

// Largest change of a coefficient in one step (rad or m): without it the first steps, along a gradient of thousands,
// leave every basin.
constexpr double longest_step = 0.6;

// H is dense: at this size 200 MB, and a tenth of a second an update.
constexpr int most_unknowns = 5000;

// Curvature along the step below this fraction of its size gives no update: it is rounding, or F is not convex there.
constexpr double least_curvature = 1e-12;

}  // namespace

Bfgs::Bfgs(const Transcription& transcription, const Layout& layout, BfgsOptions options)
    : t_(transcription), options_(options), penalty_(transcription, layout, options.weight) {
  refuse_conditions(t_, "bfgs");
  if (penalty_.size() > most_unknowns) {
    throw InputError(
        fmt::format("the method 'bfgs' keeps a dense matrix and takes at most {} unknowns; there are {}. "
                    "Use fewer spans, or the method 'newton'",
                    most_unknowns, penalty_.size()));
  }
}

BfgsState Bfgs::start(const std::vector<double>& x) {
  BfgsState state;
  const Stopwatch watch(state.seconds.evaluate);
  state.point = penalty_.at(x);
  state.inverse = Eigen::MatrixXd::Identity(penalty_.size(), penalty_.size());
  if (options_.diagonal_start && state.point.finite) {
    const Eigen::VectorXd curvature = penalty_.curvature(state.point);
    const double least = least_curvature * curvature.maxCoeff();
    if (least > 0) state.inverse.diagonal() = curvature.cwiseMax(least).cwiseInverse();
  }
  judge(state);
  return state;
}

BfgsState Bfgs::resume(const std::vector<double>& x, const std::vector<double>& inverse) {
  BfgsState state;
  const Stopwatch watch(state.seconds.evaluate);
  state.point = penalty_.settled_at(x);
  state.inverse = Eigen::MatrixXd::Identity(penalty_.size(), penalty_.size());
  auto next = inverse.begin();
  for (int i = 0; i < penalty_.size(); ++i) {
    for (int j = 0; j <= i; ++j) state.inverse(i, j) = *next++;
  }
  judge(state);
  return state;
}

// The multipliers that go with a point are what the penalty pulls with, 2 w c: the gradient of the Lagrangian is F's.
void Bfgs::judge(BfgsState& state) const {
  const PenaltyPoint& point = state.point;
  state.x = point.x;
  state.values = point.values;
  state.multipliers.assign(t_.rows.size(), 0.0);
  state.measures = {};
  state.measures.violation = point.violation;
  if (point.gradient.size() > 0) {
    state.measures.stationarity = point.gradient.cwiseAbs().maxCoeff() / std::max(1.0, point.objective_size);
  }
}

StepResult Bfgs::step(BfgsState& state, double tolerance) {
  if (!state.point.finite) return StepResult::not_finite;
  if (state.measures.within(tolerance)) return StepResult::converged;
  state.at_minimum = state.measures.stationarity <= tolerance;
  if (state.at_minimum) return StepResult::exhausted;

  const auto h = state.inverse.selfadjointView<Eigen::Lower>();
  Eigen::VectorXd d;
  {
    const Stopwatch watch(state.seconds.factor);
    d = -(h * state.point.gradient);
  }
  const LinePoint start{0, state.point.value, state.point.gradient.dot(d)};
  const double longest = std::min(longest_step / d.cwiseAbs().maxCoeff(), penalty_.most_length(d));
  PenaltyPoint there;
  const auto phi = [&](double length) {
    const Stopwatch watch(state.seconds.evaluate);
    there = penalty_.at(penalty_.moved(state.x, length * d));
    if (!there.finite) return LinePoint{length, INFINITY, NAN};
    return LinePoint{length, there.value, there.gradient.dot(d)};
  };
  const auto found = wolfe_search(phi, start, 1, longest, rounding * std::abs(start.value));
  if (!found) return StepResult::exhausted;

  const Stopwatch watch(state.seconds.factor);
  const Eigen::VectorXd delta = found->length * d, gamma = there.gradient - state.point.gradient;
  const double curvature = delta.dot(gamma);
  if (curvature > least_curvature * delta.norm() * gamma.norm()) {
    // Both terms of the update as one symmetric product  delta u' + u delta'.
    const Eigen::VectorXd image = h * gamma;
    const Eigen::VectorXd u = (1 + gamma.dot(image) / curvature) / (2 * curvature) * delta - image / curvature;
    state.inverse.selfadjointView<Eigen::Lower>().rankUpdate(delta, u);
  }
  state.step = delta.cwiseAbs().maxCoeff();
  state.point = std::move(there);
  judge(state);
  return StepResult::stepped;
}

std::string Bfgs::ending(const BfgsState& state) const {
  const std::string_view how = state.at_minimum ? "The penalty function is at its minimum"
                                                : "Rounding hides any further decrease of the penalty function";
  return fmt::format(
      "{}, {:.6g} with w = {:.3g}, which leaves violations of about a multiplier over 2 w; "
      "its gradient is at {:.3g} of the objective's",
      how, state.point.value, options_.weight, state.measures.stationarity);
}

}  // namespace spacetime::optimizer
