#include "optimizer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/diagnostic.h"
#include "common/sample.h"
#include "optimizer/batch.h"
#include "optimizer/carry.h"
#include "optimizer/refine.h"

namespace spacetime::optimizer {
namespace {

[[noreturn]] void not_built(std::string_view what) { throw InputError(fmt::format("{} is not built yet", what)); }

// The problem's bodies with what gives their poses and sizes.  A pose made of functionals is left out: its motion's
// document has none.
void add_bodies(const Problem& problem, Motion& motion) {
  const auto add_program = [&](const std::string& key) { motion.programs.emplace(key, problem.programs.at(key)); };
  for (const Body& body : problem.bodies) {
    const auto& inputs = problem.programs.at(body.program).inputs;
    if (std::ranges::find(inputs, InputKind::functional, &Input::kind) != inputs.end()) continue;
    motion.bodies.push_back(body);
    add_program(body.program);
    for (const Quantity& size : body.size)
      if (!size.program.empty()) add_program(size.program);
  }
}

// Whether two problems differ in nothing that iterations depend on.
bool same_to_iterate(const Problem& a, const Problem& b) {
  return a.start == b.start && a.end == b.end && a.constants == b.constants && a.parameters == b.parameters &&
         a.dofs == b.dofs && a.functionals == b.functionals && a.constraints == b.constraints &&
         a.objective == b.objective;
}

}  // namespace

bool is_edit(const Action& action) {
  return !std::holds_alternative<Solve>(action) && !std::holds_alternative<Iterate>(action);
}

Session::Session(Problem problem, std::optional<Motion> start)
    : original_(std::make_shared<Problem>(std::move(problem))),
      edited_{*original_, {}},
      start_(std::move(start)),
      now_(std::make_shared<Numerics>(in_effect(edited_, declared_), setting_)) {
  restart(start_of(now_->problem, now_->whole, start_ ? &*start_ : nullptr));
}

void Session::declare(int action) {
  const auto begins = [&](const auto& statement) { return statement.since > declared_ && statement.since <= action; };
  const bool more = std::ranges::any_of(edited_.problem.constraints, begins) ||
                    std::ranges::any_of(edited_.problem.objective, begins);
  declared_ = std::max(declared_, action);
  if (more) take_over(edited_, setting_);
}

void Session::perform(const Action& action, const Watch& watch) {
  std::visit([&](const auto& which) { act(which, watch); }, action);
}

void Session::act(const Reset&, const Watch&) {
  // Keyframes that were declared meanwhile count from here on.
  restart(start_of(in_effect(edited_, declared_), now_->whole, start_ ? &*start_ : nullptr));
}

void Session::act(const Window& window, const Watch&) {
  Setting setting = setting_;
  setting.window = window;
  take_over(edited_, setting);
}

void Session::act(const Damp& damp, const Watch&) {
  const double limit = evaluate(now_->problem, now_->whole.constants, damp.limit, "damp");
  if (!(limit > 0)) throw InputError(fmt::format("the limit of `damp`, {}, must be positive", limit));
  Setting setting = setting_;
  for (const Dof& dof : now_->problem.dofs) {
    if (damp.dofs.empty() || std::ranges::count(damp.dofs, dof.name) > 0) setting.damping[dof.name] = limit;
  }
  take_over(edited_, setting);
}

void Session::act(const Refine& action, const Watch&) {
  if (action.automatic) return refine_where_needed(action);
  Edited next = edited_;
  Curves finer = curves();
  refine(next.problem, now_->whole.constants, action, finer);
  take_over(std::move(next), setting_, &finer);
}

// Halves the spans on which one step on knots twice as fine moves the motion by more than the tolerance.
void Session::refine_where_needed(const Refine& action) {
  const double tolerance = evaluate(now_->problem, now_->whole.constants, *action.automatic, "refine auto");
  if (!(tolerance > 0))
    throw InputError(fmt::format("the tolerance of `refine auto`, {}, must be positive", tolerance));
  Edited halved = edited_;
  Curves before = curves();
  refine(halved.problem, now_->whole.constants, most_of(action), before);
  Numerics finer(in_effect(halved, declared_), setting_);
  auto x = unknowns(before);
  const Carried dual = carried(now_->t(), now_->layout, state_, finer.t());
  NewtonState state = finer.newton.start(finer.open(x), &dual);
  finer.newton.step(state, std::numeric_limits<double>::min());
  finer.close(state.x, x);
  const Curves after = curves_of(finer.whole, x);

  Edited next = edited_;
  Curves result = curves();
  const auto named = named_dofs(next.problem, action.dofs);
  for (std::size_t dof = 0; dof < result.size(); ++dof) {
    if (!named[dof]) continue;
    Basis& basis = next.problem.dofs[dof].basis;
    const auto differ = spans_that_differ(halved.problem.dofs[dof].basis, before[dof], after[dof], tolerance);
    std::vector<double> spans;
    const auto knots = breakpoints(basis);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const bool asks = std::ranges::any_of(differ, [&](double t) { return knots[k] <= t && t < knots[k + 1]; });
      if (asks) spans.push_back(knots[k]);
    }
    halve(basis, spans, result[dof]);
  }
  take_over(std::move(next), setting_, &result);
}

