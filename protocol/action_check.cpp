#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>

#include "protocol/declared.h"
#include "protocol/limits.h"
#include "protocol/path.h"

namespace spacetime {
namespace {

// Walks the actions in their order; what one changes is known to those after it.
class Check {
 public:
  explicit Check(const Declared& declared)
      : declared_(declared), problem_(declared.problem()), constraints_(declared.constraints()) {}

  // An action that is not in the list; all statements have been declared.
  void one(const Action& asked, const std::string& path) {
    now_ = alone;
    std::visit([&](const auto& which) { action(which, path); }, asked);
  }

  void all() {
    for (now_ = 0; now_ < problem_.actions.size(); ++now_) {
      const auto path = below("/actions", now_);
      check_place(problem_.actions[now_].place, path);
      std::visit([&](const auto& which) { action(which, path); }, problem_.actions[now_].action);
    }
  }

 private:
  static constexpr auto alone = std::numeric_limits<std::size_t>::max();

  void action(const Solve& solve, const std::string& path) const {
    if (!(solve.tolerance > 0) || !std::isfinite(solve.tolerance)) fail(path + "/tolerance", "must be positive");
    if (solve.iterations.value_or(0) < 0) fail(path + "/iterations", "must not be negative");
    if (solve.starts < 1 || solve.starts > limits::starts) {
      fail(path + "/starts", "must be from 1 to " + std::to_string(limits::starts));
    }
    // In a problem's list it is refused when its turn comes, by who knows what the methods can do.
    if (now_ == alone && solve.starts > 1 && solve.method != Solve::Method::newton) {
      fail(path + "/method", "only the method \"newton\" solves from many starts");
    }
    if (solve.linear_cg && solve.method != Solve::Method::sqp92) {
      fail(path + "/linear_cg", "belongs to the method \"sqp92\" alone");
    }
  }

  void action(const Iterate& iterate, const std::string& path) const {
    if (iterate.iterations < 0) fail(path + "/iterations", "must not be negative");
  }

  void action(const Window& window, const std::string& path) const {
    interval(window.interval, path);
    dofs(window.dofs, path);
    if (!window.interval) return;
    const auto& [from, to] = *window.interval;
    const auto misses = [&](const char* end) { fail(path + end, "this window does not meet the problem's time"); };
    if (from.program.empty() && from.number > problem_.end) misses("/from");
    if (to.program.empty() && to.number < problem_.start) misses("/to");
  }

  void action(const Refine& refine, const std::string& path) {
    interval(refine.interval, path);
    dofs(refine.dofs, path);
    if (refine.times < 1 || refine.times > limits::halvings) {
      fail(path + "/times", "must be from 1 to " + std::to_string(limits::halvings));
    }
    if (refine.automatic) {
      declared_.positive(*refine.automatic, path + "/tolerance");
      if (refine.interval) fail(path + "/from", "where there is a tolerance it chooses the spans, not an interval");
    }
    refined_ = true;
  }

  void action(const Shake& shake, const std::string& path) const {
    declared_.not_negative(shake.amplitude, path + "/amplitude");
    if (shake.seed.value_or(0) < 0) fail(path + "/seed", "must not be negative");
    dofs(shake.dofs, path);
  }

  void action(const Smooth& smooth, const std::string& path) const {
    declared_.not_negative(smooth.strength, path + "/strength");
    dofs(smooth.dofs, path);
  }

  void action(const Damp& damp, const std::string& path) const {
    declared_.positive(damp.limit, path + "/limit");
    dofs(damp.dofs, path);
  }

  void action(const Adapt& adapt, const std::string& path) {
    declared_.positive(adapt.tolerance, path + "/tolerance");
    if (adapt.levels.value_or(0) < 0) fail(path + "/levels", "must not be negative");
    refined_ = true;
  }

  void action(const Lock& lock, const std::string& path) const {
    if (lock.level < 0) fail(path + "/level", "must not be negative");
  }

  void action(const SetConstant& set, const std::string& path) const {
    const auto found = declared_.constants().find(set.constant);
    if (found == declared_.constants().end()) {
      fail(path + "/constant", there_is_no("constant", set.constant, names_of(problem_.constants)));
    }
    if (const auto& frozen = problem_.constants[found->second].frozen) {
      fail(path + "/constant",
           quoted(set.constant) + " cannot be set: " +
               (frozen->line > 0 ? "line " + std::to_string(frozen->line) : std::string("the problem")) +
               " uses it where only a new problem can change it");
    }
    declared_.quantity(set.value, path + "/value");
  }

  void action(const SetWeight& set, const std::string& path) const {
    if (statement(set.name, path) == Kind::constraint) {
      if (set.weight) declared_.not_negative(*set.weight, path + "/weight");
      return;
    }
    if (!set.weight) fail(path, "only a constraint can be made hard; a term of the objective needs a weight");
    declared_.quantity(*set.weight, path + "/weight");
  }

  void action(const Enable& enable, const std::string& path) const { statement(enable.name, path); }
  void action(const Disable& disable, const std::string& path) const { statement(disable.name, path); }
  void action(const Delete& remove, const std::string& path) const { statement(remove.name, path); }

