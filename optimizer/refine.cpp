#include "optimizer/refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "optimizer/batch.h"

namespace spacetime::optimizer {
namespace {

// Points of a span at which two curves are compared.
constexpr int points = 8;

// Spans shorter than this, of the animation's time, cannot be told apart from rounding.
constexpr double shortest_span = 1e-9;

// A problem of more coefficients is a mistake, not a motion.
constexpr int most_coefficients = 1 << 20;

// How many spans more there are where one is halved `times` times, each time the parts that overlap [a, b].
double halves(double from, double to, double a, double b, int times) {
  if (!(from < b && to > a)) return 0;
  if (from >= a && to <= b) return std::ldexp(1.0, times) - 1;  // all parts do
  double more = 0;
  std::vector<std::pair<double, double>> across{{from, to}};  // at most two: those around a and b
  for (; times > 0; --times) {
    std::vector<std::pair<double, double>> next;
    for (const auto& [left, right] : across) {
      const double middle = left + (right - left) / 2;
      ++more;
      for (const auto& [l, r] : {std::pair(left, middle), std::pair(middle, right)}) {
        if (!(l < b && r > a)) continue;
        if (l >= a && r <= b) {
          more += std::ldexp(1.0, times - 1) - 1;
        } else {
          next.emplace_back(l, r);
        }
      }
    }
    across = std::move(next);
  }
  return more;
}

}  // namespace

void halve(Basis& basis, const std::vector<double>& spans, std::vector<double>& curve) {
  const auto knots = breakpoints(basis);
  const double least = shortest_span * (knots.back() - knots.front());
  std::vector<double> middles;
  for (const double from : spans) {
    const double to = *std::ranges::upper_bound(knots, from);
    if (to - from < least) {
      throw InputError(
          fmt::format("the knot span at {} s is only {:.3g} s long and cannot be halved", from, to - from));
    }
    middles.push_back(from + (to - from) / 2);
  }
  curve = insert_knots(basis, curve, middles);
}

Refine most_of(const Refine& action) { return action.automatic ? Refine{{}, action.dofs, 1, {}} : action; }

double refined_coefficients(const Problem& problem, const Constants& constants, const Refine& action) {
  const auto [a, b] = span_of(problem, constants, action.interval, "interval");
  const auto named = named_dofs(problem, action.dofs);
  double coefficients = 0;
  for (std::size_t dof = 0; dof < named.size(); ++dof) {
    const Basis& basis = problem.dofs[dof].basis;
    coefficients += basis.size();
    if (!named[dof]) continue;
    const auto knots = breakpoints(basis);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      coefficients += halves(knots[k], knots[k + 1], a, b, action.times);
    }
  }
  return coefficients;
}

void refine(Problem& problem, const Constants& constants, const Refine& action, Curves& curves) {
  const auto [a, b] = span_of(problem, constants, action.interval, "interval");
  const auto named = named_dofs(problem, action.dofs);
  if (refined_coefficients(problem, constants, action) > most_coefficients) {
    throw InputError(fmt::format("more than {} coefficients: refine fewer times", most_coefficients));
  }
  for (int round = 0; round < action.times; ++round) {
    for (std::size_t dof = 0; dof < named.size(); ++dof) {
      if (!named[dof]) continue;
      Basis& basis = problem.dofs[dof].basis;
      const auto knots = breakpoints(basis);
      std::vector<double> spans;
      for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        if (knots[k] < b && knots[k + 1] > a) spans.push_back(knots[k]);
      }
      halve(basis, spans, curves[dof]);
    }
  }
}

std::vector<double> spans_that_differ(const Basis& basis, const std::vector<double>& a, const std::vector<double>& b,
                                      double tolerance) {
  const auto knots = breakpoints(basis);
  std::vector<double> spans;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    double largest = 0;
    for (int i = 0; i <= points; ++i) {
      const double t = knots[k] + (knots[k + 1] - knots[k]) * i / points;
      largest = std::max(largest, std::abs(value(basis, a, t) - value(basis, b, t)));
    }
    if (largest > tolerance) spans.push_back(knots[k]);
  }
  return spans;
}

}  // namespace spacetime::optimizer
