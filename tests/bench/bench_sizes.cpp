// Sizes of derivatives and the time they take: the planar arm with n links, value, gradient and Hessian of its summed
// squared torques.  Nodes are counted as a tree and shared; operations are those of the emitted program, of the values
// alone, with the gradient, and in all.  The peer's nodes are CasADi's.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "symbolic/derivative.h"
#include "symbolic/emit.h"
#include "tests/symbolic/planar_arm.h"

using namespace spacetime;
using namespace spacetime::symbolic;

namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::string peer(int links) { return links == 3 ? "1587" : links == 6 ? "6004" : links == 12 ? "23776" : ""; }

}  // namespace

int main() {
  constexpr int repetitions = 20;
  std::printf("%5s %8s %10s %12s %8s %8s %24s %10s\n", "links", "torques", "gradient", "tree", "Hessian", "peer",
              "operations", "ms");
  for (int links = 1; links <= 12; ++links) {
    double best = 1e9;
    Program program;
    for (int i = 0; i < repetitions; ++i) {
      const auto start = std::chrono::steady_clock::now();
      Graph graph;
      const Expr sum = summed_squares(graph, generalised_forces(graph, planar_arm(graph, links)));
      program = emit(graph, {&sum, 1}, Derivatives::second);
      best = std::min(best, milliseconds_since(start));
    }
    Graph graph;
    const auto arm = planar_arm(graph, links);
    const auto tau = generalised_forces(graph, arm);
    const auto inputs = arm_inputs(arm);
    const Expr sum = summed_squares(graph, tau);
    std::vector<Expr> roots{sum};
    for (const auto& entry : jacobian(graph, roots, inputs)) roots.push_back(entry.value);
    const auto gradient = size_of(graph, roots);
    for (const auto& entry : hessian(graph, sum, inputs)) roots.push_back(entry.value);
    const auto all = size_of(graph, roots);
    const auto operations = std::to_string(program.value_operations) + " / " +
                            std::to_string(program.jacobian_operations) + " / " + std::to_string(program.op.size());
    std::printf("%5d %8zu %10zu %12.4g %8zu %8s %24s %10.2f\n", links, size_of(graph, tau).shared, gradient.shared,
                all.tree, all.shared, peer(links).c_str(), operations.c_str(), best);
  }
}
