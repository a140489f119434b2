// Compiling an arm of twelve links, from nothing and after a change of one constraint.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "symbolic/compiler.h"
#include "tests/symbolic/twelve_links.h"

namespace {

using namespace spacetime::symbolic;

template <class F>
double best_milliseconds(int runs, F f) {
  double best = 1e300;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    f(i);
    best = std::min(best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void print(const char* name, double milliseconds, const Statistics& s) {
  const auto& ms = s.milliseconds;
  std::printf(
      "%-28s %8.2f ms   derived %zu of %zu programs, %zu operations; last: parse %.2f build %.2f "
      "differentiate %.2f emit %.2f\n",
      name, milliseconds, s.derived, s.programs, s.operations, ms.parse, ms.build, ms.differentiate, ms.emit);
}

}  // namespace

int main() {
  Statistics statistics;
  const double cold = best_milliseconds(20, [&](int) { statistics = compile(twelve_links()).statistics; });
  print("from nothing", cold, statistics);
  Compiler compiler;
  compiler.compile(twelve_links());
  const double warm = best_milliseconds(50, [&](int i) {
    const std::string goal = "at(arm.hand.y, 1) + at(arm.hand.y', 1)*0." + std::to_string(i + 1) + " = 0.5";
    statistics = compiler.compile(twelve_links(goal)).statistics;
  });
  print("another throw", warm, statistics);
  const double value = best_milliseconds(50, [&](int i) {
    statistics = compiler.compile(twelve_links("at(arm.q3, 1) = 0." + std::to_string(i + 1))).statistics;
  });
  print("another pose", value, statistics);
}
