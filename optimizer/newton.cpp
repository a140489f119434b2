#include "optimizer/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace spacetime::optimizer {
namespace {

// The radius: where the model does not hold, no coefficient changes by more in one step.  Without it solutions hop
// between the many minima of a throw.  In the units of the degrees of freedom; it grows while steps go well, so other
// units cost a few iterations, not the solution.
constexpr double first_radius = 0.6;
constexpr double radius_growth = 2;

// The model holds for a step where the change of the Lagrangian is predicted to this fraction, and what remains of
// the violation is below this fraction of it.
constexpr double model_error = 0.1, violation_error = 0.1;
constexpr double good_model_error = 0.25;

// Line search: halvings of the step, sufficient decrease, and the switching condition of the filter method
// [Waechter and Biegler 2006, eq. 19 and 20].
constexpr double shortest_step = 1e-10;
constexpr double sufficient_decrease = 1e-4;
constexpr double switch_descent_power = 2.3, switch_violation_power = 1.1;
constexpr double most_violation_factor = 1e4, small_violation_factor = 1e-4;
constexpr double rounding = 1e-13;  // of the objective: differences below are noise
constexpr int corrections = 2;      // second-order corrections tried at full step

// The inertia correction decays by this after a step that needed none, and is forgotten below the least.
constexpr double shift_decay = 3, least_shift = 1e-6;

// Restoration ends once the violation has fallen to this fraction; its damping grows and shrinks by tens.
constexpr double restored = 0.9;
constexpr double first_damping = 1e-8, most_damping = 1e12;

// The violation is stationary where |A^T c| <= this * |c| in units of the rows' largest gradient.
constexpr double stationary_violation = 1e-7;

class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), begun_(std::chrono::steady_clock::now()) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point begun_;
};

}  // namespace

Newton::Newton(const Transcription& transcription, const Layout& layout)
    : t_(transcription), layout_(layout), kkt_(transcription, layout) {
  soft_weight_ = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind == Row::Kind::soft) soft_weight_[layout.of_row[r]] = t_.rows[r].weight;
  }
}

Eigen::VectorXd Newton::residual_of(const Values& values) const {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) c[layout_.of_row[r]] = values.residual[r];
  return c;
}

double Newton::largest_change(const Eigen::VectorXd& direction) const {
  double largest = 0;
  for (const int position : layout_.of_unknown) largest = std::max(largest, std::abs(direction[position]));
  return largest;
}

Newton::Trial Newton::try_at(NewtonState& state, const Eigen::VectorXd& direction, double length) {
  const Stopwatch watch(state.seconds.evaluate);
  Trial trial;
  trial.x = state.x;
  for (int u = 0; u < t_.unknowns(); ++u) trial.x[u] += length * direction[layout_.of_unknown[u]];
  trial.values = evaluate(t_, trial.x, workspace_);
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind != Row::Kind::soft) trial.sum += std::abs(trial.values.residual[r]);
  }
  return trial;
}

// Derivatives, multipliers and measures at state.x.
void Newton::judge(NewtonState& state) {
  state.condition = StepResult::not_finite;
  state.measures = {};
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind == Row::Kind::soft) continue;
    state.measures.violation = std::max(state.measures.violation, std::abs(state.values.residual[r]));
    state.measures.sum += std::abs(state.values.residual[r]);
  }
  if (!state.values.finite) return;

  Linearisation& linear = state.linear;
  {
    const Stopwatch watch(state.seconds.evaluate);
    linearise(t_, layout_, state.x, workspace_, linear);
    state.gradient = linear.gradient +
                     multiply(linear.jacobian, soft_weight_.cwiseProduct(residual_of(state.values)));
  }
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_row(k)) state.gradient[k] = 0;
  }
  if (!state.gradient.allFinite()) return;

  std::optional<Eigen::VectorXd> lambda;
  {
    const Stopwatch watch(state.seconds.factor);
    lambda = kkt_.least_squares_multipliers(linear, state.gradient);
  }
  state.condition = StepResult::singular;
  if (!lambda) return;
  Eigen::VectorXd of_rows = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    const int position = layout_.of_row[r];
    if (kkt_.is_hard(position)) of_rows[position] = (*lambda)[position];
    state.multipliers[r] = kkt_.is_hard(position) ? of_rows[position] : t_.rows[r].weight * state.values.residual[r];
  }
  const Eigen::VectorXd pull = multiply(linear.jacobian, of_rows);
  double largest = 0, of_objective = 0;
  for (const int position : layout_.of_unknown) {
    largest = std::max(largest, std::abs(state.gradient[position] + pull[position]));
    of_objective = std::max(of_objective, std::abs(state.gradient[position]));
  }
  state.measures.stationarity = largest / std::max(1.0, of_objective);

  const Stopwatch watch(state.seconds.evaluate);
  add_row_curvature(t_, layout_, state.x, state.values, state.multipliers, workspace_, linear);
  state.condition = StepResult::not_finite;
  if (!std::ranges::all_of(linear.hessian.band, [](double h) { return std::isfinite(h); })) return;
  if (!linear.hessian.border.allFinite()) return;
  state.condition = StepResult::stepped;
}

