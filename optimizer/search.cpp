// Which steps are taken: the filter line search, second-order corrections, the radius, restoration.
#include <algorithm>
#include <cmath>

#include "optimizer/newton.h"

namespace spacetime::optimizer {
namespace {

// The radius starts at `first_radius` (rad or m): where the model does not hold, no coefficient changes by more in one
// step.  Without it solutions hop between the many minima of a throw.  It grows while steps go well, so other units
// cost a few iterations, not the solution.
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
constexpr double small_violation_factor = 1e-4;
constexpr int corrections = 2;     // second-order corrections tried at each length
constexpr double fair_price = 10;  // times sum |lambda c|: most that reducing a small violation may cost

// A violation above the small ones that has not fallen to `progress` of its least within so many steps is better
// reduced by itself.
constexpr double progress = 0.9;
constexpr int patience = 25;

// Restoration ends once the violation has fallen to this fraction; its damping grows and shrinks by tens; the violation
// is stationary where no damping promises to take this fraction off its square.
constexpr double restored = 0.9;
constexpr double first_damping = 1e-8, most_damping = 1e12;
constexpr double stationary_violation = 1e-7;
constexpr double large_residual = 0.8;  // what more than this of the square promises to vanish needs no curvature
constexpr double shortest_restoring_step = 1e-3;

}  // namespace

Newton::Trial Newton::try_at(NewtonState& state, const Eigen::VectorXd& change, const Barrier& barrier) const {
  const Stopwatch watch(state.seconds.evaluate);
  Trial trial;
  trial.x = state.x;
  trial.barrier = barrier;
  for (const int u : layout_.free) trial.x[u] += change[layout_.of_unknown[u]];
  trial.values = evaluate(t_, trial.x, workspace_, state.active);
  const Eigen::VectorXd c = residual_of(t_, layout_, trial.values);
  limits_.widen(trial.barrier, c);
  trial.sum = filter_sum(c, trial.barrier);
  trial.merit = trial.values.objective + limits_.value(trial.x, trial.barrier);
  trial.finite = trial.values.finite && std::isfinite(trial.merit);
  return trial;
}

double Newton::lagrangian(const Model& model, const Trial& trial) const {
  return trial.merit + model.multipliers.dot(residual_of(t_, layout_, trial.values) + trial.barrier.slack);
}

// Whether the Lagrangian changed as predicted, to the given fraction.
bool Newton::holds(const Model& model, const Trial& trial, double length, double error) const {
  if (!trial.finite) return false;
  const double predicted = length * (model.descent + model.pull) + length * length / 2 * model.curvature;
  const double difference = lagrangian(model, trial) - model.lagrangian - predicted;
  return std::abs(difference) <= error * std::abs(predicted) + rounding * std::abs(model.lagrangian);
}

Newton::Verdict Newton::verdict(const NewtonState& state, const Model& model, const Trial& trial, double length) const {
  const double violation = state.measures.sum;
  if (!trial.finite || !state.filter.admits(trial.sum, trial.merit)) return Verdict::rejected;
  const double slack = rounding * std::abs(model.merit);
  if (violation <= small_violation_factor * state.most_violation) {
    const bool switching = model.descent < 0 && length * std::pow(-model.descent, switch_descent_power) >
                                                    std::pow(violation, switch_violation_power);
    if (switching) {
      const bool enough = trial.merit <= model.merit + sufficient_decrease * length * model.descent + slack;
      return enough ? Verdict::objective_step : Verdict::rejected;
    }
    // A violation this small is no reason to give up much of the objective.
    if (trial.merit > model.merit + fair_price * model.price + slack) return Verdict::rejected;
  }
  const bool better =
      trial.sum <= (1 - Filter::margin) * violation || trial.merit <= model.merit - Filter::margin * violation;
  return better ? Verdict::violation_step : Verdict::rejected;
}

Barrier Newton::moved(const NewtonState& state, const Model& model, double length) const {
  Barrier barrier = state.barrier;
  const double dual_length = model.change.most_dual;
  barrier.slack += length * model.change.slack;
  barrier.dual += dual_length * model.change.dual;
  barrier.lower_dual += dual_length * model.change.lower_dual;
  barrier.upper_dual += dual_length * model.change.upper_dual;
  return barrier;
}

// A second-order correction: from the trial point back to where the linearised constraints said it would be, by the
// smallest change in the metric of the step's own matrix.
std::optional<Newton::Trial> Newton::corrected(NewtonState& state, const Model& model, const Trial& trial,
                                               double length) {
  if (!trial.finite) return std::nullopt;
  const auto gap = [&](const Values& values, const Barrier& barrier) {
    Eigen::VectorXd g = residual_of(t_, layout_, values) + barrier.slack;
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      if (t_.rows[r].kind == Row::Kind::soft) g[layout_.of_row[r]] = 0;
    }
    return g;
  };
  const Eigen::VectorXd wanted = (1 - length) * gap(state.values, state.barrier);
  Eigen::VectorXd change = length * model.d, missed = gap(trial.values, trial.barrier) - wanted;
  for (int k = 0; k < corrections; ++k) {
    std::optional<Eigen::VectorXd> back;
    {
      const Stopwatch watch(state.seconds.factor);
      back = kkt_.solve(-missed);
    }
    if (!back) return std::nullopt;
    for (const int u : layout_.free) change[layout_.of_unknown[u]] += (*back)[layout_.of_unknown[u]];
    if (largest_change(change) > 2 * length * model.size || most_length(change) < 1) return std::nullopt;
    Trial other = try_at(state, change, moved(state, model, length));
    if (verdict(state, model, other, length) != Verdict::rejected) return other;
    if (!other.finite) return std::nullopt;
    missed = gap(other.values, other.barrier) - wanted;
  }
  return std::nullopt;
}

