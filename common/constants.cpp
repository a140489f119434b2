#include "common/constants.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "common/diagnostic.h"
#include "common/evaluate.h"

namespace spacetime {
namespace {

// A last step that differs from a whole one by less than this fraction counts as whole (language, "Scopes").
constexpr double whole_step = 1e-9;

// Instances of one statement.  Ten million four-byte indices are already 40 MB, and no band of that length is solved
// at interactive speed; a scope of more is a slip of the pen.
constexpr double max_instances = 1e7;

void require(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6).ptr};
}

}  // namespace

double evaluate(const Problem& problem, const Constants& constants, const Quantity& quantity, const std::string& what) {
  double result = quantity.number;
  if (!quantity.program.empty()) {
    const Program& program = problem.programs.at(quantity.program);
    std::vector<double> inputs;
    inputs.reserve(program.inputs.size());
    for (const Input& input : program.inputs) inputs.push_back(constants.at(input.name));
    result = evaluate_once(program, Depth::values, inputs)[quantity.output];
  }
  require(std::isfinite(result), what + " is not a finite number");
  return result;
}

Constants evaluate_constants(const Problem& problem) {
  Constants result;
  for (const Constant& constant : problem.constants) {
    result[constant.name] = evaluate(problem, result, constant.value, "constant " + constant.name);
  }
  return result;
}

std::vector<double> scope_times(const Problem& problem, const Constants& constants, const Scope& scope,
                                const std::vector<double>& breakpoints, const std::string& what) {
  const auto quantity = [&](const Quantity& q, const char* part) {
    return evaluate(problem, constants, q, what + ": " + part);
  };
  std::vector<double> times;
  double from = problem.start, to = problem.end;
  const bool interval =
      scope.kind == Scope::Kind::every || scope.kind == Scope::Kind::count || scope.kind == Scope::Kind::knots;
  if (interval) {
    from = quantity(scope.from, "start of the scope");
    to = quantity(scope.to, "end of the scope");
    require(from <= to, what + ": the scope runs backwards, from " + number(from) + " to " + number(to));
  }
  switch (scope.kind) {
    case Scope::Kind::once:
      return {std::numeric_limits<double>::quiet_NaN()};
    case Scope::Kind::times:
      for (const Quantity& time : scope.times) times.push_back(quantity(time, "time"));
      break;
    case Scope::Kind::every: {
      const double step = quantity(scope.step, "step");
      require(step > 0, what + ": the step must be positive, it is " + number(step));
      const double steps = (to - from) / step;
      require(steps < max_instances, what + ": too many instances, make the step larger");
      const auto whole = static_cast<int>(std::floor(steps + whole_step));
      for (int k = 0; k <= whole; ++k) times.push_back(from + k * step);
      if (whole > 0 && std::abs(steps - whole) <= whole_step) {
        times.back() = to;
      } else if (to > from) {
        times.push_back(to);
      }
      break;
    }
    case Scope::Kind::count:
      require(scope.count >= 1 && scope.count < max_instances, what + ": a count must be at least 1");
      for (int k = 0; k < scope.count; ++k) {
        times.push_back(k + 1 == scope.count && k > 0 ? to : from + (to - from) * k / std::max(1, scope.count - 1));
      }
      break;
    case Scope::Kind::knots:
    case Scope::Kind::whole:
      times.push_back(from);
      for (const double u : breakpoints) {
        if (u > from && u < to) times.push_back(u);
      }
      if (to > from) times.push_back(to);
      break;
  }
  for (const double t : times) {
    require(t >= problem.start && t <= problem.end, what + ": the time " + number(t) +
                                                        " lies outside the animation's, " + number(problem.start) +
                                                        " to " + number(problem.end));
  }
  return times;
}

}  // namespace spacetime
