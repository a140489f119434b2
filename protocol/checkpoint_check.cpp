#include <algorithm>
#include <cmath>
#include <string>

#include "protocol/check.h"
#include "protocol/checkpoint_json.h"
#include "protocol/declared.h"
#include "protocol/limits.h"
#include "protocol/path.h"
#include "protocol/problem_json.h"

namespace spacetime {
namespace {

constexpr int most_switches = 127;

// Throws what it finds.  Of a motion that failed numbers may be missing.
class Check {
 public:
  explicit Check(bool failed) : failed_(failed) {}

  void number(double value, const std::string& path, bool may_lack = false) const {
    if (const char* wrong = wrong_with(value, may_lack)) fail(path, wrong);
  }
  void not_negative(double value, const std::string& path, bool may_lack = false) const {
    number(value, path, may_lack);
    if (value < 0) fail(path, negative);
  }
  // Of long lists: a place is only told where something is wrong there.
  void numbers(const std::vector<double>& values, const std::string& path, bool may_lack = false) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (const char* wrong = wrong_with(values[i], may_lack)) fail(below(path, i), wrong);
    }
  }
  void none_negative(const std::vector<double>& values, const std::string& path, bool may_lack = false) const {
    numbers(values, path, may_lack);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 0) fail(below(path, i), negative);
    }
  }
  static void count(int value, int most, const std::string& path) {
    if (value < 0 || value > most) fail(path, "must be from 0 to " + std::to_string(most));
  }
  static void counts(const std::vector<int>& values, int most, const std::string& path) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < 0 || values[i] > most) count(values[i], most, below(path, i));
    }
  }

 private:
  static constexpr const char* negative = "must not be negative";
  const char* wrong_with(double value, bool may_lack) const {
    return std::isfinite(value) || (failed_ && may_lack) ? nullptr : "must be finite";
  }
  const bool failed_;
};

void check(const Checkpoint::Newton& newton, const Check& all, const std::string& path) {
  all.not_negative(newton.mu, path + "/mu");
  all.none_negative(newton.slacks, path + "/slacks", true);
  all.none_negative(newton.multipliers, path + "/multipliers", true);
  all.none_negative(newton.lower, path + "/lower", true);
  all.none_negative(newton.upper, path + "/upper", true);
  all.counts(newton.active, 1, path + "/active");
  all.counts(newton.switches, most_switches, path + "/switches");
  for (std::size_t i = 0; i < newton.filter.size(); ++i) {
    const auto& [violation, objective] = newton.filter[i];
    if (std::isfinite(violation) && std::isfinite(objective)) continue;
    all.number(violation, below(path + "/filter", i) + "/0");
    all.number(objective, below(path + "/filter", i) + "/1");
  }
  all.not_negative(newton.filter_limit, path + "/filter_limit", true);
  all.not_negative(newton.most_violation, path + "/most_violation", true);
  all.not_negative(newton.shift, path + "/shift");
  all.not_negative(newton.radius, path + "/radius");
  all.not_negative(newton.restore_from, path + "/restore_from");
  all.not_negative(newton.damping, path + "/damping");
  all.not_negative(newton.least_sum, path + "/least_sum");
  all.count(newton.without_progress, limits::count, path + "/without_progress");
  all.numbers(newton.proposed, path + "/proposed");
  if (newton.restore_from > 0 && newton.damping == 0) {
    fail(path + "/damping", "must be positive while the violation is reduced");
  }
}

void check(const Checkpoint::Start& start, const Check& all, const std::string& path) {
  Names dofs, parameters;
  for (std::size_t i = 0; i < start.dofs.size(); ++i) {
    const auto& [name, basis, coefficients] = start.dofs[i];
    const auto own = below(path + "/dofs", i);
    check_name(name, own + "/name", dofs);
    const auto& knots = basis.knots;
    const double from = knots.empty() ? 0 : knots.front(), to = knots.empty() ? 0 : knots.back();
    if (auto fault = validate(basis, from, to, own + "/basis")) throw Fault(*std::move(fault));
    if (coefficients.size() + 4 != knots.size()) fail(own + "/coefficients", "must be four fewer than knots");
    all.numbers(coefficients, own + "/coefficients");
  }
  for (const auto& [name, value] : start.parameters) {
    check_name(name, below(path + "/parameters", name), parameters);
    all.number(value, below(path + "/parameters", name));
  }
}

