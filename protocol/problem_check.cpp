#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "protocol/check.h"
#include "protocol/limits.h"
#include "protocol/path.h"

namespace spacetime {
namespace {

using Names = std::unordered_set<std::string_view>;

std::string quoted(std::string_view name) { return std::string("\"").append(name).append("\""); }

// What a program needs to be given.
struct Needs {
  bool trajectory = false;  // a degree of freedom or a signal
  bool time = false;
  bool parameter = false;
  bool multiplier = false;
  std::ptrdiff_t constant = -1;    // the last one, by its place in Problem::constants; -1: none
  std::ptrdiff_t functional = -1;  // the same, in Problem::functionals
  std::size_t outputs = 0;
  std::size_t operations = 0;
};

// ProgramFault's paths name fields of Program; in documents entries are lists and the prefixes' lengths an object.
std::string document_path(std::string path) {
  if (path == "value_operations") return "operations/values";
  if (path == "jacobian_operations") return "operations/jacobian";
  const std::pair<std::string_view, std::string_view> fields[] = {
      {"/row", "/0"}, {"/input", "/1"}, {"/column", "/1"}, {"/value", "/2"}};
  if (!path.starts_with("jacobian/") && !path.starts_with("hessian/")) return path;
  for (const auto& [field, index] : fields) {
    if (path.ends_with(field)) return path.replace(path.size() - field.size(), field.size(), index);
  }
  return path;
}

// Walks a problem in an order in which everything is known before it is referred to; throws the first fault.
class Check {
 public:
  explicit Check(const Problem& problem) : problem_(problem) {}

  void all() {
    if (!std::isfinite(problem_.start)) fail("/time/0", "must be finite");
    if (!std::isfinite(problem_.end)) fail("/time/1", "must be finite");
    if (!(problem_.start < problem_.end)) fail("/time", "the time must rise");
    declarations();
    programs();
    values();
    functionals();
    constraints();
    objective();
    keyframes();
    plots();
    bodies();
    actions();
  }

 private:
  [[noreturn]] static void fail(std::string path, std::string message) {
    throw Fault{std::move(path), std::move(message)};
  }

  static void name(Names& names, std::string_view name, const std::string& path) {
    if (auto fault = validate_name(name, path)) throw std::move(*fault);
    if (!names.insert(name).second) fail(path, quoted(name) + " is the name of an earlier one already");
  }

  static void place(const Place& place, const std::string& path) {
    if (place.line < 0) fail(path + "/line", "must not be negative");
    if (place.column < 0) fail(path + "/column", "must not be negative");
  }

  void declarations() {
    Names names;
    for (std::size_t i = 0; i < problem_.constants.size(); ++i) {
      const auto path = below("/constants", i);
      name(names, problem_.constants[i].name, path + "/name");
      place(problem_.constants[i].place, path);
      constants_.emplace(problem_.constants[i].name, i);
    }
    for (std::size_t i = 0; i < problem_.dofs.size(); ++i) {
      const auto& dof = problem_.dofs[i];
      const auto path = below("/dofs", i);
      name(names, dof.name, path + "/name");
      place(dof.place, path);
      if (auto fault = validate(dof.basis, problem_.start, problem_.end, path + "/basis")) throw std::move(*fault);
      dofs_.insert(dof.name);
      most_knots_ = std::max(most_knots_, dof.basis.knots.size() - 6);
    }
  }

  void programs() {
    std::size_t operations = 0;
    for (const auto& [key, program] : problem_.programs) {
      const auto path = below("/programs", key);
      operations += program.op.size();
      if (operations > limits::operations) {
        fail("/programs", "more than " + std::to_string(limits::operations) + " operations, the limit of one problem");
      }
      if (auto fault = validate(program)) fail(path + '/' + document_path(fault->path), fault->message);
      needs_.emplace(key, needs_of(program, path));
      if (const auto own = hash(program); own != key) fail(path, "is not the program's hash, which is " + own);
    }
  }

