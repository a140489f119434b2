// What an iteration costs in a window, and with coarse curves beside fine ones: ratios of medians within one run.
// The throw of tests/reference (P94R), its spans from 64 to 4,096.  Each time is that of one accepted step.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "optimizer/newton.h"
#include "optimizer/sketch.h"
#include "optimizer/window.h"
#include "symbolic/compile.h"

using namespace spacetime;
using namespace spacetime::optimizer;

namespace {

constexpr int steps = 12, rounds = 7;

std::string scene_with(const std::string& trajectory, const std::string& others = "") {
  std::ifstream in(SPACETIME_SOURCE_DIR "/examples/throw_regularised.scene");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string old = "trajectory bspline spans 64";
  text.replace(text.find(old), old.size(), trajectory);
  return text.insert(text.find("let flight"), others + "\n");
}

struct Iterated {
  Problem problem;
  Transcription whole, part;
  Layout layout;
  std::vector<double> start;

  Iterated(const std::string& text, const Window& window)
      : problem(symbolic::compile(text).problem.value()),
        whole(transcribe(problem)),
        part(transcribe(problem, within(problem, whole.constants, window))),
        layout(arrange(part)) {
    auto x = sketch(problem, whole.constants);
    x.resize(whole.unknowns());
    Workspace workspace;
    settle_functionals(whole, x, workspace);
    settle_elsewhere(whole, part, x);
    start = taken(whole, part, x);
  }
  Iterated(const Iterated&) = delete;

  // The median time of a step, s, over `rounds` runs from the start.
  double step() const {
    std::vector<double> times;
    for (int round = 0; round < rounds; ++round) {
      Newton newton(part, layout);
      NewtonState state = newton.start(start);
      for (int k = 0; k < steps; ++k) {
        const auto begun = std::chrono::steady_clock::now();
        if (newton.step(state, 1e-12) != StepResult::stepped) break;
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
      }
    }
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
  }
};

std::string spans(int n) { return "trajectory bspline spans " + std::to_string(n); }
Window of(double from, double to, DofNames dofs = {}) {
  return {Interval{{from, {}, 0}, {to, {}, 0}}, std::move(dofs)};
}

}  // namespace

int main() {
  std::printf("a tenth of the time, two of three degrees of freedom, beside the whole\n");
  for (const int n : {64, 1024}) {
    const Iterated whole(scene_with(spans(n)), {}),
        tenth(scene_with(spans(n)), of(0.7, 0.9, {"arm.ELBOW", "arm.WRIST"}));
    const double a = whole.step(), b = tenth.step();
    std::printf("  %5d spans  whole %8.4f ms  window %8.4f ms  %5.1f times faster\n", n, 1e3 * a, 1e3 * b, a / b);
  }
  std::printf("eight spans of the window's time, in animations of different length\n");
  double first = 0;
  for (const int n : {64, 256, 1024, 4096}) {
    const Iterated window(scene_with(spans(n)), of(1.0, 1.0 + 16.0 / n));
    const double time = window.step();
    if (first == 0) first = time;
    std::printf("  %5d spans  %8.4f ms  %5.2f of the first\n", n, 1e3 * time, time / first);
  }
  std::printf("coarse shoulder and elbow beside a wrist of 1,024 spans\n");
  const Iterated uniform(scene_with(spans(1024)), {});
  const double fine = uniform.step();
  std::printf("  all 1,024    %8.4f ms\n", 1e3 * fine);
  for (const int ratio : {16, 128}) {
    const Iterated mixed(scene_with(spans(1024), spans(1024 / ratio) + " for arm.SHOULDER, arm.ELBOW"), {});
    const double time = mixed.step();
    std::printf("  1:%-4d       %8.4f ms  %5.2f of the uniform one; width %d, %d long rows\n", ratio, 1e3 * time,
                time / fine, mixed.layout.pattern->width, static_cast<int>(mixed.layout.pattern->long_rows.size()));
  }
}
