#include "optimizer/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace spacetime::optimizer {
namespace {

// The inertia correction decays by this after a step that needed none, and is forgotten below the least.
constexpr double shift_decay = 3, least_shift = 1e-6;

// The filter forbids violations this many times the start's.
constexpr double most_violation_factor = 1e4;

// The barrier, in units of max(1, |objective|) shared by all limits: where it starts, how well the problem with it must
// be solved before it falls, and how it falls [Waechter and Biegler 2006, eq. 7]; the last is this fraction of the
// tolerance.
constexpr double first_mu = 0.1, barrier_error = 10, mu_factor = 0.2, mu_power = 1.5, last_mu = 0.5;

// After an edit the barrier begins at this fraction of a first start's, and starts are pushed inside their bounds by
// this part.
constexpr double warm_mu = 1e-4, warm_push = 1e-8;

// A point within this is that of a solve which has ended, to a tolerance of some use.
constexpr double of_a_solve = 1e-3;

// Multipliers other than the least-squares ones are taken where they leave less than this of the gradient's square.
constexpr double much_better = 0.25;

// A soft inequality that is met: so compliant that it asks nothing.
constexpr double inert = 1e30;

// An instance whose condition has changed sides so often stays on.
constexpr int most_switches = 4;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

Stopwatch::Stopwatch(double& seconds) : seconds_(seconds), begun_(now()) {}
Stopwatch::~Stopwatch() { seconds_ += now() - begun_; }

Newton::Newton(const Transcription& transcription, const Layout& layout)
    : t_(transcription), layout_(layout), kkt_(transcription, layout), limits_(transcription, layout) {}

double Newton::filter_sum(const Eigen::VectorXd& c, const Barrier& barrier) const {
  double sum = 0;
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_equation(k)) sum += std::abs(c[k]);
  }
  for (const int k : limits_.rows()) sum += std::abs(c[k] + barrier.slack[k]);
  return sum;
}

double Newton::largest_change(const Eigen::VectorXd& direction) const {
  double largest = 0;
  for (const int u : layout_.free) largest = std::max(largest, std::abs(direction[layout_.of_unknown[u]]));
  return largest;
}

Newton::Pull Newton::pull_of(const NewtonState& state, const Eigen::VectorXd& pulled,
                             Eigen::VectorXd multipliers) const {
  for (int k = 0; k < layout_.size(); ++k) {
    if (!kkt_.is_equation(k)) multipliers[k] = 0;
  }
  Eigen::VectorXd left = pulled + multiply(state.linear.jacobian, multipliers);
  double squares = 0;
  for (const int u : layout_.free) squares += left[layout_.of_unknown[u]] * left[layout_.of_unknown[u]];
  return {std::move(multipliers), std::move(left), squares};
}

// The least-squares multipliers are known to what regularisation leaves of them: where rows nearly depend on one
// another they may cancel less of the gradient than those the step was made with, which are then taken.
Newton::Pull Newton::best_multipliers(NewtonState& state, const Eigen::VectorXd& pulled,
                                      Eigen::VectorXd least_squares) const {
  Pull best = pull_of(state, pulled, std::move(least_squares));
  if (state.proposed.size() == 0) return best;
  Pull proposed = pull_of(state, pulled, state.proposed);
  if (proposed.squares < much_better * best.squares) return proposed;
  state.proposed.resize(0);
  return best;
}

// Derivatives, multipliers and measures at state.x.
void Newton::judge(NewtonState& state) {
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values);
  state.condition = StepResult::not_finite;
  state.measures = {};
  state.measures.sum = filter_sum(c, state.barrier);
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind == Row::Kind::soft) continue;
    const double amount = std::abs(excess(t_.rows[r], state.values.residual[r]));
    state.measures.violation = std::max(state.measures.violation, amount);
  }
  if (!state.values.finite) return;

  Linearisation& linear = state.linear;
  const Eigen::VectorXd weights = soft_weights(t_, layout_, c);
  {
    const Stopwatch watch(state.seconds.evaluate);
    linearise(t_, layout_, state.x, workspace_, linear, state.active);
    state.gradient = linear.gradient + multiply(linear.jacobian, weights.cwiseProduct(c));
  }
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_row(k)) state.gradient[k] = 0;
  }
  if (!state.gradient.allFinite()) return;

  // The gradient of the Lagrangian but for equations; then the equations' multipliers that best cancel it.
  const Eigen::VectorXd pulled =
      state.gradient + limits_.pull(state.barrier) + multiply(linear.jacobian, state.barrier.dual);
  std::optional<Eigen::VectorXd> lambda;
  {
    const Stopwatch watch(state.seconds.factor);
    lambda = kkt_.least_squares_multipliers(linear, pulled);
  }
  state.condition = StepResult::singular;
  if (!lambda) return;
  const Pull best = best_multipliers(state, pulled, std::move(*lambda));
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    const int k = layout_.of_row[r];
    state.multipliers[r] = best.multipliers[k] + state.barrier.dual[k] + weights[k] * c[k];
  }
  state.measures.stationarity = stationarity_of(layout_, best.left, state.gradient);
  state.measures.gap = limits_.gap(state.x, state.barrier, 0) / std::max(1.0, std::abs(state.values.objective));

  const Stopwatch watch(state.seconds.evaluate);
  add_row_curvature(t_, layout_, state.x, state.values, state.multipliers, workspace_, linear, state.active);
  state.condition = StepResult::not_finite;
  bool finite = true;
  for_each_entry(linear.hessian, [&](int, int, double h) { finite &= std::isfinite(h); });
  if (!finite) return;
  state.condition = StepResult::stepped;
}

