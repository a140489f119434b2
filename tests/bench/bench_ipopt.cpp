// Our method beside Ipopt on the throws of tests/reference: the reference's four starts and thirty random sketches
// each, through the same functions and exact derivatives of the same transcription, from the same points.  Both ends
// are judged alike: hard constraints to 1e-8 in their own units, and the Lagrangian's gradient and what limits hide to
// 1e-8 of the objective's, with each solver's own multipliers.  Reading the problem and laying it out is left out of
// the times.
#include <IpIpoptApplication.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "common/diagnostic.h"
#include "optimizer/newton.h"
#include "tests/bench/ipopt_problem.h"
#include "tests/bench/throws.h"

using namespace spacetime;
using namespace spacetime::optimizer;

namespace {

constexpr double tolerance = 1e-8;
constexpr int most_iterations = 1000;

struct End {
  std::vector<double> x, multipliers;
  int iterations = 0;
  double seconds = 0, evaluating = 0;
};

struct Judged {
  double objective = 0, violation = 0, stationarity = 0, gap = 0;
  bool converged() const { return violation <= tolerance && stationarity <= tolerance && gap <= tolerance; }
};

Judged judge(const Transcription& t, const Layout& layout, const End& end) {
  Workspace workspace;
  Linearisation linear = start_linearisation(layout);
  const Values values = evaluate(t, end.x, workspace);
  linearise(t, layout, end.x, workspace, linear);
  Judged judged{values.objective};
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const double c = values.residual[r];
    const double multiplier = t.rows[r].at_most ? std::max(0.0, end.multipliers[r]) : end.multipliers[r];
    judged.violation = std::max(judged.violation, std::abs(excess(t.rows[r], c)));
    if (t.rows[r].at_most) judged.gap += std::abs(c * multiplier);
    lambda[layout.of_row[r]] = multiplier;
  }
  judged.gap /= std::max(1.0, std::abs(values.objective));
  const Eigen::VectorXd pulled = linear.gradient + multiply(linear.jacobian, lambda);
  double size = 1;
  for (const int position : layout.of_unknown) {
    judged.stationarity = std::max(judged.stationarity, std::abs(pulled[position]));
    size = std::max(size, std::abs(linear.gradient[position]));
  }
  judged.stationarity /= size;
  return judged;
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

End ours(const Transcription& t, const Layout& layout, const std::vector<double>& x) {
  const double begun = now();
  Newton newton(t, layout);
  NewtonState state = newton.start(x);
  while (state.iterations < most_iterations && newton.step(state, tolerance) == StepResult::stepped) {
  }
  return {state.x, state.multipliers, state.iterations, now() - begun, state.seconds.evaluate};
}

End ipopts(const Transcription& t, const Layout& layout, const std::vector<double>& x) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
  const auto options = application->Options();
  options->SetIntegerValue("print_level", 0);
  options->SetStringValue("sb", "yes");
  options->SetIntegerValue("max_iter", most_iterations);
  // Its own measures are of the scaled problem; these make it go on to where the judge below is content.
  options->SetNumericValue("tol", tolerance / 10);
  options->SetNumericValue("constr_viol_tol", tolerance);
  options->SetNumericValue("compl_inf_tol", tolerance / 1000);  // of each limit; the judge sums them
  options->SetIntegerValue("acceptable_iter", 0);               // no second-best end
  options->SetNumericValue("bound_relax_factor", 0);            // the limits as they are
  if (application->Initialize() != Ipopt::Solve_Succeeded) throw InputError("Ipopt does not start");
  IpoptProblem* problem = new IpoptProblem(t, layout, x);
  const Ipopt::SmartPtr<Ipopt::TNLP> held = problem;
  const double begun = now();
  application->OptimizeTNLP(held);
  return {problem->x, problem->multipliers, problem->iterations, now() - begun, problem->seconds_evaluating};
}

double median(std::vector<double> numbers) {
  if (numbers.empty()) return NAN;
  std::ranges::sort(numbers);
  return numbers[numbers.size() / 2];
}

void compare(const std::string& name, bool every) {
  const Throw problem = throw_named(name);
  const Transcription t = transcribe(problem.problem);
  const Layout layout = arrange(t);
  using Solver = std::function<End(const Transcription&, const Layout&, const std::vector<double>&)>;
  for (const auto& [solver, solve] : {std::pair<const char*, Solver>{"ours", ours}, {"Ipopt", ipopts}}) {
    std::vector<double> iterations, milliseconds;
    double best = INFINITY, total = 0, sum = 0, evaluating = 0;
    for (const Start& start : problem.starts) {
      Workspace workspace;
      std::vector<double> x = start.coefficients;
      x.resize(t.unknowns(), 0.0);
      settle_functionals(t, x, workspace);
      const End end = solve(t, layout, x);
      total += end.seconds;
      sum += end.iterations;
      evaluating += end.evaluating;
      const bool ended = !end.multipliers.empty();
      const Judged judged = ended ? judge(t, layout, end) : Judged{NAN, NAN, NAN, NAN};
      if (every) {
        std::printf("  %-6s %-10s %5d %14.8f  violation %.1e  gradient %.1e  gap %.1e\n", solver, start.name.c_str(),
                    end.iterations, judged.objective, judged.violation, judged.stationarity, judged.gap);
      }
      if (!judged.converged()) continue;
      iterations.push_back(end.iterations);
      milliseconds.push_back(1e3 * end.seconds);
      best = std::min(best, judged.objective);
    }
    double mean = 0;
    for (const double n : iterations) mean += n / static_cast<double>(iterations.size());
    std::printf("%-6s %-6s %4zu of %zu %8.0f %8.1f %10.2f %9.3f %9.3f %9.3f %14.8f\n", name.c_str(), solver,
                iterations.size(), problem.starts.size(), median(iterations), mean, median(milliseconds), total,
                1e3 * total / sum, 1e3 * evaluating / sum, best);
  }
}

}  // namespace

// With any argument, every single end is told as well.
int main(int argc, char**) {
  std::printf("%-6s %-6s %10s %8s %8s %10s %9s %9s %9s %14s\n", "", "", "converged", "median", "mean", "ms, median",
              "s, total", "ms/iter.", "evaluate", "best");
  for (const std::string name : {"P94R", "P94J", "P92"}) compare(name, argc > 1);
}
