// A session's checkpoint: how it is taken, and how a session goes on from one.
#include <fmt/format.h>

#include <algorithm>

#include "common/diagnostic.h"
#include "optimizer/resume.h"
#include "optimizer/session.h"
#include "optimizer/window.h"

namespace spacetime::optimizer {

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
  if (now_->part) at.outside = {objective_outside_, terms_outside_, now_->part->elsewhere};
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
  Motion motion = bare();
  motion.status = outcome_.status;
  motion.message = outcome_.message;
  motion.iterations = state_.iterations;
  motion.minima = minima_;
  motion.checkpoint = checkpoint();
  return motion;
}

// All is made before anything is changed: what does not fit is refused on the way.
void Session::resume(const Motion& motion) {
  const Checkpoint& at = *motion.checkpoint;
  Edited edited{*original_, {}};
  for (std::size_t i = 0; i < at.edits.size(); ++i) {
    if (!apply_edit(edited, at.edits[i])) {
      throw CheckpointError(fmt::format("/checkpoint/edits/{}", i), "this action does not edit the problem");
    }
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
  for (const Parameter& parameter : edited.problem.parameters) {
    const auto own = std::ranges::find(motion.parameters, parameter.name, &std::pair<std::string, double>::first);
    if (own == motion.parameters.end()) {
      throw CheckpointError("/parameters", fmt::format("'{}' is missing, which the problem has", parameter.name));
    }
    x.push_back(own->second);
  }

  auto own = x;
  if (auto& part = numerics->part) {
    if (!at.outside) throw CheckpointError("/checkpoint", "a window needs the member 'outside'");
    require_size("/checkpoint/outside/functionals", at.outside->functionals.size(), whole.functionals());
    if (!at.outside->terms.empty()) {
      require_size("/checkpoint/outside/terms", at.outside->terms.size(), count_of_terms(whole));
    }
    part->elsewhere = at.outside->functionals;
    own = taken(whole, *part, x);
  } else if (at.outside) {
    throw CheckpointError("/checkpoint/outside", "there is no window that anything could be outside of");
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

  std::optional<Motion> start;
  if (at.start) {
    start.emplace();
    start->dofs = at.start->dofs;
    start->parameters = at.start->parameters;
  }
  auto edits = at.edits;
  auto terms_outside = at.outside ? at.outside->terms : std::vector<double>{};
  auto minima = motion.minima;
  Outcome outcome{motion.status, motion.message};
  const std::string remark = remark_of(at.pivoted);
  if (!remark.empty() && outcome.message.ends_with(remark)) {
    outcome.message.resize(outcome.message.size() - remark.size());
  }

  edited_ = std::move(edited);
  edits_ = std::move(edits);
  start_ = std::move(start);
  declared_ = at.declared;
  setting_ = std::move(setting);
  shakes_ = at.shakes;
  now_ = std::move(numerics);
  x_ = std::move(x);
  objective_outside_ = at.outside ? at.outside->objective : 0;
  terms_outside_ = std::move(terms_outside);
  state_ = std::move(state);
  ++restarts_;
  other_ = std::move(other);
  minima_ = std::move(minima);
  outcome_ = std::move(outcome);
  judged_ = at.judged;
  torn_ = false;
}

}  // namespace spacetime::optimizer
