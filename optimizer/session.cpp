#include "optimizer/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <type_traits>

#include "common/diagnostic.h"
#include "common/sample.h"
#include "optimizer/carry.h"
#include "optimizer/refine.h"
#include "optimizer/resume.h"
#include "optimizer/sketch.h"
#include "optimizer/window.h"

namespace spacetime::optimizer {
namespace {

[[noreturn]] void not_built(std::string_view what) { throw InputError(fmt::format("{} is not built yet", what)); }

// Where a problem starts: its keyframes and declared values, or a motion as far as it goes.
std::vector<double> start_of(const Problem& problem, const Transcription& t, const Motion* from) {
  auto x = from ? sketch_from(problem, t.constants, *from) : sketch(problem, t.constants);
  x.resize(t.unknowns(), 0.0);
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    const Parameter& parameter = problem.parameters[k];
    double& p = x[t.first_parameter() + k];
    p = evaluate(problem, t.constants, parameter.start, "the start of " + parameter.name);
    if (!from) continue;
    for (const auto& [name, value] : from->parameters) {
      if (name == parameter.name) p = value;
    }
  }
  return x;
}

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

// Whether an edit leaves nothing of the one before it, so that a value that is dragged is kept once.
template <class Edit>
bool replaces(const Edit& edit, const Action& before) {
  const Edit* other = std::get_if<Edit>(&before);
  if (!other) return false;
  if constexpr (std::is_same_v<Edit, SetConstant>)
    return edit.constant == other->constant && edit.value.program.empty();
  if constexpr (std::is_same_v<Edit, SetWeight>) return edit.name == other->name;
  if constexpr (std::is_same_v<Edit, Bound>) return edit.dof == other->dof;
  return false;
}

// Performs an edit on a problem that need not be the one it was made for; false where it makes no sense there.
bool performed(Edited& edited, const Action& action) {
  const auto perform = [&](const auto& edit) {
    if constexpr (std::is_same_v<std::decay_t<decltype(edit)>, Replace>) {
      const auto fits = [&](const auto& list) {
        return static_cast<std::size_t>(edit.with) < list.size() && list[edit.with].replacement &&
               list[edit.with].name == edit.name;
      };
      if (!fits(edited.problem.constraints) && !fits(edited.problem.objective)) return false;
    }
    if constexpr (requires { apply(edited, edit); }) {
      apply(edited, edit);
      return true;
    }
    return false;
  };
  try {
    return std::visit(perform, action);
  } catch (const InputError&) {
    return false;
  }
}

Curves curves_of(const Transcription& whole, const std::vector<double>& x) {
  Curves curves;
  for (int dof = 0; dof < whole.dofs(); ++dof) {
    curves.emplace_back(x.begin() + whole.first[dof], x.begin() + whole.first[dof + 1]);
  }
  return curves;
}

// Whether two problems differ in nothing that iterations depend on.
bool same_to_iterate(const Problem& a, const Problem& b) {
  return a.start == b.start && a.end == b.end && a.constants == b.constants && a.parameters == b.parameters &&
         a.dofs == b.dofs && a.functionals == b.functionals && a.constraints == b.constraints &&
         a.objective == b.objective;
}

// What a motion's message has at its end.
std::string remark_of(int pivoted) {
  return pivoted > 0 ? fmt::format(" ({} of the steps needed a pivoted solve.)", pivoted) : "";
}

}  // namespace

bool is_edit(const Action& action) {
  return !std::holds_alternative<Solve>(action) && !std::holds_alternative<Iterate>(action);
}

Session::Numerics::Numerics(Problem p, const Setting& setting)
    : problem(std::move(p)),
      whole(transcribe(problem)),
      freedom(within(problem, whole.constants, setting.window)),
      part(freedom.whole ? std::nullopt : std::optional(transcribe(problem, freedom))),
      layout(arrange(t())),
      newton(t(), layout) {
  Transcription& iterated = part ? *part : whole;
  for (int dof = 0; dof < iterated.dofs(); ++dof) {
    const auto limit = setting.damping.find(problem.dofs[dof].name);
    if (limit == setting.damping.end()) continue;
    std::fill_n(iterated.most_change.begin() + iterated.first[dof], iterated.first[dof + 1] - iterated.first[dof],
                limit->second);
  }
}