StepResult Newton::search(NewtonState& state, const Model& model, double tolerance) {
  const double violation = state.measures.sum;
  double length = std::min(model.change.most_primal, most_length(model.d));
  const auto try_length = [&] { return try_at(state, length * model.d, moved(state, model, length)); };
  Trial trial = try_length();
  const bool trusted =
      holds(model, trial, length, model_error) && trial.sum <= (1 - length + violation_error) * violation + tolerance;
  if (!trusted && length * model.size > state.radius) {
    length = state.radius / model.size;
    trial = try_length();
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
      if (state.measures.violation <= tolerance) return StepResult::exhausted;
      return begin_restoration(state, model.merit, tolerance);
    }
    trial = try_length();
    said = verdict(state, model, trial, length);
  }

  if (said == Verdict::violation_step) state.filter.add(violation, model.merit);
  if (!trusted) {
    if (length < first_length) {
      state.radius = std::max(length * model.size, first_radius);
    } else if (!was_corrected) {
      const bool good = holds(model, trial, length, good_model_error);
      if (good && first_length < model.change.most_primal) state.radius *= radius_growth;
      if (!good) state.radius = std::max(state.radius / radius_growth, first_radius);
    }
  }
  state.proposed = model.multipliers;
  accept(state, std::move(trial));
  return StepResult::stepped;
}

void Newton::accept(NewtonState& state, Trial trial) {
  state.step = 0;
  for (const int u : layout_.free) state.step = std::max(state.step, std::abs(trial.x[u] - state.x[u]));
  state.x = std::move(trial.x);
  state.values = std::move(trial.values);
  state.barrier = std::move(trial.barrier);
  if (!limits_.none()) limits_.guard(state.x, state.barrier);
  ++state.iterations;
  judge(state);
}

// The mean size of a statement's rows, at each of them.  Not each row's own: the components of a point that is out of
// reach are to be weighed alike, also where the arm is stretched along one of them.
Eigen::VectorXd Newton::sizes_of_statements(const NewtonState& state) const {
  Eigen::VectorXd sizes = kkt_.row_sizes(state.linear.jacobian);
  for (std::size_t from = 0, to = 0; from < t_.rows.size(); from = to) {
    double sum = 0;
    while (to < t_.rows.size() && t_.rows[to].kind == t_.rows[from].kind &&
           t_.rows[to].statement == t_.rows[from].statement) {
      sum += sizes[layout_.of_row[to++]];
    }
    for (std::size_t r = from; r < to; ++r) sizes[layout_.of_row[r]] = sum / static_cast<double>(to - from);
  }
  return sizes;
}

// Whether the steps have stopped to reduce the violation.
bool Newton::stalls(NewtonState& state, double tolerance) const {
  const double sum = state.measures.sum;
  if (state.least_sum == 0 || sum <= progress * state.least_sum) {
    state.least_sum = sum;
    state.without_progress = 0;
    return false;
  }
  const bool small = sum <= small_violation_factor * state.most_violation || state.measures.violation <= tolerance;
  if (++state.without_progress < patience || small) return false;
  state.least_sum = sum;
  state.without_progress = 0;
  return true;
}

StepResult Newton::begin_restoration(NewtonState& state, double merit, double tolerance) {
  state.filter.add(state.measures.sum, merit);
  state.restore_from = state.measures.sum;
  state.damping = first_damping;
  state.curved = false;
  state.radius = first_radius;
  state.proposed.resize(0);
  return restore(state, tolerance);
}