NewtonState Newton::start(std::vector<double> x) {
  NewtonState state;
  settle_functionals(t_, x, workspace_);
  state.x = std::move(x);
  state.linear = start_linearisation(layout_);
  state.multipliers.assign(t_.rows.size(), 0.0);
  state.values = evaluate(t_, state.x, workspace_);
  state.radius = first_radius;
  judge(state);
  state.most_violation = std::max(1.0, state.measures.sum);
  state.filter.limit(most_violation_factor * state.most_violation);
  return state;
}

void Newton::accept(NewtonState& state, Trial trial) {
  state.step = 0;
  for (int u = 0; u < t_.unknowns(); ++u) state.step = std::max(state.step, std::abs(trial.x[u] - state.x[u]));
  state.x = std::move(trial.x);
  state.values = std::move(trial.values);
  ++state.iterations;
  judge(state);
}

StepResult Newton::step(NewtonState& state, double tolerance) {
  if (state.condition != StepResult::stepped) return state.condition;
  if (state.measures.violation <= tolerance && state.measures.stationarity <= tolerance) return StepResult::converged;
  if (state.restore_from > 0) return restore(state, tolerance);

  const Linearisation& linear = state.linear;
  const Eigen::VectorXd c = residual_of(state.values);
  Eigen::VectorXd solution;
  {
    const Stopwatch watch(state.seconds.factor);
    const auto shift = kkt_.factor(linear, state.shift);
    if (!shift) return StepResult::singular;
    state.shift_used = *shift;
    const auto solved = kkt_.solve(-(linear.gradient + c));
    if (!solved) return StepResult::singular;
    solution = *solved;
  }
  state.shift = state.shift_used > 0 ? state.shift_used : state.shift / shift_decay;
  if (state.shift < least_shift) state.shift = 0;

  // The model: f along d, its curvature, and the Lagrangian with the new multipliers.
  Eigen::VectorXd d = solution;
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_row(k)) d[k] = 0;
  }
  const Eigen::VectorXd slope_of_rows = multiply(linear.jacobian, d);
  double curvature = d.dot(multiply(linear.hessian, d)), pull = 0;
  for (int k = 0; k < layout_.size(); ++k) {
    if (!kkt_.is_row(k)) continue;
    curvature += soft_weight_[k] * slope_of_rows[k] * slope_of_rows[k];
    if (kkt_.is_hard(k)) pull += solution[k] * slope_of_rows[k];
  }
  const double descent = state.gradient.dot(d), violation = state.measures.sum, objective = state.values.objective;
  const auto lagrangian = [&](const Values& values) {
    double sum = values.objective;
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      if (kkt_.is_hard(layout_.of_row[r])) sum += solution[layout_.of_row[r]] * values.residual[r];
    }
    return sum;
  };
  const double lagrangian_here = lagrangian(state.values);
  const auto model_holds = [&](const Trial& trial, double length, double error) {
    if (!trial.values.finite) return false;
    const double predicted = length * (descent + pull) + length * length / 2 * curvature;
    return std::abs(lagrangian(trial.values) - lagrangian_here - predicted) <=
           error * std::abs(predicted) + rounding * std::abs(lagrangian_here);
  };

  enum class Verdict { rejected, objective_step, violation_step };
  const auto judge_trial = [&](const Trial& trial, double length) {
    if (!trial.values.finite || !state.filter.admits(trial.sum, trial.values.objective)) return Verdict::rejected;
    const bool switching = descent < 0 && length * std::pow(-descent, switch_descent_power) >
                                              std::pow(violation, switch_violation_power);
    if (violation <= small_violation_factor * state.most_violation && switching) {
      const double allowed = objective + sufficient_decrease * length * descent + rounding * std::abs(objective);
      return trial.values.objective <= allowed ? Verdict::objective_step : Verdict::rejected;
    }
    const bool better = trial.sum <= (1 - Filter::margin) * violation ||
                        trial.values.objective <= objective - Filter::margin * violation;
    return better ? Verdict::violation_step : Verdict::rejected;
  };

  const double size = largest_change(d);
  Trial trial = try_at(state, d, 1);
  const bool holds = model_holds(trial, 1, model_error) && trial.sum <= violation_error * violation + tolerance;
  double length = 1;
  if (!holds && size > state.radius) {
    length = state.radius / size;
    trial = try_at(state, d, length);
  }
  const double first_length = length;
  bool corrected = false;
  Verdict verdict = judge_trial(trial, length);
  if (verdict == Verdict::rejected && trial.values.finite) {
    // Second-order corrections: the same matrix, with the violation met at the trial point.
    Eigen::VectorXd remaining = length * c + residual_of(trial.values);
    for (int k = 0; k < corrections && verdict == Verdict::rejected; ++k) {
      std::optional<Eigen::VectorXd> correction;
      {
        const Stopwatch watch(state.seconds.factor);
        correction = kkt_.solve(-(linear.gradient + remaining));
      }
      if (!correction) break;
      const double corrected_size = largest_change(*correction);
      Trial other = try_at(state, *correction, std::min(1.0, state.radius / std::max(corrected_size, 1e-300)));
      verdict = judge_trial(other, length);
      if (verdict == Verdict::rejected && !other.values.finite) break;
      remaining += residual_of(other.values);
      if (verdict != Verdict::rejected) {
        trial = std::move(other);
        corrected = true;
      }
    }
  }
  while (verdict == Verdict::rejected) {
    length /= 2;
    if (length < shortest_step) {
      if (violation <= tolerance) return StepResult::exhausted;
      state.filter.add(violation, objective);
      state.restore_from = violation;
      state.damping = first_damping;
      return restore(state, tolerance);
    }
    trial = try_at(state, d, length);
    verdict = judge_trial(trial, length);
  }

  if (verdict == Verdict::violation_step) state.filter.add(violation, objective);
  if (!holds) {
    if (length < first_length) {
      state.radius = std::max(length * size, first_radius);
    } else if (!corrected && first_length < 1 && model_holds(trial, length, good_model_error)) {
      state.radius *= radius_growth;
    } else if (!corrected && !model_holds(trial, length, good_model_error)) {
      state.radius = std::max(state.radius / radius_growth, first_radius);
    }
  }
  accept(state, std::move(trial));
  return StepResult::stepped;
}