  void action(const Replace& replace, const std::string& path) {
    if (statement(replace.name, path) == Kind::term) {
      replacement(replace, problem_.objective, "term of the objective", path);
      return;
    }
    replacement(replace, problem_.constraints, "constraint", path);
    constraints_[replace.name] = static_cast<std::size_t>(replace.with);
  }

  void action(const Rescope& rescope, const std::string& path) const {
    if (statement(rescope.name, path) == Kind::term) {
      fail(path + "/name", quoted(rescope.name) + " is a term of the objective, which has no scope");
    }
    const auto& constraint = problem_.constraints[constraints_.at(rescope.name)];
    const auto own = path + "/scope";
    const auto& needs = declared_.program(constraint.program, own);
    const double instances = declared_.scope(rescope.scope, needs, own);
    if (!(instances * static_cast<double>(needs.outputs) <= limits::instances)) {
      fail(own, "the constraint would have more than " + std::to_string(limits::instances) +
                    " residuals (instances times components), the limit of one problem");
    }
    if (!(instances * static_cast<double>(needs.operations) <= limits::evaluated_operations)) {
      fail(own, "the constraint would run more than 1e11 operations in one evaluation, the limit of one problem");
    }
    if (rescope.scope.kind == Scope::Kind::once && constraint.condition) {
      check_timeless(declared_.program(constraint.condition->program, own), own + "/kind");
    }
  }

  void action(const Bound& bound, const std::string& path) const {
    declared_.dof(bound.dof, path + "/dof");
    declared_.bounds(bound.lower, bound.upper, path);
  }

  void action(const PullKeys& pull, const std::string& path) const {
    declared_.instant(pull.time, path + "/time");
    declared_.keys(pull.keys, path);
  }

  // Of what an earlier refinement may have changed only the optimizer knows the size.
  void action(const Control& control, const std::string& path) const {
    declared_.dof(control.dof, path + "/dof");
    const int size = problem_.dofs[declared_.dofs().at(control.dof)].basis.size();
    if (control.index < 0 || (!refined_ && control.index >= size)) {
      fail(path + "/index", quoted(control.dof) + " has " + std::to_string(size) +
                                " coefficients, numbered from 0; there is no " + std::to_string(control.index));
    }
    declared_.quantity(control.value, path + "/value");
  }

  void action(const Reset&, const std::string&) const {}

  enum class Kind { constraint, term };

  // What path/name names, if it is there by now.
  Kind statement(const std::string& name, const std::string& path) const {
    const auto declared_by_now = [&](int since) {
      if (static_cast<std::size_t>(since) <= now_) return;
      fail(path + "/name", quoted(name) + " takes effect only after this action");
    };
    if (const auto found = declared_.constraints().find(name); found != declared_.constraints().end()) {
      declared_by_now(problem_.constraints[found->second].since);
      return Kind::constraint;
    }
    const auto found = declared_.terms().find(name);
    if (found == declared_.terms().end()) {
      auto names = names_of(problem_.constraints);
      for (const Term& term : problem_.objective) names.push_back(term.name);
      fail(path + "/name", there_is_no("constraint or term of the objective", name, names));
    }
    declared_by_now(problem_.objective[found->second].since);
    return Kind::term;
  }

  template <class Statement>
  static void replacement(const Replace& replace, const std::vector<Statement>& list, const char* kind,
                          const std::string& path) {
    const auto with = path + "/with";
    if (replace.with < 0 || static_cast<std::size_t>(replace.with) >= list.size()) {
      fail(with, "there is no " + std::string(kind) + ' ' + std::to_string(replace.with));
    }
    const auto& by = list[static_cast<std::size_t>(replace.with)];
    if (!by.replacement || by.name != replace.name) {
      fail(with,
           std::string(kind) + ' ' + std::to_string(replace.with) + " is no replacement of " + quoted(replace.name));
    }
  }

  void interval(const std::optional<Interval>& interval, const std::string& path) const {
    if (!interval) return;
    const auto& [from, to] = *interval;
    declared_.quantity(from, path + "/from");
    declared_.quantity(to, path + "/to");
    if (reversed(from, to)) fail(path + "/to", "is before its start");
  }

  void dofs(const DofNames& names, const std::string& path) const {
    for (std::size_t i = 0; i < names.size(); ++i) declared_.dof(names[i], below(path + "/dofs", i));
  }

  const Declared& declared_;
  const Problem& problem_;
  Declared::Places constraints_;  // what stands under each name by now
  std::size_t now_ = 0;           // the action's place in the list
  bool refined_ = false;
};

}  // namespace

void check_actions(const Declared& declared) { Check(declared).all(); }

void check_action(const Declared& declared, const Action& action, const std::string& path) {
  Check(declared).one(action, path);
}

void check_edits(const Declared& declared, std::span<const Action> edits, const std::string& path) {
  Check check(declared);
  for (std::size_t i = 0; i < edits.size(); ++i) check.one(edits[i], below(path, i));
}

std::optional<Fault> validate(const Action& action, const Problem& problem) {
  try {
    check_action(Declared(problem), action, {});
  } catch (const Fault& fault) {
    return fault;
  }
  return std::nullopt;
}

}  // namespace spacetime
