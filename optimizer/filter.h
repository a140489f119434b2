// The filter of a line search: pairs (violation, objective) that an acceptable point must improve upon, in one or the
// other. [Fletcher and Leyffer 2002; Waechter and Biegler 2006, §2.3]
#pragma once

#include <utility>
#include <vector>

namespace spacetime::optimizer {

class Filter {
 public:
  struct Pair {
    double violation, objective;
  };

  Filter() = default;
  Filter(std::vector<Pair> pairs, double most) : pairs_(std::move(pairs)), most_(most) {}
  const std::vector<Pair>& pairs() const { return pairs_; }
  double most() const { return most_; }

  // Whether a point improves upon every pair in the filter.
  bool admits(double violation, double objective) const {
    for (const auto& [v, f] : pairs_) {
      if (violation >= v && objective >= f) return false;
    }
    return violation <= most_;
  }

  // Forbids points that are, but for a margin, no better than this one in either respect.
  void add(double violation, double objective) {
    pairs_.push_back({(1 - margin) * violation, objective - margin * violation});
  }

  // Forbids violations above this.
  void limit(double violation) { most_ = violation; }
  void clear() { pairs_.clear(); }

  static constexpr double margin = 1e-5;  // fraction of the violation by which a step must improve

 private:
  std::vector<Pair> pairs_;
  double most_ = 1e300;
};

}  // namespace spacetime::optimizer