// One Levenberg-Marquardt step on sum c^2 / 2, until the filter takes the point and the violation has fallen.
StepResult Newton::restore(NewtonState& state, double tolerance) {
  const Eigen::VectorXd c = residual_of(state.values);
  Eigen::VectorXd hard = c;
  double squares = 0;
  for (int k = 0; k < layout_.size(); ++k) {
    if (!kkt_.is_hard(k)) hard[k] = 0;
    squares += hard[k] * hard[k];
  }
  for (; state.damping <= most_damping; state.damping *= 10) {
    std::optional<Eigen::VectorXd> solution;
    {
      const Stopwatch watch(state.seconds.factor);
      if (kkt_.factor_feasibility(state.linear, state.damping)) solution = kkt_.solve(-hard);
    }
    if (!solution) continue;
    Eigen::VectorXd d = *solution;
    for (int k = 0; k < layout_.size(); ++k) {
      if (kkt_.is_row(k)) d[k] = 0;
    }
    const double slope = hard.dot(multiply(state.linear.jacobian, d));  // of the half sum of squares along d
    if (!(slope < -stationary_violation * squares)) continue;
    const double size = largest_change(d);
    for (double length = std::min(1.0, state.radius / size); length > 1e-3; length /= 2) {
      Trial trial = try_at(state, d, length);
      if (!trial.values.finite) continue;
      double now = 0;
      for (std::size_t r = 0; r < t_.rows.size(); ++r) {
        if (t_.rows[r].kind != Row::Kind::soft) now += trial.values.residual[r] * trial.values.residual[r];
      }
      if (!(now <= squares + 2 * sufficient_decrease * length * slope)) continue;
      state.damping = std::max(state.damping / 10, first_damping);
      state.shift_used = 0;
      const bool enough = trial.sum <= std::max(restored * state.restore_from, tolerance);
      if (enough && state.filter.admits(trial.sum, trial.values.objective)) state.restore_from = 0;
      accept(state, std::move(trial));
      return StepResult::stepped;
    }
  }
  return StepResult::infeasible;
}

}  // namespace spacetime::optimizer