  Needs needs_of(const Program& program, const std::string& path) const {
    Needs needs{.outputs = program.values.size(), .operations = program.op.size()};
    for (std::size_t i = 0; i < program.inputs.size(); ++i) {
      const auto& input = program.inputs[i];
      const auto unknown = [&](const char* kind) {
        fail(below(path + "/inputs", i) + "/name", "there is no " + std::string(kind) + ' ' + quoted(input.name));
      };
      switch (input.kind) {
        case InputKind::dof:
          if (!dofs_.contains(input.name)) unknown("degree of freedom");
          needs.trajectory = true;
          break;
        case InputKind::signal:
          unknown("signal");
          break;
        case InputKind::constant: {
          const auto found = constants_.find(input.name);
          if (found == constants_.end()) unknown("constant");
          needs.constant = std::max(needs.constant, static_cast<std::ptrdiff_t>(found->second));
          break;
        }
        case InputKind::parameter:
          unknown("parameter");
          break;
        case InputKind::functional:
          if (static_cast<std::size_t>(input.index) >= problem_.functionals.size()) {
            fail(below(path + "/inputs", i) + "/index", "there is no functional " + std::to_string(input.index));
          }
          needs.functional = std::max(needs.functional, static_cast<std::ptrdiff_t>(input.index));
          break;
        case InputKind::time:
          needs.time = true;
          break;
        case InputKind::multiplier:
          needs.multiplier = true;
          break;
      }
    }
    return needs;
  }

  const Needs& program(const std::string& key, const std::string& path) const {
    const auto found = needs_.find(key);
    if (found == needs_.end()) fail(path + "/program", "there is no program " + quoted(key));
    return found->second;
  }

  static void output(const Needs& needs, int output, const std::string& path) {
    if (output < 0 || static_cast<std::size_t>(output) >= needs.outputs) {
      fail(path, "the program has " + std::to_string(needs.outputs) + " values, numbered from 0; there is no " +
                     std::to_string(output));
    }
  }

  static void timeless(const Needs& needs, const std::string& path) {
    if (needs.trajectory || needs.time) {
      fail(path + "/program", "what is evaluated once cannot depend on time or on a trajectory");
    }
  }

  static void no_multiplier(const Needs& needs, const std::string& path) {
    if (needs.multiplier) fail(path + "/program", "takes a multiplier, and there is none here");
  }

  // `known`: how many of the constants it may use.
  void quantity(const Quantity& quantity, const std::string& path, std::size_t known) const {
    if (quantity.program.empty()) {
      if (!std::isfinite(quantity.number)) fail(path, "must be finite");
      return;
    }
    const auto& needs = program(quantity.program, path);
    output(needs, quantity.output, path + "/output");
    if (needs.trajectory || needs.time || needs.parameter || needs.multiplier || needs.functional >= 0) {
      fail(path + "/program", "a quantity may depend on constants alone");
    }
    if (needs.constant >= static_cast<std::ptrdiff_t>(known)) {
      fail(path + "/program",
           "uses constant " + quoted(problem_.constants[needs.constant].name) + ", which is not declared before");
    }
  }
  void quantity(const Quantity& value, const std::string& path) const {
    quantity(value, path, problem_.constants.size());
  }
  void quantities(const std::vector<Quantity>& list, const std::string& path) const {
    for (std::size_t i = 0; i < list.size(); ++i) quantity(list[i], below(path, i));
  }

  void values() const {
    for (std::size_t i = 0; i < problem_.constants.size(); ++i) {
      quantity(problem_.constants[i].value, below("/constants", i) + "/value", i);
    }
    for (std::size_t i = 0; i < problem_.dofs.size(); ++i) {
      quantity(problem_.dofs[i].start, below("/dofs", i) + "/start");
    }
  }

