#include <cmath>
#include <string>
#include <utility>

#include "protocol/declared.h"
#include "protocol/limits.h"
#include "protocol/path.h"

namespace spacetime {
namespace {

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

// Before anything refers to a program.  Whoever holds a problem has asked once: actions on it need no more than what
// its programs need.
void check_programs(const Problem& problem) {
  std::size_t operations = 0;
  for (const auto& [key, program] : problem.programs) {
    const auto path = below("/programs", key);
    operations += program.op.size();
    if (operations > limits::operations) {
      fail("/programs", "more than " + std::to_string(limits::operations) + " operations, the limit of one problem");
    }
    if (auto fault = validate(program)) fail(path + '/' + document_path(fault->path), fault->message);
  }
}

void check_hashes(const Problem& problem) {
  for (const auto& [key, program] : problem.programs) {
    if (const auto own = hash(program); own != key) {
      fail(below("/programs", key),
           "is not the program's hash, which is " + own + ": " + std::string(probably_rounded));
    }
  }
}

// Walks the statements in an order in which everything is known before it is referred to.
class Check {
 public:
  explicit Check(const Declared& declared) : declared_(declared), problem_(declared.problem()) {}

  void all() {
    values();
    functionals();
    constraints();
    objective();
    keyframes();
    plots();
    bodies();
  }

 private:
  void values() const {
    for (std::size_t i = 0; i < problem_.constants.size(); ++i) {
      declared_.quantity(problem_.constants[i].value, below("/constants", i) + "/value", i);
    }
    const auto unknowns = [&](const auto& list, std::string_view list_path) {
      for (std::size_t i = 0; i < list.size(); ++i) {
        const auto path = below(list_path, i);
        declared_.quantity(list[i].start, path + "/start");
        declared_.bounds(list[i].lower, list[i].upper, path);
      }
    };
    unknowns(problem_.parameters, "/parameters");
    unknowns(problem_.dofs, "/dofs");
  }

  // A functional or a piece of the objective.
  template <class Summed>
  const Needs& summed(const Summed& summed, const std::string& path) {
    const auto& needs = declared_.program(summed.program, path);
    check_output(needs, summed.output, path + "/output");
    constexpr double points = 4;  // of Gauss-Legendre quadrature in a knot span
    const bool integral = summed.kind == Summed::Kind::integral;
    evaluated(integral ? points * static_cast<double>(declared_.most_knots()) : 1, needs, path);
    if (integral) {
      if (summed.from) declared_.instant(*summed.from, path + "/from");
      if (summed.to) declared_.instant(*summed.to, path + "/to");
    } else if (summed.kind == Summed::Kind::at) {
      if (!summed.from) fail(path, "the time is missing");
      declared_.instant(*summed.from, path + "/time");
      if (summed.to) fail(path, "a value at one time has no end");
    } else {
      if (summed.from || summed.to) fail(path, "what is evaluated once has no time");
      check_timeless(needs, path + "/program");
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

  void constraints() {
    double residuals = 0;
    for (std::size_t i = 0; i < problem_.constraints.size(); ++i) {
      const auto& constraint = problem_.constraints[i];
      const auto path = below("/constraints", i);
      const auto& needs = declared_.program(constraint.program, path);
      if (needs.outputs == 0) fail(path + "/program", "has no values, so that nothing is constrained");
      const double instances = declared_.scope(constraint.scope, needs, path + "/scope");
      residuals += instances * static_cast<double>(needs.outputs);
      if (!(residuals <= limits::instances)) {
        fail(path + "/scope", "the constraints up to here have more than " + std::to_string(limits::instances) +
                                  " residuals (instances times components), the limit of one problem");
      }
      evaluated(instances, needs, path + "/scope");
      if (constraint.condition) condition(*constraint.condition, constraint.scope, instances, path + "/condition");
      if (constraint.weight) declared_.not_negative(*constraint.weight, path + "/weight");
    }
  }

  // Conditions are settled before anything is evaluated, functionals among it.
  void condition(const Condition& condition, const Scope& scope, double instances, const std::string& path) {
    const auto& needs = declared_.program(condition.program, path);
    check_output(needs, condition.output, path + "/output");
    if (needs.functional >= 0 || needs.multiplier) {
      fail(path + "/program",
           "a condition may depend on degrees of freedom, the time, constants and parameters, and on nothing else");
    }
    if (scope.kind == Scope::Kind::once) check_timeless(needs, path + "/program");
    evaluated(instances, needs, path);
  }

  void objective() {
    for (std::size_t i = 0; i < problem_.objective.size(); ++i) {
      const auto& term = problem_.objective[i];
      const auto path = below("/objective", i);
      declared_.quantity(term.weight, path + "/weight");
      for (std::size_t k = 0; k < term.pieces.size(); ++k) summed(term.pieces[k], below(path + "/pieces", k));
    }
  }

  void keyframes() const {
    for (std::size_t i = 0; i < problem_.keyframes.size(); ++i) {
      const auto& keyframe = problem_.keyframes[i];
      const auto path = below("/keyframes", i);
      check_place(keyframe.place, path);
      declared_.instant(keyframe.time, path + "/time");
      declared_.keys(keyframe.keys, path);
      declared_.beginning(keyframe.since, path);
    }
  }

  void sampled(const std::string& key, const std::vector<int>& outputs, const std::string& path) const {
    const auto& needs = declared_.program(key, path);
    if (needs.multiplier) fail(path + "/program", "takes a multiplier, and there is none here");
    for (std::size_t k = 0; k < outputs.size(); ++k) check_output(needs, outputs[k], below(path + "/outputs", k));
  }

  void plots() const {
    Names names;
    for (std::size_t i = 0; i < problem_.plots.size(); ++i) {
      const auto& plot = problem_.plots[i];
      const auto path = below("/plots", i);
      check_name(plot.name, path + "/name", names);
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
      check_name(body.name, path + "/name", names);
      const auto expected = sizes[static_cast<std::size_t>(body.shape)];
      if (body.size.size() != expected) {
        fail(path + "/size",
             "this shape has " + std::to_string(expected) + " numbers, not " + std::to_string(body.size.size()));
      }
      declared_.quantities(body.size, path + "/size");
      if (body.outputs.size() != pose) {
        fail(path + "/outputs", "a pose has 12 numbers, not " + std::to_string(body.outputs.size()));
      }
      sampled(body.program, body.outputs, path);
    }
  }

  const Declared& declared_;
  const Problem& problem_;
  double evaluated_ = 0;  // operations
};

}  // namespace

void check_statements(const Declared& declared) { Check(declared).all(); }

std::optional<Fault> validate(const Problem& problem) {
  try {
    if (!std::isfinite(problem.start)) fail("/time/0", "must be finite");
    if (!std::isfinite(problem.end)) fail("/time/1", "must be finite");
    if (!(problem.start < problem.end)) fail("/time", "the time must rise");
    check_programs(problem);
    const Declared declared(problem);
    check_hashes(problem);
    check_statements(declared);
    check_actions(declared);
    return std::nullopt;
  } catch (Fault& fault) {
    return std::move(fault);
  }
}

}  // namespace spacetime