void check(const Checkpoint& checkpoint, const Motion& motion) {
  const std::string path = "/checkpoint";
  const Check all{motion.status == Status::failed};
  if (const auto& progress = checkpoint.progress) {
    all.count(progress->action, limits::count, path + "/progress/action");
    all.count(progress->iterations, motion.iterations, path + "/progress/iterations");
  }
  if (checkpoint.declared < 0) fail(path + "/declared", "must not be negative");
  Names damped;
  for (const auto& [name, limit] : checkpoint.damping) {
    const auto own = below(path + "/damping", name);
    check_name(name, own, damped);
    all.number(limit, own);
    if (!(limit > 0)) fail(own, "must be positive");
  }
  all.count(checkpoint.shakes, limits::count, path + "/shakes");
  if (checkpoint.start) check(*checkpoint.start, all, path + "/start");
  all.numbers(checkpoint.functionals, path + "/functionals");
  if (const auto& outside = checkpoint.outside) {
    all.number(outside->objective, path + "/outside/objective", true);
    all.numbers(outside->terms, path + "/outside/terms", true);
    all.numbers(outside->functionals, path + "/outside/functionals", true);
  }
  all.number(checkpoint.step, path + "/step");
  all.number(checkpoint.last_shift, path + "/shift");
  all.count(checkpoint.pivoted, limits::count, path + "/pivoted");
  check(checkpoint.newton, all, path + "/newton");
  if (checkpoint.sqp92 && checkpoint.bfgs) fail(path + "/bfgs", "only one method can have led here");
  if (checkpoint.sqp92) {
    all.numbers(checkpoint.sqp92->multipliers, path + "/sqp92/multipliers");
    all.none_negative(checkpoint.sqp92->weights, path + "/sqp92/weights");
  }
  if (checkpoint.bfgs) all.numbers(checkpoint.bfgs->inverse, path + "/bfgs/inverse");
  if (checkpoint.fingerprint.empty()) return;
  if (const auto own = fingerprint(motion); own != checkpoint.fingerprint) {
    fail(path + "/fingerprint", "is not that of the motion's numbers, which is " + own + ": " +
                                    std::string(probably_rounded) +
                                    ", or leave out the member 'checkpoint' to go on from the motion alone");
  }
}

[[noreturn]] void fail_as_another(const std::string& path, const std::string& difference) {
  fail(path, difference + "; use the motion without its checkpoint");
}

void check_count(std::size_t found, std::size_t expected, const std::string& path) {
  if (found == expected) return;
  fail_as_another(path, "there are " + std::to_string(found) + ", but the problem has " + std::to_string(expected));
}

void check(const Motion& motion, const Problem& problem) {
  const Checkpoint& checkpoint = *motion.checkpoint;
  if (checkpoint.problem != fingerprint(problem)) {
    fail("/checkpoint/problem",
         "the checkpoint is of another problem, or of another version of this one, and cannot be resumed here; use the "
         "motion without its checkpoint");
  }
  if (motion.start != problem.start || motion.end != problem.end) fail("/time", "is not the problem's");
  check_count(motion.dofs.size(), problem.dofs.size(), "/dofs");
  for (std::size_t i = 0; i < problem.dofs.size(); ++i) {
    const auto &own = problem.dofs[i].name, &found = motion.dofs[i].name;
    if (found != own) fail_as_another("/dofs", "the problem has '" + own + "' where the motion has '" + found + "'");
  }
  check_count(motion.parameters.size(), problem.parameters.size(), "/parameters");
  for (const Parameter& parameter : problem.parameters) {  // members of an object, in any order
    const auto is_it = [&](const auto& named) { return named.first == parameter.name; };
    if (std::ranges::none_of(motion.parameters, is_it)) {
      fail_as_another("/parameters", "the problem has '" + parameter.name + "', which the motion has not");
    }
  }
  const auto actions = static_cast<int>(problem.actions.size());
  if (checkpoint.progress)
    Check::count(checkpoint.progress->action, std::max(1, actions), "/checkpoint/progress/action");
  const Declared declared(problem);
  check_edits(declared, checkpoint.edits, "/checkpoint/edits");
  check_action(declared, checkpoint.window, "/checkpoint/window");
}

template <class... Values>
std::optional<Fault> found(const Values&... values) {
  try {
    check(values...);
  } catch (const Fault& fault) {
    return fault;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Fault> validate(const Checkpoint& checkpoint, const Motion& motion) { return found(checkpoint, motion); }

std::optional<Fault> validate(const Motion& motion, const Problem& problem) {
  if (!motion.checkpoint) return std::nullopt;
  return found(motion, problem);
}

}  // namespace spacetime
