#include "optimizer/reshape.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "optimizer/banded.h"
#include "optimizer/batch.h"
#include "optimizer/quadrature.h"

namespace spacetime::optimizer {
namespace {

constexpr int shake_spans = 8;
constexpr double key_reach = 1.0 / 16;  // r of a key's bump, of the animation's time

// The degrees of freedom of an action that have something free.
std::vector<int> meant(const Problem& problem, const Freedom& freedom, const DofNames& names) {
  std::vector<int> dofs;
  for (const std::string& name : names) dofs.push_back(require_dof(problem, name));
  if (names.empty()) {
    for (int dof = 0; dof < static_cast<int>(problem.dofs.size()); ++dof) dofs.push_back(dof);
  }
  std::erase_if(dofs, [&](int dof) { return freedom.dofs[dof].from >= freedom.dofs[dof].to; });
  return dofs;
}

// integral B_i B_j + bending B_i'' B_j'' over all time, for the coefficients in a range, factored.
Factorisation quadratic(const Basis& basis, Freedom::Range range, double bending) {
  Pattern pattern;
  pattern.n = range.to - range.from;
  pattern.width = 3;
  BorderedMatrix matrix(std::make_shared<const Pattern>(pattern));
  const auto rule = gauss_legendre(breakpoints(basis), basis.knots.front(), basis.knots.back());
  for (std::size_t s = 0; s < rule.times.size(); ++s) {
    const BasisValues at = basis_values(basis, rule.times[s]);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j <= i; ++j) {
        const int row = at.first + i - range.from, column = at.first + j - range.from;
        if (column < 0 || row >= pattern.n) continue;
        matrix.add(row, column, rule.weights[s] * (at.b[0][i] * at.b[0][j] + bending * at.b[2][i] * at.b[2][j]));
      }
    }
  }
  Factorisation factorisation;
  if (!factorisation.compute(matrix)) throw InputError("the curve's own matrix could not be factored");
  return factorisation;
}

}  // namespace

void shake(const Problem& problem, const Constants& constants, const Freedom& freedom, const Shake& action, int seed,
           Curves& curves) {
  const double amplitude = evaluate(problem, constants, action.amplitude, "shake amplitude");
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  for (const int dof : meant(problem, freedom, action.dofs)) {
    const auto [from, to] = freedom.dofs[dof];
    const Basis& basis = problem.dofs[dof].basis;
    const Basis coarse = uniform_basis(basis.knots[from], basis.knots[to + 3], shake_spans);
    std::vector<double> controls(coarse.size());
    for (double& c : controls) c = amplitude * (2 * std::ldexp(static_cast<double>(random() >> 11), -53) - 1);
    const auto times = greville(basis);
    for (int k = from; k < to; ++k) curves[dof][k] += value(coarse, controls, times[k]);
  }
}

void smooth(const Problem& problem, const Constants& constants, const Freedom& freedom, const Smooth& action,
            Curves& curves) {
  const double strength = evaluate(problem, constants, action.strength, "filter strength");
  if (!(strength > 0)) throw InputError(fmt::format("the strength of a filter, {} s, must be positive", strength));
  const double bending = std::pow(strength / (2 * std::numbers::pi), 4);
  for (const int dof : meant(problem, freedom, action.dofs)) {
    const Basis& basis = problem.dofs[dof].basis;
    auto [from, to] = freedom.dofs[dof];
    from = std::max(from, 2);  // the first two coefficients are the value and the velocity at the start
    to = std::min(to, basis.size() - 2);
    if (from >= to) continue;
    // With q = q0 + d:  (M + b S) d = -b S q0, and b S q0 is the gradient of the bending alone.
    const auto rule = gauss_legendre(breakpoints(basis), basis.knots.front(), basis.knots.back());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(to - from);
    for (std::size_t s = 0; s < rule.times.size(); ++s) {
      const BasisValues at = basis_values(basis, rule.times[s]);
      double q2 = 0;
      for (int i = 0; i < 4; ++i) q2 += at.b[2][i] * curves[dof][at.first + i];
      for (int i = 0; i < 4; ++i) {
        const int k = at.first + i - from;
        if (k >= 0 && k < right.size()) right[k] -= bending * rule.weights[s] * at.b[2][i] * q2;
      }
    }
    const Eigen::VectorXd change = quadratic(basis, {from, to}, bending).solve(right);
    for (int k = from; k < to; ++k) curves[dof][k] += change[k - from];
  }
}

void pull(const Problem& problem, const Constants& constants, const Freedom& freedom, const PullKeys& action,
          Curves& curves) {
  const double time = evaluate(problem, constants, action.time, "the key's time");
  if (!(problem.start <= time && time <= problem.end)) {
    throw InputError(
        fmt::format("the key's time {} lies outside the animation's, {} to {}", time, problem.start, problem.end));
  }
  const double bending = std::pow(key_reach * (problem.end - problem.start), 4);
  for (const Key& key : action.keys) {
    const int dof = require_dof(problem, key.dof);
    const double wanted = evaluate(problem, constants, key.value, "the key of " + key.dof);
    const Basis& basis = problem.dofs[dof].basis;
    const auto range = freedom.dofs[dof];
    const BasisValues at = basis_values(basis, time);
    // The least d^T M d with b^T d = wanted - q(time) is along M^-1 b.
    Eigen::VectorXd b = Eigen::VectorXd::Zero(std::max(0, range.to - range.from));
    for (int i = 0; i < 4; ++i) {
      if (freedom.has(dof, at.first + i)) b[at.first + i - range.from] = at.b[0][i];
    }
    if (b.size() == 0 || b.cwiseAbs().maxCoeff() == 0) {
      throw InputError(fmt::format("nothing of '{}' is free at {} s, so that it cannot be keyed there", key.dof, time));
    }
    const Eigen::VectorXd along = quadratic(basis, range, bending).solve(b);
    const double change = (wanted - value(basis, curves[dof], time)) / b.dot(along);
    for (int k = range.from; k < range.to; ++k) curves[dof][k] += change * along[k - range.from];
  }
}

void control(const Problem& problem, const Constants& constants, const Freedom& freedom, const Control& action,
             Curves& curves) {
  const int dof = require_dof(problem, action.dof);
  const int size = problem.dofs[dof].basis.size();
  if (action.index < 0 || action.index >= size) {
    throw InputError(fmt::format("'{}' has {} coefficients, numbered from 0", action.dof, size));
  }
  if (!freedom.has(dof, action.index)) {
    throw InputError(fmt::format("coefficient {} of '{}' is not free in the window", action.index, action.dof));
  }
  curves[dof][action.index] = evaluate(problem, constants, action.value, "control " + action.dof);
}

}  // namespace spacetime::optimizer