std::vector<double> Session::Numerics::open(std::vector<double>& x) {
  if (!part) return x;
  Workspace workspace;
  settle_functionals(whole, x, workspace);
  settle_elsewhere(whole, *part, x);
  return taken(whole, *part, x);
}

void Session::Numerics::close(const std::vector<double>& own, std::vector<double>& x) const {
  if (part) {
    put_back(whole, *part, own, x);
  } else {
    x = own;
  }
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
  if (action.automatic) {
    return refine_where_needed(evaluate(now_->problem, now_->whole.constants, *action.automatic, "refine auto"));
  }
  Edited next = edited_;
  Curves finer = curves();
  refine(next.problem, now_->whole.constants, action, finer);
  take_over(std::move(next), setting_, &finer);
}

// Halves the spans on which one step on knots twice as fine moves the motion by more than the tolerance.
void Session::refine_where_needed(double tolerance) {
  if (!(tolerance > 0))
    throw InputError(fmt::format("the tolerance of `refine auto`, {}, must be positive", tolerance));
  Edited halved = edited_;
  Curves before = curves();
  refine(halved.problem, now_->whole.constants, Refine{}, before);
  Numerics finer(in_effect(halved, declared_), setting_);
  auto x = unknowns(before);
  const Carried dual = carried(now_->t(), now_->layout, state_, finer.t());
  NewtonState state = finer.newton.start(finer.open(x), &dual);
  finer.newton.step(state, std::numeric_limits<double>::min());
  finer.close(state.x, x);
  const Curves after = curves_of(finer.whole, x);

  Edited next = edited_;
  Curves result = curves();
  for (std::size_t dof = 0; dof < result.size(); ++dof) {
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
    if (performed(next, edit)) kept.push_back(edit);
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
  x_ = std::move(x);
  auto own = now_->open(x_);
  if (now_->part) {
    Workspace workspace;
    objective_outside_ =
        evaluate(now_->whole, x_, workspace).objective - evaluate(*now_->part, own, workspace).objective;
  }
  state_ = now_->newton.start(std::move(own), carried);
  state_.iterations = iterations;
  state_.seconds.evaluate += seconds.evaluate;
  state_.seconds.factor += seconds.factor;
  judged_ = false;
  other_ = {};
}

Checkpoint Session::checkpoint() const {
  const Transcription& t = now_->whole;
  Checkpoint at;
  at.declared = declared_;
  at.edits = edits_;
  at.window = setting_.window;
  at.damping = {setting_.damping.begin(), setting_.damping.end()};
  at.shakes = shakes_;
  if (start_) at.start = {start_->dofs, start_->parameters};
  at.judged = judged_;
  const auto x = unknowns();
  at.functionals = {x.begin() + t.first_functional(), x.begin() + t.first_parameter()};
  if (now_->part) at.outside = {objective_outside_, now_->part->elsewhere};
  at.step = state_.step;
  at.last_shift = state_.shift_used;
  at.pivoted = now_->newton.pivoted_solves();
  at.newton = kept(now_->t(), now_->layout, state_);
  if (const auto* state = std::get_if<Sqp92State>(&other_)) at.sqp92 = kept(now_->layout, *state);
  if (const auto* state = std::get_if<BfgsState>(&other_)) {
    const Eigen::MatrixXd& inverse = state->inverse;
    refuse_checkpoint(static_cast<int>(inverse.rows()));
    auto& rows = at.bfgs.emplace().inverse;
    for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) rows.push_back(inverse(i, j));
    }
  }
  return at;
}

Motion Session::moment() const {
  Motion motion;
  motion.start = now_->problem.start;
  motion.end = now_->problem.end;
  motion.status = outcome_.status;
  motion.message = outcome_.message;
  motion.iterations = state_.iterations;
  motion.dofs = trajectories();
  motion.parameters = parameters();
  motion.minima = minima_;
  motion.checkpoint = checkpoint();
  return motion;
}

