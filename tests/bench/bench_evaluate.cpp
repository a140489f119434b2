// The interpreter's speed on random programs: nanoseconds an operation and sample, the median and the fastest of 21
// runs.  SPACETIME_TARGET chooses other kernels than this machine's best.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>

#include "common/evaluate.h"
#include "tests/common/random_program.h"

using namespace spacetime;

namespace {

double nanoseconds(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

void measure(const Program& program, std::size_t samples, std::mt19937_64& random) {
  std::vector<std::vector<double>> columns(program.inputs.size(), std::vector<double>(samples));
  std::vector<const double*> inputs;
  for (auto& column : columns) {
    for (auto& x : column) x = std::uniform_real_distribution<double>(0.1, 0.9)(random);
    inputs.push_back(column.data());
  }
  const std::vector<std::uint8_t> uniform(inputs.size(), 0);
  const Evaluator evaluator(program);
  std::vector<double> outputs(evaluator.outputs(Depth::values) * samples);

  const double work = static_cast<double>(program.op.size() * samples);
  const int repeats = 1 + static_cast<int>(2e7 / work);
  std::vector<double> times;
  for (int round = 0; round < 21; ++round) {
    times.push_back(nanoseconds([&] {
                      for (int r = 0; r < repeats; ++r) {
                        evaluator.run(Depth::values, samples, inputs, uniform, outputs.data(), samples);
                      }
                    }) /
                    (work * repeats));
  }
  std::sort(times.begin(), times.end());
  std::printf("%10zu %10zu %10.4f %10.4f\n", program.op.size(), samples, times[times.size() / 2], times.front());
}

}  // namespace

int main() {
  std::printf("%s, ns an operation and sample\n", std::string(evaluation_target()).c_str());
  std::printf("%10s %10s %10s %10s\n", "operations", "samples", "median", "fastest");
  std::mt19937_64 random(7);
  for (const int operations : {300, 1200, 3000, 30000}) {
    const auto program = random_program(12, operations, random);
    for (const std::size_t samples : {256, 4096}) measure(program, samples, random);
  }
}