template <class Change, class... Arguments>
void Session::change_curves(const Change& change, const Arguments&... arguments) {
  Curves changed = curves();
  change(now_->problem, now_->whole.constants, now_->freedom, arguments..., changed);
  reshape(changed);
}

void Session::act(const Shake& action, const Watch&) {
  change_curves(shake, action, action.seed.value_or(shakes_ + 1));
  if (!action.seed) ++shakes_;
}

void Session::act(const Smooth& action, const Watch&) { change_curves(smooth, action); }
void Session::act(const PullKeys& action, const Watch&) { change_curves(pull, action); }
void Session::act(const Control& action, const Watch&) { change_curves(control, action); }

template <class Edit>
requires requires(Edited& edited, const Edit& edit) { apply(edited, edit); }
void Session::act(const Edit& edit, const Watch&) {
  Edited next = edited_;
  apply(next, edit);
  take_over(std::move(next), setting_);
  if (!edits_.empty() && replaces(edit, edits_.back())) edits_.pop_back();
  edits_.push_back(edit);
}

template <class Other>
void Session::act(const Other& other, const Watch&) {
  not_built(fmt::format("the action '{}'", name_of(Action(other))));
}

void Session::update(Problem problem) {
  auto original = std::make_shared<const Problem>(std::move(problem));
  // What has been edited stays so, as in a text whose later lines declare more; knots that a refinement chose, too.
  Edited next{*original, {}};
  std::vector<Action> kept;
  for (const Action& edit : edits_) {
    if (apply_where_it_fits(next, edit)) kept.push_back(edit);
  }
  for (Dof& dof : next.problem.dofs) {
    const auto declared = std::ranges::find(original_->dofs, dof.name, &Dof::name);
    if (declared == original_->dofs.end() || declared->basis != dof.basis) continue;
    dof.basis = edited_.problem.dofs[static_cast<std::size_t>(declared - original_->dofs.begin())].basis;
  }
  Problem effect = in_effect(next, declared_);
  if (same_to_iterate(effect, now_->problem)) {
    // More to look at, or to be named by later actions: nothing that the iterations know of.
    now_->problem.programs.merge(effect.programs);
    now_->problem.plots = std::move(effect.plots);
    now_->problem.bodies = std::move(effect.bodies);
    now_->problem.keyframes = std::move(effect.keyframes);
  } else {
    auto numerics = std::make_shared<Numerics>(std::move(effect), setting_);
    const Motion reached = motion();
    auto x = start_of(numerics->problem, numerics->whole, &reached);
    const bool same_dofs = numerics->problem.dofs == now_->problem.dofs;
    const auto dual = same_dofs ? std::optional(carried(now_->t(), now_->layout, state_, numerics->t())) : std::nullopt;
    now_ = std::move(numerics);
    restart(std::move(x), dual ? &*dual : nullptr);
  }
  original_ = std::move(original);
  edited_ = std::move(next);
  edits_ = std::move(kept);
}

void Session::set_motion(const Motion& motion) {
  if (motion.checkpoint) return resume(motion);
  // Its knots come with it: those that a refinement chose are nowhere else.
  Edited next = edited_;
  bool other = false;
  for (Dof& dof : next.problem.dofs) {
    const auto from = std::ranges::find(motion.dofs, dof.name, &Trajectory::name);
    if (from == motion.dofs.end() || from->basis == dof.basis) continue;
    const auto &knots = from->basis.knots, &own = dof.basis.knots;
    if (knots.front() != own.front() || knots.back() != own.back()) continue;
    dof.basis = from->basis;
    other = true;
  }
  auto numerics = other ? std::make_shared<Numerics>(in_effect(next, declared_), setting_) : now_;
  auto x = start_of(numerics->problem, numerics->whole, &motion);
  if (other) edited_ = std::move(next);
  now_ = std::move(numerics);
  state_.iterations = motion.iterations;
  restart(std::move(x));
}

// Goes on with another problem, window or damping from the same motion, or from these curves of the new problem.  What
// cannot be is refused here, before anything is lost.
void Session::take_over(Edited edited, const Setting& setting, const Curves* curves) {
  auto numerics = std::make_shared<Numerics>(in_effect(edited, declared_), setting);
  auto x = curves ? unknowns(*curves) : settled();
  const Carried dual = carried(now_->t(), now_->layout, state_, numerics->t());
  edited_ = std::move(edited);
  setting_ = setting;
  now_ = std::move(numerics);
  restart(std::move(x), &dual);
}

Curves Session::curves() const { return curves_of(now_->whole, unknowns()); }

void Session::reshape(const Curves& curves) {
  auto x = unknowns();
  auto to = x.begin();
  for (const auto& curve : curves) to = std::ranges::copy(curve, to).out;
  const Carried dual = carried(now_->t(), now_->layout, state_, now_->t());
  restart(std::move(x), &dual);
}