void Newton::complete(NewtonState& state) {
  state.linear = start_linearisation(layout_);
  state.multipliers.assign(t_.rows.size(), 0.0);
  state.values = evaluate(t_, state.x, workspace_, state.active);
  judge(state);
}

NewtonState Newton::start(std::vector<double> x, const Carried* carried) {
  NewtonState state;
  settle_functionals(t_, x, workspace_);
  state.x = std::move(x);
  state.linear = start_linearisation(layout_);
  state.multipliers.assign(t_.rows.size(), 0.0);
  state.active = active_rows(t_, state.x, workspace_);
  state.switches.assign(t_.rows.size(), 0);
  state.values = evaluate(t_, state.x, workspace_, state.active);
  state.radius = first_radius;
  const double size = std::isfinite(state.values.objective) ? std::abs(state.values.objective) : 0;
  const double unit = std::max(1.0, size) / std::max(1, limits_.count());
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values);
  const auto begin = [&](double mu, double part) {
    auto inside = state.x;
    limits_.push_inside(inside, part);
    state.barrier = limits_.start(inside, c, mu);
    if (part < 1) limits_.carry(*carried, layout_, c, inside, state.barrier);
    state.outside = inside != state.x;
    judge(state);
  };
  const double first = first_mu * unit;
  bool begun = false;
  if (carried && carried->reached <= of_a_solve && !limits_.none()) {
    // An edit that asks nothing new of the motion leaves it where it is: solved.
    const double tolerance = std::max(carried->reached, Solve{}.tolerance), last = last_mu * tolerance * unit;
    begin(carried->mu > 0 ? std::min(carried->mu, last) : last, warm_push);
    begun = state.condition == StepResult::stepped && !state.outside && state.measures.within(tolerance);
  }
  if (!begun && carried && carried->mu > 0) {
    begin(std::clamp(warm_mu * first, std::min(carried->mu, first), first), warm_push);
  } else if (!begun) {
    begin(first, 1);
  }
  state.most_violation = std::max(1.0, state.measures.sum);
  state.filter.limit(most_violation_factor * state.most_violation);
  return state;
}

// The barrier needs a start inside all bounds.  It is moved there when the first step is wanted, not before: a motion
// that is only judged stays as it is.
void Newton::move_inside(NewtonState& state) {
  auto x = state.x;
  limits_.push_inside(x);
  NewtonState inside = start(std::move(x));
  inside.iterations = state.iterations;
  inside.seconds.evaluate += state.seconds.evaluate;
  inside.seconds.factor += state.seconds.factor;
  state = std::move(inside);
}

// `when`, settled at the start of each iteration.
void Newton::settle_conditions(NewtonState& state) {
  if (t_.conditionals.empty()) return;
  auto active = active_rows(t_, state.x, workspace_);
  std::vector<int> changed;
  for (std::size_t r = 0; r < active.size(); ++r) {
    if (active[r] == state.active[r]) continue;
    if (state.switches[r] >= most_switches) {
      active[r] = 1;
      if (state.active[r]) continue;
    }
    ++state.switches[r];
    changed.push_back(layout_.of_row[r]);
  }
  if (changed.empty()) return;
  state.active = std::move(active);
  state.values = evaluate(t_, state.x, workspace_, state.active);
  const Barrier fresh = limits_.start(state.x, residual_of(t_, layout_, state.values), state.barrier.mu);
  for (const int k : changed) {
    state.barrier.slack[k] = fresh.slack[k];
    state.barrier.dual[k] = fresh.dual[k];
  }
  state.filter.clear();
  judge(state);
}