// All is made before anything is changed: what does not fit is refused on the way.
void Session::resume(const Motion& motion) {
  const Checkpoint& at = *motion.checkpoint;
  Edited edited{*original_, {}};
  for (std::size_t i = 0; i < at.edits.size(); ++i) {
    const auto perform = [&](const auto& edit) {
      if constexpr (requires { apply(edited, edit); }) {
        apply(edited, edit);
      } else {
        throw CheckpointError(fmt::format("/checkpoint/edits/{}", i), "this action does not edit the problem");
      }
    };
    std::visit(perform, at.edits[i]);
  }
  std::vector<double> x;
  require_size("/dofs", motion.dofs.size(), edited.problem.dofs.size());
  for (std::size_t k = 0; k < motion.dofs.size(); ++k) {
    Dof& dof = edited.problem.dofs[k];
    if (dof.name != motion.dofs[k].name) {
      throw CheckpointError(fmt::format("/dofs/{}/name", k), fmt::format("the problem has '{}' here", dof.name));
    }
    dof.basis = motion.dofs[k].basis;
    require_size(fmt::format("/dofs/{}/coefficients", k), motion.dofs[k].coefficients.size(), dof.basis.size());
    x.insert(x.end(), motion.dofs[k].coefficients.begin(), motion.dofs[k].coefficients.end());
  }
  Setting setting{at.window, {at.damping.begin(), at.damping.end()}};
  auto numerics = std::make_shared<Numerics>(in_effect(edited, at.declared), setting);
  const Transcription& whole = numerics->whole;
  require_size("/checkpoint/functionals", at.functionals.size(), whole.functionals());
  x.insert(x.end(), at.functionals.begin(), at.functionals.end());
  require_size("/parameters", motion.parameters.size(), edited.problem.parameters.size());
  for (const auto& [name, value] : motion.parameters) x.push_back(value);

  auto own = x;
  if (auto& part = numerics->part) {
    if (!at.outside) throw CheckpointError("/checkpoint", "a window needs the member 'outside'");
    require_size("/checkpoint/outside/functionals", at.outside->functionals.size(), whole.functionals());
    part->elsewhere = at.outside->functionals;
    own = taken(whole, *part, x);
  }
  const Transcription& t = numerics->t();
  NewtonState state = brought_back(t, numerics->layout, at.newton, std::move(own));
  numerics->newton.complete(state);
  numerics->newton.set_pivoted_solves(at.pivoted);
  state.iterations = motion.iterations;
  state.step = at.step;
  state.shift_used = at.last_shift;
  decltype(other_) other;
  const auto bring_back = [&](auto found) {
    found.step = state.step;
    found.shift = state.shift_used;
    state.measures = found.measures;
    state.condition = StepResult::stepped;
    other = std::move(found);
  };
  if (at.sqp92) {
    require_size("/checkpoint/sqp92/multipliers", at.sqp92->multipliers.size(), t.rows.size());
    require_size("/checkpoint/sqp92/weights", at.sqp92->weights.size(), t.rows.size());
    Sqp92 method(t, numerics->layout, false);
    bring_back(method.resume(state.x, at.sqp92->multipliers, at.sqp92->weights));
  } else if (at.bfgs) {
    Bfgs method(t, numerics->layout);
    require_size("/checkpoint/bfgs/inverse", at.bfgs->inverse.size(), method.size() * (method.size() + 1) / 2);
    bring_back(method.resume(state.x, at.bfgs->inverse));
  }

  edited_ = std::move(edited);
  edits_ = at.edits;
  start_.reset();
  if (at.start) {
    start_.emplace();
    start_->dofs = at.start->dofs;
    start_->parameters = at.start->parameters;
  }
  declared_ = at.declared;
  setting_ = std::move(setting);
  shakes_ = at.shakes;
  now_ = std::move(numerics);
  x_ = std::move(x);
  objective_outside_ = at.outside ? at.outside->objective : 0;
  state_ = std::move(state);
  ++restarts_;
  other_ = std::move(other);
  minima_ = motion.minima;
  outcome_ = {motion.status, motion.message};
  const std::string remark = remark_of(at.pivoted);
  if (!remark.empty() && outcome_.message.ends_with(remark)) {
    outcome_.message.resize(outcome_.message.size() - remark.size());
  }
  judged_ = at.judged;
}

double Session::elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }

IterationRecord Session::record() const {
  return {state_.iterations,
          state_.values.objective + objective_outside_,
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
  if (!foreign()) add_multipliers(now_->t(), now_->layout, state_, motion);
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