// Goes on from x with the problem as it stands.
void Session::restart(std::vector<double> x, const Carried* carried) {
  const int iterations = state_.iterations;
  const Seconds seconds = state_.seconds;
  ++restarts_;
  minima_.clear();
  objective_outside_ = 0;
  terms_outside_.clear();
  x_ = std::move(x);
  auto own = now_->open(x_);
  if (now_->part) {
    Workspace workspace;
    const Values whole = evaluate(now_->whole, x_, workspace), part = evaluate(*now_->part, own, workspace);
    objective_outside_ = whole.objective - part.objective;
    const auto inside = terms_of(*now_->part, part);
    for (const auto& [name, value] : terms_of(now_->whole, whole)) {
      terms_outside_.push_back(value - inside[terms_outside_.size()].second);
    }
  }
  state_ = now_->newton.start(std::move(own), carried);
  state_.iterations = iterations;
  state_.seconds.evaluate += seconds.evaluate;
  state_.seconds.factor += seconds.factor;
  judged_ = false;
  other_ = {};
}

double Session::elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

IterationRecord Session::record() const {
  auto terms = terms_of(now_->t(), state_.values);
  for (std::size_t k = 0; k < terms_outside_.size(); ++k) terms[k].second += terms_outside_[k];
  return {state_.iterations,
          state_.values.objective + objective_outside_,
          std::move(terms),
          state_.measures.violation,
          state_.measures.stationarity,
          state_.step,
          state_.shift_used,
          elapsed()};
}

std::vector<Trajectory> Session::trajectories() const {
  const Transcription& t = now_->whole;
  const auto x = unknowns();
  std::vector<Trajectory> result;
  for (int dof = 0; dof < t.dofs(); ++dof) {
    result.push_back({now_->problem.dofs[dof].name,
                      now_->problem.dofs[dof].basis,
                      {x.begin() + t.first[dof], x.begin() + t.first[dof + 1]}});
  }
  return result;
}

std::vector<double> Session::unknowns() const {
  auto x = x_;
  now_->close(state_.x, x);
  return x;
}

// The present unknowns with other curves, of as many coefficients as these have.
std::vector<double> Session::unknowns(const Curves& curves) const {
  const auto present = settled();
  std::vector<double> x;
  for (const auto& curve : curves) x.insert(x.end(), curve.begin(), curve.end());
  x.insert(x.end(), present.begin() + now_->whole.first_functional(), present.end());
  return x;
}

std::vector<std::pair<std::string, double>> Session::parameters() const {
  const auto x = unknowns();
  std::vector<std::pair<std::string, double>> result;
  for (std::size_t k = 0; k < now_->problem.parameters.size(); ++k) {
    result.emplace_back(now_->problem.parameters[k].name, x[now_->whole.first_parameter() + k]);
  }
  return result;
}

// The unknowns with functionals at their true values, so that each relation is measured in its own units.
std::vector<double> Session::settled() const {
  Workspace workspace;
  auto x = unknowns();
  settle_functionals(now_->whole, x, workspace);
  return x;
}

Motion Session::motion(double tolerance) {
  if (!judged_) judge(tolerance);
  const Transcription& t = now_->whole;
  const Problem& problem = now_->problem;
  const auto x = settled();

  Motion motion;
  motion.start = problem.start;
  motion.end = problem.end;
  motion.status = outcome_.status;
  motion.message = outcome_.message + remark_of(now_->newton.pivoted_solves());
  motion.iterations = state_.iterations;
  Workspace workspace;
  const auto active = now_->part ? active_rows(t, x, workspace) : state_.active;
  measure(t, x, evaluate(t, x, workspace, active), motion);
  add_multipliers(multipliers(), motion);
  motion.dofs = trajectories();
  motion.parameters = parameters();
  for (const Constant& constant : problem.constants) {
    motion.constants.emplace_back(constant.name, t.constants.at(constant.name));
  }
  motion.minima = minima_;
  add_bodies(problem, motion);
  motion.seconds = state_.seconds;
  motion.seconds.total = elapsed();
  return motion;
}

// They mean something where the state is Newton's own, judged, and neither infeasible nor failed.
std::vector<Multipliers> Session::multipliers() const {
  const Status status = outcome_.status;
  if (foreign() || status == Status::infeasible || status == Status::failed) return {};
  if (state_.condition != StepResult::stepped) return {};
  return multipliers_of(now_->t(), now_->layout, state_);
}

Samples Session::samples(std::span<const double> times) const {
  const Transcription& t = now_->whole;
  const auto x = settled();
  Motion motion;  // what samples are taken of
  motion.dofs = trajectories();
  motion.parameters = parameters();
  for (const Constant& constant : now_->problem.constants) {
    motion.constants.emplace_back(constant.name, t.constants.at(constant.name));
  }
  return sample(now_->problem, motion, std::span(x).subspan(t.first_functional()), times);
}

}  // namespace spacetime::optimizer