void Newton::lower_barrier(NewtonState& state, double tolerance) const {
  if (limits_.none()) return;
  const double unit = std::max(1.0, std::abs(state.values.objective)) / limits_.count();
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values);
  double violation = 0;
  for (int k = 0; k < layout_.size(); ++k) {
    if (kkt_.is_equation(k)) violation = std::max(violation, std::abs(c[k]));
  }
  for (const int k : limits_.rows()) violation = std::max(violation, std::abs(c[k] + state.barrier.slack[k]));
  const double least = last_mu * tolerance * unit;
  while (state.barrier.mu > least) {
    const double mu = state.barrier.mu / unit;
    const double gap = limits_.gap(state.x, state.barrier, state.barrier.mu) / (unit * limits_.count());
    if (std::max({state.measures.stationarity, violation, gap}) > barrier_error * mu) return;
    state.barrier.mu = std::max(least, unit * std::min(mu_factor * mu, std::pow(mu, mu_power)));
    state.filter.clear();
  }
}

StepResult Newton::step(NewtonState& state, double tolerance) {
  if (state.condition != StepResult::stepped) return state.condition;
  settle_conditions(state);
  if (state.condition != StepResult::stepped) return state.condition;
  if (state.measures.within(tolerance)) return StepResult::converged;
  if (state.outside) move_inside(state);
  if (state.condition != StepResult::stepped) return state.condition;
  if (state.restore_from > 0) return restore(state, tolerance);
  lower_barrier(state, tolerance);
  if (stalls(state, tolerance)) {
    return begin_restoration(state, state.values.objective + limits_.value(state.x, state.barrier), tolerance);
  }

  const Eigen::VectorXd c = residual_of(t_, layout_, state.values), weights = soft_weights(t_, layout_, c);
  Eigen::VectorXd right =
      state.linear.gradient + limits_.gradient(state.x, state.barrier) + limits_.right(c, state.barrier);
  Eigen::VectorXd diagonal = limits_.diagonal(state.x, state.barrier);
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind != Row::Kind::soft) continue;
    const int k = layout_.of_row[r];
    diagonal[k] = weights[k] > 0 ? -1 / weights[k] : -inert;
    if (weights[k] == 0) right[k] = 0;
  }
  std::optional<Kkt::Step> step;
  {
    const Stopwatch watch(state.seconds.factor);
    step = kkt_.step(state.linear, diagonal, -right, state.shift);
  }
  if (!step) return StepResult::singular;
  state.shift_used = step->shift;
  state.shift = step->shift > 0 ? step->shift : state.shift / shift_decay;
  if (state.shift < least_shift) state.shift = 0;
  return search(state, model_of(state, std::move(step->solution)), tolerance);
}

Newton::Model Newton::model_of(const NewtonState& state, Eigen::VectorXd solution) const {
  const Eigen::VectorXd c = residual_of(t_, layout_, state.values), weights = soft_weights(t_, layout_, c);
  Model model;
  model.d = model.multipliers = solution;
  for (int k = 0; k < layout_.size(); ++k) (kkt_.is_row(k) ? model.d : model.multipliers)[k] = 0;
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    if (t_.rows[r].kind == Row::Kind::soft) model.multipliers[layout_.of_row[r]] = 0;
  }
  Eigen::VectorXd slope = multiply(state.linear.jacobian, model.d);
  for (int k = 0; k < layout_.size(); ++k) {
    if (!kkt_.is_row(k)) slope[k] = 0;
  }
  model.change = limits_.change(state.x, state.barrier, c, slope, solution);
  const Barrier& barrier = state.barrier;

  model.size = largest_change(model.d);
  model.merit = state.values.objective + limits_.value(state.x, barrier);
  model.lagrangian = model.merit + model.multipliers.dot(c + barrier.slack);
  model.descent = (state.gradient + limits_.gradient(state.x, barrier)).dot(model.d);
  model.pull = model.multipliers.dot(slope + model.change.slack);
  const Eigen::VectorXd of_bounds = limits_.diagonal(state.x, barrier);
  model.curvature = model.d.dot(multiply(state.linear.hessian, model.d) + of_bounds.cwiseProduct(model.d)) +
                    weights.dot(slope.cwiseAbs2());
  for (const int k : limits_.rows()) {
    model.descent -= barrier.mu * model.change.slack[k] / barrier.slack[k];
    model.curvature += barrier.dual[k] / barrier.slack[k] * model.change.slack[k] * model.change.slack[k];
  }
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    const int k = layout_.of_row[r];
    if (t_.rows[r].kind != Row::Kind::soft) model.price += std::abs(state.multipliers[r] * (c[k] + barrier.slack[k]));
  }
  return model;
}

}  // namespace spacetime::optimizer
