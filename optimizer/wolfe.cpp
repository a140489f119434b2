#include "optimizer/wolfe.h"

#include <algorithm>
#include <cmath>

namespace spacetime::optimizer {
namespace {

constexpr double decrease = 1e-4, flatness = 0.9;
constexpr double growth = 2;     // from one trial length to the next, before an interval is found
constexpr double margin = 0.1;   // of an interval: interpolated lengths keep this far from its ends
constexpr int most_trials = 60;  // halving an interval so often leaves nothing of it

bool low_enough(const LinePoint& start, const LinePoint& there, double noise) {
  return there.value <= start.value + decrease * there.length * start.slope + noise;  // false for what is no number
}

bool flat_enough(const LinePoint& start, const LinePoint& there) {
  return std::abs(there.slope) <= flatness * std::abs(start.slope);
}

// The minimum of the cubic through two values and slopes, kept inside; the middle where there is none.
double between(const LinePoint& a, const LinePoint& b) {
  const double middle = (a.length + b.length) / 2, width = std::abs(b.length - a.length);
  const double d1 = a.slope + b.slope - 3 * (a.value - b.value) / (a.length - b.length);
  const double square = d1 * d1 - a.slope * b.slope;
  if (!(square >= 0)) return middle;
  const double d2 = std::copysign(std::sqrt(square), b.length - a.length);
  const double at = b.length - (b.length - a.length) * (b.slope + d2 - d1) / (b.slope - a.slope + 2 * d2);
  if (!std::isfinite(at)) return middle;
  const double low = std::min(a.length, b.length) + margin * width;
  return std::clamp(at, low, low + (1 - 2 * margin) * width);
}

}  // namespace

std::optional<LinePoint> wolfe_search(const std::function<LinePoint(double)>& phi, const LinePoint& start, double first,
                                      double longest, double noise) {
  if (!(start.slope < 0)) return std::nullopt;
  // Lengths grow until an interval must hold a point: `best` is the lowest end, `other` the far one.
  LinePoint best = start, other;
  int trials = 0;
  for (LinePoint there = phi(std::min(first, longest));; there = phi(std::min(growth * there.length, longest))) {
    ++trials;
    if (!low_enough(start, there, noise) || (trials > 1 && !(there.value < best.value))) {
      other = there;
      break;
    }
    if (flat_enough(start, there)) return there;
    if (there.slope >= 0) {
      other = best;
      best = there;
      break;
    }
    if (there.length >= longest || trials == most_trials) return there;
    best = there;
  }
  for (; trials < most_trials; ++trials) {
    const LinePoint there = phi(between(best, other));
    if (!low_enough(start, there, noise) || !(there.value < best.value)) {
      other = there;
      continue;
    }
    if (flat_enough(start, there)) return there;
    if (there.slope * (other.length - best.length) >= 0) other = best;
    best = there;
  }
  if (best.length == 0) return std::nullopt;
  return phi(best.length);
}

}  // namespace spacetime::optimizer
