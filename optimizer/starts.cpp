#include "optimizer/starts.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <thread>

namespace spacetime::optimizer {
namespace {

constexpr double same_objective = 1e-6, same_unknown = 1e-2;
constexpr auto pause = std::chrono::milliseconds(5);  // between two looks at what the threads have done

bool same(const Ending& a, const Ending& b) {
  const double f = a.state.values.objective, g = b.state.values.objective;
  if (!(std::abs(f - g) <= same_objective * std::max(1.0, std::abs(f)))) return false;
  for (std::size_t u = 0; u < a.state.x.size(); ++u) {
    if (std::abs(a.state.x[u] - b.state.x[u]) > same_unknown) return false;
  }
  return true;
}

}  // namespace

std::vector<Ending> solve_from(const Transcription& t, const Layout& layout,
                               const std::vector<std::vector<double>>& starts, int iterations, double tolerance,
                               const Crew& crew, const std::function<bool(std::span<const Ending> ended)>& wait) {
  const int count = static_cast<int>(starts.size());
  std::vector<Ending> endings(starts.size());
  std::vector<std::atomic<bool>> ended(starts.size());
  std::atomic<int> next = 0;
  std::atomic<bool> stop = false;
  const auto work = [&] {
    Newton newton(t, layout);
    while (!stop || next == 0) {  // the first is always begun: something has to be gone on from
      const int k = next++;
      if (k >= count) return;
      Ending& ending = endings[k];
      ending.state = newton.start(starts[k]);
      for (int i = 0; i < iterations && !stop && ending.result == StepResult::stepped; ++i) {
        ending.result = newton.step(ending.state, tolerance);
      }
      if (ending.result == StepResult::stepped && ending.state.measures.within(tolerance)) {
        ending.result = StepResult::converged;
      }
      ending.cut = ending.result == StepResult::stepped && ending.state.iterations < iterations;
      // Matrices are what of a state is large, and follow from the rest.
      ending.state.linear = {};
      ending.state.gradient.resize(0);
      ended[k] = true;
    }
  };
  std::vector<std::exception_ptr> failures(std::clamp(crew.threads, 1, count));
  {
    std::vector<std::jthread> workers;
    struct Stopper {  // however this ends, nobody is waited for who has not been told
      std::atomic<bool>& stop;
      ~Stopper() { stop = true; }
    } stopper{stop};
    for (std::exception_ptr& failure : failures) {
      workers.emplace_back([&] {
        try {
          crew.around ? crew.around(work) : work();
        } catch (...) {
          failure = std::current_exception();
          stop = true;
        }
      });
    }
    for (std::size_t known = 0; !stop;) {
      while (known < endings.size() && ended[known]) ++known;
      if (!wait(std::span(endings).first(known)) || known == endings.size()) break;
      std::this_thread::sleep_for(pause);
    }
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  endings.resize(std::min(next.load(), count));
  return endings;
}

bool better(const Ending& a, const Ending& b, double tolerance) {
  const auto rank = [&](const Ending& e) {
    return std::pair{!(e.state.measures.violation <= tolerance), e.result != StepResult::converged};
  };
  if (rank(a) != rank(b)) return rank(a) < rank(b);
  if (rank(a).first) return a.state.measures.violation < b.state.measures.violation;
  return a.state.values.objective < b.state.values.objective;
}

std::vector<std::vector<int>> distinct(const std::vector<Ending>& endings, double tolerance) {
  std::vector<int> order(endings.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::ranges::stable_sort(order, [&](int a, int b) { return better(endings[a], endings[b], tolerance); });
  std::vector<std::vector<int>> groups;
  for (const int k : order) {
    if (endings[k].result != StepResult::converged) continue;
    const auto group =
        std::ranges::find_if(groups, [&](const auto& g) { return same(endings[g.front()], endings[k]); });
    if (group == groups.end()) {
      groups.push_back({k});
    } else {
      group->push_back(k);
    }
  }
  for (auto& group : groups) std::ranges::sort(group.begin() + 1, group.end());
  return groups;
}

}  // namespace spacetime::optimizer