// The second derivatives of half the sum of squared violations that go with the violations themselves.
BorderedMatrix Newton::violation_curvature(NewtonState& state, const Eigen::VectorXd& violation) const {
  const Stopwatch watch(state.seconds.evaluate);
  std::vector<double> weights(t_.rows.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    weights[r] = violation[layout_.of_row[r]] / state.sizes[layout_.of_row[r]];
  }
  BorderedMatrix curvature(layout_.pattern);
  set_violation_curvature(t_, layout_, state.x, weights, workspace_, curvature, state.active);
  return curvature;
}

// One Levenberg-Marquardt step on half the sum of squared violations, until the filter takes the point and the
// violation has fallen.  Each is taken over its statement's size: what units a constraint is written in must not decide
// whether a step is an improvement.  Where what cannot be removed is large, the Gauss-Newton matrix alone creeps
// towards the least of it: the violations' own curvature is added as soon as that predicts better [Dennis, Gay and
// Welsch 1981].
StepResult Newton::restore(NewtonState& state, double tolerance) {
  const auto violations = [&](const Values& values) {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(layout_.size());
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      if (t_.rows[r].kind != Row::Kind::soft) v[layout_.of_row[r]] = excess(t_.rows[r], values.residual[r]);
    }
    return v;
  };
  const Eigen::VectorXd violation = violations(state.values);
  state.sizes = sizes_of_statements(state);
  const auto squares_of = [&](const Eigen::VectorXd& v) { return v.cwiseAbs2().cwiseQuotient(state.sizes).sum(); };
  const double squares = squares_of(violation);
  const BorderedMatrix curvature = violation_curvature(state, violation);
  for (; state.damping <= most_damping; state.damping *= 10) {
    std::optional<Eigen::VectorXd> solution;
    {
      const Stopwatch watch(state.seconds.factor);
      const bool factored =
          state.curved ? kkt_.factor_feasibility(state.linear, curvature, violation, state.sizes, state.damping)
                       : kkt_.factor_feasibility(state.linear, violation, state.sizes, state.damping);
      if (factored) solution = kkt_.solve(-violation);
    }
    if (!solution) continue;
    Eigen::VectorXd d = *solution;
    for (int k = 0; k < layout_.size(); ++k) {
      if (kkt_.is_row(k)) d[k] = 0;
    }
    // Of half the sum of squares along d.
    const Eigen::VectorXd along = multiply(state.linear.jacobian, d);
    const double slope = violation.cwiseQuotient(state.sizes).dot(along);
    if (!(slope < -stationary_violation * squares)) continue;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(layout_.size());
    const double room = limits_.change(state.x, state.barrier, -state.barrier.slack, zero, d).most_primal;
    for (double length = std::min({room, state.radius / largest_change(d), most_length(d)});
         length > shortest_restoring_step; length /= 2) {
      Trial trial = try_at(state, length * d, state.barrier);
      if (!trial.values.finite) continue;
      const double remaining = squares_of(violations(trial.values));
      if (!(remaining <= squares + 2 * sufficient_decrease * length * slope)) continue;
      double straight = 0;
      for (int k = 0; k < layout_.size(); ++k) {
        if (violation[k] != 0) straight += along[k] * along[k] / state.sizes[k];
      }
      const double missed = (remaining - squares) / 2 - length * slope - length * length / 2 * straight;
      const double bend = length * length / 2 * d.dot(multiply(curvature, d));
      state.curved = -slope < large_residual * squares && std::abs(missed - bend) < std::abs(missed);
      const double error = std::min(std::abs(missed - bend), std::abs(missed));
      if (error <= good_model_error * (squares - remaining) / 2) state.radius *= radius_growth;
      trial.barrier = limits_.start(trial.x, residual_of(t_, layout_, trial.values), state.barrier.mu);
      trial.sum = filter_sum(residual_of(t_, layout_, trial.values), trial.barrier);
      trial.merit = trial.values.objective + limits_.value(trial.x, trial.barrier);
      state.damping = std::max(state.damping / 10, first_damping);
      state.shift_used = 0;
      const bool enough = trial.sum <= std::max(restored * state.restore_from, tolerance);
      const bool over = enough && state.filter.admits(trial.sum, trial.merit);
      accept(state, std::move(trial));
      const bool nothing_left = state.measures.violation <= tolerance;
      if (!over && nothing_left) state.filter.clear();
      if (over || nothing_left) {
        state.restore_from = 0;
        state.radius = first_radius;
      }
      return StepResult::stepped;
    }
  }
  return StepResult::infeasible;
}

}  // namespace spacetime::optimizer
