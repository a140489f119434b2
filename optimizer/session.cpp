#include "optimizer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

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

Session::Session(Problem problem, std::optional<Motion> start, int declared)
    : original_(std::make_shared<Problem>(std::move(problem))),
      edited_{*original_, {}},
      start_(std::move(start)),
      declared_(declared),
      now_(std::make_shared<Numerics>(in_effect(edited_, declared_), setting_)) {
  restart(start_of(now_->problem, now_->whole, start_ ? &*start_ : nullptr));
}

void Session::declare(int action) {
  const auto begins = [&](const auto& statement) { return statement.since > declared_ && statement.since <= action; };
  const bool more = std::ranges::any_of(edited_.problem.constraints, begins) ||
                    std::ranges::any_of(edited_.problem.objective, begins);
  const int before = std::exchange(declared_, std::max(declared_, action));
  if (!more) return;
  try {
    take_over(edited_, setting_);
  } catch (...) {
    declared_ = before;
    throw;
  }
}

void Session::perform(const Action& action, const Watch& watch) {
  mend();
  std::visit([&](const auto& which) { act(which, watch); }, action);
}

void Session::act(const Reset&, const Watch&) {
  // Keyframes that were declared meanwhile count from here on.
  restart(start_of(in_effect(edited_, declared_), now_->whole, start_ ? &*start_ : nullptr));
}

void Session::act(const Window& window, const Watch&) {
  Setting setting = setting_;
  setting.window = window;
  take_over(edited_, std::move(setting));
}

void Session::act(const Damp& damp, const Watch&) {
  const double limit = evaluate(now_->problem, now_->whole.constants, damp.limit, "damp");
  if (!(limit > 0)) throw InputError(fmt::format("the limit of `damp`, {}, must be positive", limit));
  Setting setting = setting_;
  for (const Dof& dof : now_->problem.dofs) {
    if (damp.dofs.empty() || std::ranges::count(damp.dofs, dof.name) > 0) setting.damping[dof.name] = limit;
  }
  take_over(edited_, std::move(setting));
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
  auto edits = edits_;
  if (!edits.empty() && replaces(edit, edits.back())) edits.pop_back();
  edits.push_back(edit);
  take_over(std::move(next), setting_);
  edits_ = std::move(edits);
}

template <class Other>
void Session::act(const Other& other, const Watch&) {
  not_built(fmt::format("the action '{}'", name_of(Action(other))));
}