  // A functional or a piece of the objective.
  template <class Summed>
  const Needs& summed(const Summed& summed, const std::string& path) {
    const auto& needs = program(summed.program, path);
    output(needs, summed.output, path + "/output");
    constexpr double points = 4;  // of Gauss-Legendre quadrature in a knot span
    const bool integral = summed.kind == Summed::Kind::integral;
    evaluated(integral ? points * static_cast<double>(most_knots_) : 1, needs, path);
    if (integral) {
      if (summed.from) quantity(*summed.from, path + "/from");
      if (summed.to) quantity(*summed.to, path + "/to");
    } else if (summed.kind == Summed::Kind::at) {
      if (!summed.from) fail(path, "the time is missing");
      quantity(*summed.from, path + "/time");
      if (summed.to) fail(path, "a value at one time has no end");
    } else {
      if (summed.from || summed.to) fail(path, "what is evaluated once has no time");
      timeless(needs, path);
    }
    return needs;
  }

  void functionals() {
    for (std::size_t i = 0; i < problem_.functionals.size(); ++i) {
      const auto path = below("/functionals", i);
      const auto& needs = summed(problem_.functionals[i], path);
      if (needs.functional >= static_cast<std::ptrdiff_t>(i)) {
        fail(path + "/program", "uses functional " + std::to_string(needs.functional) + ", which is not before it");
      }
    }
  }

  // Counts what a statement costs to evaluate at so many times.
  void evaluated(double times, const Needs& needs, const std::string& path) {
    evaluated_ += times * static_cast<double>(needs.operations);
    if (evaluated_ <= limits::evaluated_operations) return;
    fail(path, "the statements up to here run more than 1e11 operations in one evaluation, the limit of one problem");
  }

  // How many instances it has, as far as its numbers alone tell.
  double scope(const Scope& scope, const Needs& needs, const std::string& constraint) const {
    const auto path = constraint + "/scope";
    const auto ends = [&] {
      quantity(scope.from, path + "/from");
      quantity(scope.to, path + "/to");
      if (scope.from.program.empty() && scope.to.program.empty() && scope.from.number > scope.to.number) {
        fail(path + "/to", "is before its start");
      }
    };
    switch (scope.kind) {
      case Scope::Kind::once:
        timeless(needs, constraint);
        return 1;
      case Scope::Kind::times:
        if (scope.times.empty()) fail(path + "/times", "names no time");
        quantities(scope.times, path + "/times");
        return static_cast<double>(scope.times.size());
      case Scope::Kind::every:
        ends();
        quantity(scope.step, path + "/step");
        if (!scope.step.program.empty()) return 1;
        if (!(scope.step.number > 0)) fail(path + "/step", "must be positive");
        if (!scope.from.program.empty() || !scope.to.program.empty()) return 1;
        return std::floor((scope.to.number - scope.from.number) / scope.step.number) + 2;
      case Scope::Kind::count:
        ends();
        if (scope.count < 2) fail(path + "/count", "must be at least 2: both ends are among them");
        return scope.count;
      case Scope::Kind::knots:
        ends();
        return static_cast<double>(most_knots_);
      case Scope::Kind::whole:
        return static_cast<double>(most_knots_);
    }
    fail(path + "/kind", "is no kind of scope");
  }

  void constraints() {
    double residuals = 0;
    for (std::size_t i = 0; i < problem_.constraints.size(); ++i) {
      const auto& constraint = problem_.constraints[i];
      const auto path = below("/constraints", i);
      name(statements_, constraint.name, path + "/name");
      place(constraint.place, path);
      const auto& needs = program(constraint.program, path);
      if (needs.outputs == 0) fail(path + "/program", "has no values, so that nothing is constrained");
      const double instances = scope(constraint.scope, needs, path);
      residuals += instances * static_cast<double>(needs.outputs);
      if (!(residuals <= limits::instances)) {
        fail(path + "/scope", "the constraints up to here have more than " + std::to_string(limits::instances) +
                                  " residuals (instances times components), the limit of one problem");
      }
      evaluated(instances, needs, path + "/scope");
      if (!constraint.weight) continue;
      quantity(*constraint.weight, path + "/weight");
      if (constraint.weight->program.empty() && constraint.weight->number < 0) {
        fail(path + "/weight", "must not be negative");
      }
    }
  }

