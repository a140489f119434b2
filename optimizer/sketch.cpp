#include "optimizer/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/bspline.h"
#include "common/diagnostic.h"

namespace spacetime::optimizer {
namespace {

// Samples of a curve a knot span when it is fitted onto a basis.
constexpr int samples_per_span = 8;

std::vector<double> fit_times(const Basis& basis) {
  const auto knots = breakpoints(basis);
  std::vector<double> times;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    for (int i = 0; i < samples_per_span; ++i) {
      times.push_back(knots[k] + (knots[k + 1] - knots[k]) * i / samples_per_span);
    }
  }
  times.push_back(knots.back());
  return times;
}

template <typename Curve>
std::vector<double> fit_curve(const Basis& basis, Curve curve) {
  const auto times = fit_times(basis);
  std::vector<double> values;
  values.reserve(times.size());
  for (const double t : times) values.push_back(curve(t));
  return fit(basis, times, values);
}

// Fritsch and Butland's slope at an inner key: the weighted harmonic mean of the secants' slopes, 0 at an extremum.
double inner_slope(double h0, double h1, double s0, double s1) {
  if (s0 * s1 <= 0) return 0;
  const double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
  return (w0 + w1) / (w0 / s0 + w1 / s1);
}

struct Keys {
  std::vector<double> times, values;
};

std::map<std::string, Keys> keys_of(const Problem& problem, const Constants& constants) {
  std::map<std::string, std::map<double, double>> found;
  for (const Keyframe& keyframe : problem.keyframes) {
    const std::string what = "keyframe in line " + std::to_string(keyframe.place.line);
    const double time = evaluate(problem, constants, keyframe.time, what + ": the time");
    if (time < problem.start || time > problem.end) {
      throw InputError(fmt::format("{}: the time {:.6g} lies outside the animation's, {:.6g} to {:.6g}", what, time,
                                   problem.start, problem.end));
    }
    for (const Key& key : keyframe.keys) {
      const double value = evaluate(problem, constants, key.value, what + ": the value of " + key.dof);
      if (!found[key.dof].emplace(time, value).second) {
        throw InputError(what + ": " + key.dof + " has a key at this time already");
      }
    }
  }
  std::map<std::string, Keys> result;
  for (const auto& [dof, keys] : found) {
    for (const auto& [time, value] : keys) {
      result[dof].times.push_back(time);
      result[dof].values.push_back(value);
    }
  }
  return result;
}

}  // namespace

double through_keys(std::span<const double> times, std::span<const double> values, double t) {
  if (t <= times.front()) return values.front();
  if (t >= times.back()) return values.back();
  const auto k = static_cast<std::size_t>(std::ranges::upper_bound(times, t) - times.begin()) - 1;
  const auto width = [&](std::size_t i) { return times[i + 1] - times[i]; };
  const auto secant = [&](std::size_t i) { return (values[i + 1] - values[i]) / width(i); };
  // At both ends the curve goes on as a constant, so it starts and ends with slope 0.
  const auto slope = [&](std::size_t i) {
    if (i == 0 || i + 1 == times.size()) return 0.0;
    return inner_slope(width(i - 1), width(i), secant(i - 1), secant(i));
  };
  const double h = width(k), u = (t - times[k]) / h, v = 1 - u;
  return values[k] * v * v * (1 + 2 * u) + values[k + 1] * u * u * (1 + 2 * v) +
         h * u * v * (slope(k) * v - slope(k + 1) * u);
}

std::vector<double> sketch(const Problem& problem, const Constants& constants) {
  const auto keys = keys_of(problem, constants);
  std::vector<double> x;
  for (const Dof& dof : problem.dofs) {
    const auto found = keys.find(dof.name);
    std::vector<double> coefficients;
    if (found == keys.end()) {
      coefficients.assign(dof.basis.size(), evaluate(problem, constants, dof.start, "the start of " + dof.name));
    } else {
      const auto& [times, values] = found->second;
      coefficients = fit_curve(dof.basis, [&](double t) { return through_keys(times, values, t); });
    }
    x.insert(x.end(), coefficients.begin(), coefficients.end());
  }
  return x;
}

std::vector<double> sketch_from(const Problem& problem, const Constants& constants, const Motion& motion) {
  std::vector<double> x = sketch(problem, constants);
  std::size_t first = 0;
  for (const Dof& dof : problem.dofs) {
    const auto found = std::ranges::find(motion.dofs, dof.name, &Trajectory::name);
    if (found != motion.dofs.end()) {
      const Trajectory& old = *found;
      if (static_cast<int>(old.coefficients.size()) != old.basis.size()) {
        throw InputError("the motion to start from has " + std::to_string(old.coefficients.size()) +
                         " coefficients for " + dof.name + ", its basis wants " + std::to_string(old.basis.size()));
      }
      auto coefficients = old.coefficients;
      if (old.basis != dof.basis) {
        const double low = old.basis.knots.front(), high = old.basis.knots.back();
        coefficients = fit_curve(
            dof.basis, [&](double t) { return value(old.basis, old.coefficients, std::clamp(t, low, high)); });
      }
      std::ranges::copy(coefficients, x.begin() + static_cast<std::ptrdiff_t>(first));
    }
    first += dof.basis.size();
  }
  return x;
}

}  // namespace spacetime::optimizer
