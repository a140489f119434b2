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
constexpr int corrections = 2;      // second-order corrections tried at each length
constexpr double fair_price = 10;   // times sum |lambda c|: most that reducing a small violation may cost

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

Newton::Trial Newton::try_at(NewtonState& state, const Eigen::VectorXd& change) const {
  const Stopwatch watch(state.seconds.evaluate);
  Trial trial;
  trial.x = state.x;
  for (int u = 0; u < t_.unknowns(); ++u) trial.x[u] += change[layout_.of_unknown[u]];
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
    state.gradient = linear.gradient + multiply(linear.jacobian, soft_weight_.cwiseProduct(residual_of(state.values)));
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

  std::optional<Kkt::Step> step;
  {
    const Stopwatch watch(state.seconds.factor);
    step = kkt_.step(state.linear, -(state.linear.gradient + residual_of(state.values)), state.shift);
  }
  if (!step) return StepResult::singular;
  state.shift_used = step->shift;
  state.shift = step->shift > 0 ? step->shift : state.shift / shift_decay;
  if (state.shift < least_shift) state.shift = 0;
  return search(state, model_of(state, step->solution), tolerance);
}

Newton::Model Newton::model_of(const NewtonState& state, const Eigen::VectorXd& solution) const {
  Model model{solution, solution, 0, 0, 0, 0, 0, 0};
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_row(k)) model.d[k] = 0;
    if (!kkt_.is_hard(k)) model.multipliers[k] = 0;
  }
  const Eigen::VectorXd c = residual_of(state.values), slope = multiply(state.linear.jacobian, model.d);
  model.size = largest_change(model.d);
  model.descent = state.gradient.dot(model.d);
  model.curvature = model.d.dot(multiply(state.linear.hessian, model.d));
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_row(k)) model.curvature += soft_weight_[k] * slope[k] * slope[k];
    model.pull += model.multipliers[k] * slope[k];
  }
  model.lagrangian = lagrangian(model, state.values);
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind != Row::Kind::soft) model.price += std::abs(state.multipliers[r] * state.values.residual[r]);
  }
  return model;
}

double Newton::lagrangian(const Model& model, const Values& values) const {
  return values.objective + model.multipliers.dot(residual_of(values));
}

// Whether the Lagrangian changed as predicted, to the given fraction.
bool Newton::holds(const Model& model, const Trial& trial, double length, double error) const {
  if (!trial.values.finite) return false;
  const double predicted = length * (model.descent + model.pull) + length * length / 2 * model.curvature;
  const double difference = lagrangian(model, trial.values) - model.lagrangian - predicted;
  return std::abs(difference) <= error * std::abs(predicted) + rounding * std::abs(model.lagrangian);
}

Newton::Verdict Newton::verdict(const NewtonState& state, const Model& model, const Trial& trial, double length) const {
  const double violation = state.measures.sum, objective = state.values.objective, now = trial.values.objective;
  if (!trial.values.finite || !state.filter.admits(trial.sum, now)) return Verdict::rejected;
  const double slack = rounding * std::abs(objective);
  if (violation <= small_violation_factor * state.most_violation) {
    const bool switching = model.descent < 0 && length * std::pow(-model.descent, switch_descent_power) >
                                                    std::pow(violation, switch_violation_power);
    if (switching) {
      const bool enough = now <= objective + sufficient_decrease * length * model.descent + slack;
      return enough ? Verdict::objective_step : Verdict::rejected;
    }
    // A violation this small is no reason to give up much of the objective.
    if (now > objective + fair_price * model.price + slack) return Verdict::rejected;
  }
  const bool better = trial.sum <= (1 - Filter::margin) * violation || now <= objective - Filter::margin * violation;
  return better ? Verdict::violation_step : Verdict::rejected;
}

// A second-order correction: from the trial point back to where the linearised constraints said it would be, by the
// smallest change in the metric of the step's own matrix.
std::optional<Newton::Trial> Newton::corrected(NewtonState& state, const Model& model, const Trial& trial,
                                               double length) {
  if (!trial.values.finite) return std::nullopt;
  const Eigen::VectorXd c = residual_of(state.values);
  Eigen::VectorXd change = length * model.d;
  Eigen::VectorXd missed = residual_of(trial.values) - (1 - length) * c;
  for (int k = 0; k < corrections; ++k) {
    for (int i = 0; i < layout_.size(); ++i) {
      if (!kkt_.is_hard(i)) missed[i] = 0;
    }
    std::optional<Eigen::VectorXd> back;
    {
      const Stopwatch watch(state.seconds.factor);
      back = kkt_.solve(-missed);
    }
    if (!back) return std::nullopt;
    for (const int position : layout_.of_unknown) change[position] += (*back)[position];
    if (largest_change(change) > 2 * length * model.size) return std::nullopt;  // no correction any more
    Trial other = try_at(state, change);
    if (verdict(state, model, other, length) != Verdict::rejected) return other;
    if (!other.values.finite) return std::nullopt;
    missed = residual_of(other.values) - (1 - length) * c;
  }
  return std::nullopt;
}

StepResult Newton::search(NewtonState& state, const Model& model, double tolerance) {
  const double violation = state.measures.sum, objective = state.values.objective;
  Trial trial = try_at(state, model.d);
  const bool trusted = holds(model, trial, 1, model_error) && trial.sum <= violation_error * violation + tolerance;
  double length = 1;
  if (!trusted && model.size > state.radius) {
    length = state.radius / model.size;
    trial = try_at(state, length * model.d);
  }
  const double first_length = length;
  bool was_corrected = false;
  Verdict said = verdict(state, model, trial, length);
  while (said == Verdict::rejected) {
    if (auto other = corrected(state, model, trial, length)) {
      trial = std::move(*other);
      said = verdict(state, model, trial, length);
      was_corrected = true;
      break;
    }
    length /= 2;
    if (length < shortest_step) {
      if (violation <= tolerance) return StepResult::exhausted;
      state.filter.add(violation, objective);
      state.restore_from = violation;
      state.damping = first_damping;
      return restore(state, tolerance);
    }
    trial = try_at(state, length * model.d);
    said = verdict(state, model, trial, length);
  }

  if (said == Verdict::violation_step) state.filter.add(violation, objective);
  if (!trusted) {
    if (length < first_length) {
      state.radius = std::max(length * model.size, first_radius);
    } else if (!was_corrected) {
      const bool good = holds(model, trial, length, good_model_error);
      if (good && first_length < 1) state.radius *= radius_growth;
      if (!good) state.radius = std::max(state.radius / radius_growth, first_radius);
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
      Trial trial = try_at(state, length * d);
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
