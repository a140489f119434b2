// Our method beside the papers' own on the throws of tests/reference, from the reference's four starts.  All are
// measured by one yardstick, the penalty function F = f + 1e3 * sum of squared violations: iterations and time until F
// has fallen to within 1 % of its fall to where the run ends, and until the method itself is content to 1e-8 (for bfgs
// that is F's minimum; what it leaves of the violation is told).  A run that is not content ends at the limit.
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "optimizer/bfgs.h"
#include "optimizer/sqp92.h"
#include "tests/bench/throws.h"

using namespace spacetime;
using namespace spacetime::optimizer;

namespace {

constexpr double tolerance = 1e-8;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Method>
void run(const char* name, Method method, Penalty& yardstick, const std::vector<double>& x, int most_iterations) {
  struct Moment {
    double seconds, value;
  };
  std::vector<Moment> course;
  const auto note = [&](double seconds, const std::vector<double>& at) {
    course.push_back({seconds, yardstick.at(at).value});
  };
  double seconds = -now();
  auto state = method.start(x);
  seconds += now();
  note(seconds, state.x);
  StepResult result = StepResult::stepped;
  for (int k = 0; k < most_iterations && result == StepResult::stepped; ++k) {
    seconds -= now();
    result = method.step(state, tolerance);
    seconds += now();
    if (result == StepResult::stepped) note(seconds, state.x);
  }
  const double end = course.back().value, near = end + 0.01 * (course.front().value - end);
  std::size_t k = 0;
  while (course[k].value > near) ++k;
  const bool content = state.measures.stationarity <= tolerance;
  std::printf("  %-16s %6zu %9.1f   %6zu%c %9.1f   %12.6f %9.1e %9.1e\n", name, k, 1e3 * course[k].seconds,
              course.size() - 1, content ? ' ' : '*', 1e3 * seconds, state.values.objective, state.measures.violation,
              state.measures.stationarity);
}

void compare(const Throw& problem, const Start& start) {
  const Transcription t = transcribe(problem.problem);
  const Layout layout = arrange(t);
  Penalty yardstick(t, layout, 1e3);
  std::vector<double> x = start.coefficients;
  x.resize(t.unknowns(), 0.0);
  std::printf("%s from %s\n", problem.name.c_str(), start.name.c_str());
  run("newton", Newton(t, layout), yardstick, x, 1000);
  const bool limits = Limits(t, layout).count() > 0;
  if (!limits) {
    run("sqp92", Sqp92(t, layout, false), yardstick, x, 1000);
    run("sqp92 linear cg", Sqp92(t, layout, true), yardstick, x, 10);
  }
  run("bfgs", Bfgs(t, layout), yardstick, x, 3000);
  run("bfgs, diagonal", Bfgs(t, layout, {.diagonal_start = true}), yardstick, x, 3000);
}

}  // namespace

int main() {
  std::printf("  %-16s %6s %9s   %7s %9s   %12s %9s %9s\n", "", "to 1 %", "ms", "to 1e-8", "ms", "objective",
              "violation", "gradient");
  Throw soft = throw_named("P94R");
  for (Constraint& constraint : soft.problem.constraints) {
    if (constraint.name == "still") constraint.weight = Quantity{20, "", 0};
  }
  soft.name = "P94R with 10 for the rates' squares";
  for (const Throw& problem : {soft, throw_named("P94R"), throw_named("P94J"), throw_named("P92")}) {
    for (int k = 0; k < 4; ++k) compare(problem, problem.starts[k]);
  }
}