void Session::update(Problem problem, double most_unknowns) {
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
  if (const double unknowns = count_unknowns(next.problem); unknowns > most_unknowns) {
    throw InputError(fmt::format("on the knots that `refine` chose the problem has {:.0f} unknowns, more than {:.0f}",
                                 unknowns, most_unknowns));
  }
  Problem effect = in_effect(next, declared_);
  if (same_to_iterate(effect, now_->problem)) {
    // More to look at, or to be named by later actions: nothing that the iterations know of.  The programs they refer
    // to stay where they are.
    std::erase_if(now_->problem.programs,
                  [&](const auto& program) { return !effect.programs.contains(program.first); });
    now_->problem.programs.merge(effect.programs);
    now_->problem.plots = std::move(effect.plots);
    now_->problem.bodies = std::move(effect.bodies);
    now_->problem.keyframes = std::move(effect.keyframes);
  } else {
    auto numerics = std::make_shared<Numerics>(std::move(effect), setting_);
    const Motion reached = bare();
    auto x = start_of(numerics->problem, numerics->whole, &reached);
    const Carried dual = carried(now_->t(), now_->layout, state_, numerics->t());
    go_on_from(stand(std::move(numerics), std::move(x), &dual));
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
  Standing there = stand(std::move(numerics), std::move(x), nullptr);
  edited_ = std::move(next);
  go_on_from(std::move(there));
  state_.iterations = motion.iterations;
}

// Goes on with another problem, window or damping from the same motion, or from these curves of the new problem.  What
// cannot be is refused here, before anything is lost.
void Session::take_over(Edited edited, Setting setting, const Curves* curves) {
  auto numerics = std::make_shared<Numerics>(in_effect(edited, declared_), setting);
  auto x = curves ? unknowns(*curves) : settled();
  const Carried dual = carried(now_->t(), now_->layout, state_, numerics->t());
  Standing there = stand(std::move(numerics), std::move(x), &dual);
  edited_ = std::move(edited);
  setting_ = std::move(setting);
  go_on_from(std::move(there));
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
void Session::restart(std::vector<double> x, const Carried* carried) { go_on_from(stand(now_, std::move(x), carried)); }

Session::Standing Session::stand(std::shared_ptr<Numerics> numerics, std::vector<double> x,
                                 const Carried* carried) const {
  if (numerics == now_ && numerics->part && numerics->whole.functionals() > 0) {
    // What functionals come to outside the window stands in the part, which threads of many starts may be reading.
    numerics = std::make_shared<Numerics>(now_->problem, setting_);
    numerics->newton.set_pivoted_solves(now_->newton.pivoted_solves());
  }
  Standing there;
  there.numerics = std::move(numerics);
  there.x = std::move(x);
  Numerics& next = *there.numerics;
  auto own = next.open(there.x);
  if (next.part) {
    Workspace workspace;
    const Values whole = evaluate(next.whole, there.x, workspace), part = evaluate(*next.part, own, workspace);
    there.objective_outside = whole.objective - part.objective;
    const auto inside = terms_of(*next.part, part);
    for (const auto& [name, value] : terms_of(next.whole, whole)) {
      there.terms_outside.push_back(value - inside[there.terms_outside.size()].second);
    }
  }
  there.state = next.newton.start(std::move(own), carried);
  return there;
}

void Session::go_on_from(Standing there) noexcept {
  there.state.iterations = state_.iterations;
  there.state.seconds.evaluate += state_.seconds.evaluate;
  there.state.seconds.factor += state_.seconds.factor;
  now_ = std::move(there.numerics);
  x_ = std::move(there.x);
  objective_outside_ = there.objective_outside;
  terms_outside_ = std::move(there.terms_outside);
  state_ = std::move(there.state);
  ++restarts_;
  minima_.clear();
  judged_ = false;
  torn_ = false;
  other_ = {};
}

void Session::mend() {
  if (torn_) restart(unknowns());
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

std::vector<Trajectory> Session::trajectories() const { return trajectories(unknowns()); }

std::vector<Trajectory> Session::trajectories(const std::vector<double>& x) const {
  const Transcription& t = now_->whole;
  std::vector<Trajectory> result;
  for (int dof = 0; dof < t.dofs(); ++dof) {
    result.push_back({now_->problem.dofs[dof].name,
                      now_->problem.dofs[dof].basis,
                      {x.begin() + t.first[dof], x.begin() + t.first[dof + 1]}});
  }
  return result;
}

std::vector<double> Session::unknowns() const {
  if (!now_->part) return state_.x;
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
  std::vector<std::pair<std::string, double>> result;
  if (now_->problem.parameters.empty()) return result;
  const auto x = unknowns();
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

Motion Session::bare() const {
  Motion motion;
  motion.start = now_->problem.start;
  motion.end = now_->problem.end;
  motion.dofs = trajectories();
  motion.parameters = parameters();
  return motion;
}

std::vector<std::pair<std::string, double>> Session::constants() const {
  std::vector<std::pair<std::string, double>> result;
  for (const Constant& constant : now_->problem.constants) {
    result.emplace_back(constant.name, now_->whole.constants.at(constant.name));
  }
  return result;
}

Motion Session::motion(double tolerance) {
  mend();
  if (!judged_) judge(tolerance);
  const Transcription& t = now_->whole;
  const Problem& problem = now_->problem;
  const auto x = settled();

  Motion motion = bare();
  motion.status = outcome_.status;
  motion.message = outcome_.message + remark_of(now_->newton.pivoted_solves());
  motion.iterations = state_.iterations;
  Workspace workspace;
  const auto active = now_->part ? active_rows(t, x, workspace) : state_.active;
  measure(t, x, evaluate(t, x, workspace, active), motion);
  add_multipliers(multipliers(), motion);
  motion.constants = constants();
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

Samples Session::samples(std::span<const double> times, const std::set<std::string>* wanted) const {
  const auto x = settled();
  Motion motion = bare();
  motion.constants = constants();
  return sample(now_->problem, motion, std::span(x).subspan(now_->whole.first_functional()), times, wanted);
}

}  // namespace spacetime::optimizer