  void objective() {
    for (std::size_t i = 0; i < problem_.objective.size(); ++i) {
      const auto& term = problem_.objective[i];
      const auto path = below("/objective", i);
      name(statements_, term.name, path + "/name");
      place(term.place, path);
      quantity(term.weight, path + "/weight");
      for (std::size_t k = 0; k < term.pieces.size(); ++k) summed(term.pieces[k], below(path + "/pieces", k));
    }
  }

  void keyframes() const {
    for (std::size_t i = 0; i < problem_.keyframes.size(); ++i) {
      const auto& keyframe = problem_.keyframes[i];
      const auto path = below("/keyframes", i);
      place(keyframe.place, path);
      quantity(keyframe.time, path + "/time");
      Names keyed;
      for (std::size_t k = 0; k < keyframe.keys.size(); ++k) {
        const auto& key = keyframe.keys[k];
        const auto own = below(path + "/keys", k);
        if (!dofs_.contains(key.dof)) fail(own + "/dof", "there is no degree of freedom " + quoted(key.dof));
        if (!keyed.insert(key.dof).second) fail(own + "/dof", quoted(key.dof) + " has a key at this time already");
        quantity(key.value, own + "/value");
      }
    }
  }

  void sampled(const std::string& key, const std::vector<int>& outputs, const std::string& path) const {
    const auto& needs = program(key, path);
    no_multiplier(needs, path);
    for (std::size_t k = 0; k < outputs.size(); ++k) output(needs, outputs[k], below(path + "/outputs", k));
  }

  void plots() const {
    Names names;
    for (std::size_t i = 0; i < problem_.plots.size(); ++i) {
      const auto& plot = problem_.plots[i];
      const auto path = below("/plots", i);
      name(names, plot.name, path + "/name");
      if (plot.outputs.empty()) fail(path + "/outputs", "a plot shows at least one value");
      sampled(plot.program, plot.outputs, path);
    }
  }

  void bodies() const {
    constexpr std::size_t sizes[] = {4, 1, 3, 0};  // in the order of Body::Shape
    constexpr std::size_t pose = 12;
    Names names;
    for (std::size_t i = 0; i < problem_.bodies.size(); ++i) {
      const auto& body = problem_.bodies[i];
      const auto path = below("/bodies", i);
      name(names, body.name, path + "/name");
      const auto expected = sizes[static_cast<std::size_t>(body.shape)];
      if (body.size.size() != expected) {
        fail(path + "/size",
             "this shape has " + std::to_string(expected) + " numbers, not " + std::to_string(body.size.size()));
      }
      quantities(body.size, path + "/size");
      if (body.outputs.size() != pose) {
        fail(path + "/outputs", "a pose has 12 numbers, not " + std::to_string(body.outputs.size()));
      }
      sampled(body.program, body.outputs, path);
    }
  }

  void actions() const {
    for (std::size_t i = 0; i < problem_.actions.size(); ++i) {
      const auto path = below("/actions", i);
      place(problem_.actions[i].place, path);
      std::visit([&](const auto& which) { action(which, path); }, problem_.actions[i].action);
    }
  }

  static void action(const Solve& solve, const std::string& path) {
    if (!(solve.tolerance > 0) || !std::isfinite(solve.tolerance)) fail(path + "/tolerance", "must be positive");
    if (solve.iterations.value_or(0) < 0) fail(path + "/iterations", "must not be negative");
  }
  static void action(const Iterate& iterate, const std::string& path) {
    if (iterate.iterations < 0) fail(path + "/iterations", "must not be negative");
  }

  template <class Other>
  static void action(const Other&, const std::string&) {}

  const Problem& problem_;
  std::unordered_map<std::string_view, std::size_t> constants_;  // by name: their place in the list
  Names dofs_;
  Names statements_;  // constraints and objective terms share one set: actions name either
  std::unordered_map<std::string_view, Needs> needs_;
  double evaluated_ = 0;        // operations
  std::size_t most_knots_ = 2;  // distinct knots of the finest basis
};

}  // namespace

std::optional<Fault> validate(const Problem& problem) {
  try {
    Check(problem).all();
    return std::nullopt;
  } catch (Fault& fault) {
    return std::move(fault);
  }
}

}  // namespace spacetime
