#include "common/sample.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/bspline.h"
#include "common/evaluate.h"

namespace spacetime {
namespace {

double named(const std::vector<std::pair<std::string, double>>& list, const std::string& name) {
  const auto found = std::ranges::find_if(list, [&](const auto& entry) { return entry.first == name; });
  return found == list.end() ? 0 : found->second;
}

std::vector<std::vector<double>> table(const Rows& rows, std::span<const int> outputs) {
  std::vector<std::vector<double>> result(rows.samples);
  for (std::size_t s = 0; s < rows.samples; ++s) {
    for (const int output : outputs) result[s].push_back(rows(output, s));
  }
  return result;
}

}  // namespace

Rows along(const Program& program, const Evaluator& evaluator, const Motion& motion,
           std::span<const double> functionals, std::span<const double> times) {
  std::vector<std::vector<double>> inputs;
  std::vector<const double*> pointers;
  std::vector<std::uint8_t> uniform;
  for (const Input& input : program.inputs) {
    std::vector<double> values{0.0};
    switch (input.kind) {
      case InputKind::dof: {
        const auto& dof = *std::ranges::find(motion.dofs, input.name, &Trajectory::name);
        values.clear();
        for (const double t : times) values.push_back(value(dof.basis, dof.coefficients, t, input.derivative));
        break;
      }
      case InputKind::time:
        values.assign(times.begin(), times.end());
        break;
      case InputKind::constant:
        values[0] = named(motion.constants, input.name);
        break;
      case InputKind::parameter:
        values[0] = named(motion.parameters, input.name);
        break;
      case InputKind::functional:
        values[0] = functionals[input.index];
        break;
      case InputKind::signal:
      case InputKind::multiplier:
        break;
    }
    uniform.push_back(input.kind != InputKind::dof && input.kind != InputKind::time);
    inputs.push_back(std::move(values));
  }
  for (const auto& values : inputs) pointers.push_back(values.data());
  Rows rows{std::vector<double>(evaluator.outputs(Depth::values) * times.size()), times.size()};
  evaluator.run(Depth::values, times.size(), pointers, uniform, rows.data.data(), times.size());
  return rows;
}

Samples sample(const Problem& problem, const Motion& motion, std::span<const double> functionals,
               std::span<const double> times, const std::set<std::string>* wanted) {
  Samples samples;
  samples.times.assign(times.begin(), times.end());
  std::map<std::string, Rows> rows;
  const auto rows_of = [&](const std::string& hash) -> const Rows& {
    const auto found = rows.find(hash);
    if (found != rows.end()) return found->second;
    const Program& program = problem.programs.at(hash);
    return rows.emplace(hash, along(program, Evaluator(program), motion, functionals, times)).first->second;
  };
  const auto fill = [&](const auto& things, auto& tables) {
    for (const auto& thing : things) {
      if (wanted && !wanted->contains(thing.name)) continue;
      tables[thing.name] = table(rows_of(thing.program), thing.outputs);
    }
  };
  fill(problem.plots, samples.values);
  fill(problem.bodies, samples.poses);
  return samples;
}

std::vector<double> frame_times(double start, double end, double rate) {
  std::vector<double> times;
  const auto frames = static_cast<long>(std::floor((end - start) * rate + 1e-9));
  for (long k = 0; k <= frames; ++k) times.push_back(std::min(end, start + static_cast<double>(k) / rate));
  if (times.back() < end) times.push_back(end);
  return times;
}

std::vector<double> even_times(double start, double end, int count) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k)
    times.push_back(k + 1 == count ? end : start + (end - start) * k / std::max(1, count - 1));
  return times;
}

std::vector<double> between(const Samples& samples, const std::vector<std::vector<double>>& rows, double time) {
  const auto after = std::ranges::lower_bound(samples.times, time);
  if (after == samples.times.end()) return rows.back();
  const auto i = static_cast<std::size_t>(after - samples.times.begin());
  if (i == 0) return rows.front();
  const double share = (time - samples.times[i - 1]) / (samples.times[i] - samples.times[i - 1]);
  std::vector<double> row;
  for (std::size_t k = 0; k < rows[i].size(); ++k)
    row.push_back(rows[i - 1][k] + share * (rows[i][k] - rows[i - 1][k]));
  return row;
}

}  // namespace spacetime
