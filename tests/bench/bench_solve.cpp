// Whole solves: compiling the throw's scene, iterations of the regularised throw from the reference's starts, and how
// an iteration grows with the number of spans.  Goals: 20 ms to compile, 0.5 ms an iteration at 64 spans.  Medians and
// the fastest of several runs; where the time goes is that of the fastest.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "optimizer/run.h"
#include "symbolic/compile.h"
#include "tests/bench/throws.h"

using namespace spacetime;

namespace {

std::string with_spans(std::string text, int spans) {
  const std::string before = "bspline spans ";
  const auto from = text.find(before) + before.size(), to = text.find_first_not_of("0123456789", from);
  return text.replace(from, to - from, std::to_string(spans));
}

// Sorts the times.
double median(std::vector<double>& times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void compiling(const std::string& name, const std::string& text) {
  constexpr int repetitions = 41;
  std::vector<double> times;
  symbolic::Statistics statistics;
  for (int k = 0; k < repetitions; ++k) {
    const auto start = std::chrono::steady_clock::now();
    statistics = symbolic::compile(text).statistics;
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  const double middle = median(times);
  const auto& phases = statistics.milliseconds;
  std::printf("%-22s %8.2f %8.2f %8.2f %8.2f %8.2f %8.2f %10zu\n", name.c_str(), middle, times.front(), phases.parse,
              phases.build, phases.differentiate, phases.emit, statistics.operations);
}

void solving(const std::string& name, const Problem& problem, const optimizer::RunOptions& options, int repetitions) {
  std::vector<double> times;
  Motion fastest;
  for (int k = 0; k < repetitions; ++k) {
    Motion motion = optimizer::run(problem, options);
    times.push_back(1e3 * motion.seconds.total / std::max(1, motion.iterations));
    if (k == 0 || motion.seconds.total < fastest.seconds.total) fastest = std::move(motion);
  }
  const double middle = median(times), each = 1e3 / std::max(1, fastest.iterations);
  std::printf("%-22s %6d %12.8g %10s %9.3f %9.3f %9.3f %9.3f\n", name.c_str(), fastest.iterations, fastest.objective,
              std::string(name_of(fastest.status)).c_str(), middle, times.front(), each * fastest.seconds.evaluate,
              each * fastest.seconds.factor);
}

// A motion with the given coefficients, one degree of freedom after another.
Motion motion_of(const Problem& problem, const std::vector<double>& coefficients) {
  Motion motion;
  motion.start = problem.start;
  motion.end = problem.end;
  auto from = coefficients.begin();
  for (const Dof& dof : problem.dofs) {
    motion.dofs.push_back({dof.name, dof.basis, {from, from + dof.basis.size()}});
    from += dof.basis.size();
  }
  return motion;
}

}  // namespace

int main() {
  const std::string regularised = file_text("examples/throw_regularised.scene");

  std::printf("%-22s %8s %8s %8s %8s %8s %8s %10s\n", "compiling, ms", "median", "fastest", "parse", "build", "derive",
              "emit", "operations");
  compiling("throw", file_text("examples/throw.scene"));
  compiling("throw_eliminated", file_text("examples/throw_eliminated.scene"));
  compiling("throw_regularised", regularised);

  std::printf("\n%-22s %6s %12s %10s %9s %9s %9s %9s\n", "solving, ms/iteration", "iter.", "objective", "status",
              "median", "fastest", "evaluate", "factor");
  const Throw throws = throw_named("P94R");
  for (int k = 0; k < 4; ++k) {
    optimizer::RunOptions options;
    options.start = motion_of(throws.problem, throws.starts[k].coefficients);
    solving("P94R from " + throws.starts[k].name, throws.problem, options, 51);
  }
  solving("throw", symbolic::compile(file_text("examples/throw.scene")).problem.value(), {}, 51);

  // With a limit: here only the cost of an iteration is asked.
  for (int spans = 16; spans <= 1024; spans *= 4) {
    optimizer::RunOptions options;
    options.iterations = 50;
    solving("P94R, " + std::to_string(spans) + " spans",
            symbolic::compile(with_spans(regularised, spans)).problem.value(), options, 15);
  }
}
