#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <unordered_set>

#include "protocol/check.h"
#include "protocol/limits.h"
#include "protocol/path.h"

namespace spacetime {
namespace {

using Rows = std::vector<std::vector<double>>;

constexpr std::size_t pose_columns = 12;  // [R | p], 3 x 4 by rows

std::optional<Fault> finite(double number, std::string path) {
  if (std::isfinite(number)) return std::nullopt;
  return Fault{std::move(path), "must be finite"};
}

// What was measured along the motion; where that failed there may be no number.
std::optional<Fault> measured(double measure, bool failed, std::string path) {
  if (failed || std::isfinite(measure)) return std::nullopt;
  return Fault{std::move(path), "must be a finite number: only a motion whose status is \"failed\" may lack it"};
}

// Of long lists: a place is only told where something is wrong there.
std::optional<Fault> all_finite(const std::vector<double>& numbers, std::string_view path) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) return finite(numbers[i], below(path, i));
  }
  return std::nullopt;
}

std::optional<Fault> validate_named(const std::vector<std::pair<std::string, double>>& numbers, std::string_view path,
                                    auto check) {
  std::unordered_set<std::string_view> names;
  for (const auto& [name, number] : numbers) {
    const auto own = below(path, name);
    if (auto fault = validate_name(name, own)) return fault;
    if (!names.insert(name).second) return Fault{own, "the name is there twice"};
    if (auto fault = check(number, own)) return fault;
  }
  return std::nullopt;
}

std::optional<Fault> validate_table(const Rows& rows, std::size_t times, std::size_t columns, bool failed,
                                    std::string_view path) {
  if (rows.size() != times) {
    return Fault{std::string(path), std::to_string(rows.size()) + " rows, but " + std::to_string(times) + " times"};
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns) {
      return Fault{below(path, i), std::to_string(rows[i].size()) + " columns, expected " + std::to_string(columns)};
    }
    for (std::size_t k = 0; k < columns && !failed; ++k) {
      if (!std::isfinite(rows[i][k])) return measured(rows[i][k], failed, below(below(path, i), k));
    }
  }
  return std::nullopt;
}

std::optional<Fault> validate(const Samples& samples, bool failed) {
  if (auto fault = all_finite(samples.times, "/samples/times")) return fault;
  for (const auto& [name, rows] : samples.values) {
    const auto path = below("/samples/values", name);
    if (auto fault = validate_name(name, path)) return fault;
    const auto columns = rows.empty() ? 0 : rows.front().size();
    if (auto fault = validate_table(rows, samples.times.size(), columns, failed, path)) return fault;
  }
  for (const auto& [name, rows] : samples.poses) {
    const auto path = below("/samples/poses", name);
    if (auto fault = validate_name(name, path)) return fault;
    if (auto fault = validate_table(rows, samples.times.size(), pose_columns, failed, path)) return fault;
  }
  return std::nullopt;
}

std::optional<Fault> validate_dofs(const Motion& motion, const std::vector<Trajectory>& dofs, const std::string& of) {
  std::unordered_set<std::string_view> names;
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto& dof = dofs[i];
    const auto path = below(of, i);
    if (auto fault = validate_name(dof.name, path + "/name")) return fault;
    if (!names.insert(dof.name).second) return Fault{path + "/name", "an earlier one has this name"};
    if (auto fault = validate(dof.basis, motion.start, motion.end, path + "/basis")) return fault;
    if (dof.coefficients.size() + 4 != dof.basis.knots.size()) {
      return Fault{path + "/coefficients", std::to_string(dof.coefficients.size()) + " coefficients, but " +
                                               std::to_string(dof.basis.knots.size()) + " knots ask for " +
                                               std::to_string(dof.basis.size())};
    }
    if (auto fault = all_finite(dof.coefficients, path + "/coefficients")) return fault;
  }
  return std::nullopt;
}

std::optional<Fault> validate_minima(const Motion& motion) {
  for (std::size_t i = 0; i < motion.minima.size(); ++i) {
    const auto& minimum = motion.minima[i];
    const auto path = below("/minima", i);
    if (auto fault = finite(minimum.objective, path + "/objective")) return fault;
    for (std::size_t k = 0; k < minimum.starts.size(); ++k) {
      if (minimum.starts[k] < 0) return Fault{below(path + "/starts", k), "must not be negative"};
    }
    if (auto fault = validate_dofs(motion, minimum.dofs, path + "/dofs")) return fault;
  }
  return std::nullopt;
}

std::optional<Fault> validate_violations(const Motion& motion, bool failed) {
  for (std::size_t i = 0; i < motion.violations.size(); ++i) {
    const auto& violation = motion.violations[i];
    const auto path = below("/violation/constraints", i);
    if (auto fault = validate_name(violation.name, path + "/name")) return fault;
    if (auto fault = measured(violation.max, failed, path + "/max")) return fault;
    if (auto fault = finite(violation.time.value_or(0), path + "/time")) return fault;
    if (const auto& multiplier = violation.multiplier) {
      if (auto fault = finite(multiplier->value, path + "/multiplier/value")) return fault;
      if (auto fault = finite(multiplier->time.value_or(0), path + "/multiplier/time")) return fault;
    }
    if (violation.line < 0) return Fault{path + "/line", "must not be negative"};
  }
  return std::nullopt;
}

std::optional<Fault> validate_multipliers(const Motion& motion) {
  for (std::size_t i = 0; i < motion.multipliers.size(); ++i) {
    const auto& [name, line, times, values] = motion.multipliers[i];
    const auto path = below("/multipliers", i);
    if (auto fault = validate_name(name, path + "/name")) return fault;
    if (line < 0) return Fault{path + "/line", "must not be negative"};
    if (auto fault = all_finite(times, path + "/times")) return fault;
    if (values.size() != std::max<std::size_t>(times.size(), 1)) {
      return Fault{path + "/values", "needs one row an instance"};
    }
    for (std::size_t row = 0; row < values.size(); ++row) {
      const auto own = [&] { return below(path + "/values", row); };
      if (values[row].empty() || values[row].size() != values.front().size()) {
        return Fault{own(), "needs one number a component"};
      }
      if (auto fault = all_finite(values[row], {})) return Fault{own() + fault->path, fault->message};
    }
  }
  return std::nullopt;
}

std::optional<Fault> validate_record(const Motion& motion, bool failed) {
  for (std::size_t i = 0; i < motion.record.size(); ++i) {
    const auto& record = motion.record[i];
    const auto path = below("/record", i);
    if (record.iteration < 0) return Fault{path + "/iteration", "must not be negative"};
    if (auto fault = measured(record.objective, failed, path + "/objective")) return fault;
    for (const auto& [name, value] : record.terms) {
      if (auto fault = measured(value, failed, below(path + "/terms", name))) return fault;
    }
    if (auto fault = measured(record.violation, failed, path + "/violation")) return fault;
    if (auto fault = measured(record.stationarity, failed, path + "/stationarity")) return fault;
    if (auto fault = finite(record.step, path + "/step")) return fault;
    if (auto fault = finite(record.shift, path + "/shift")) return fault;
    if (auto fault = finite(record.seconds, path + "/seconds")) return fault;
  }
  return std::nullopt;
}

// Bodies mean what they would mean in a problem of the same trajectories and numbers.
std::optional<Fault> validate_bodies(const Motion& motion) {
  if (motion.bodies.empty() && motion.programs.empty()) return std::nullopt;
  Problem problem;
  problem.start = motion.start;
  problem.end = motion.end;
  for (const auto& [name, value] : motion.constants) problem.constants.push_back({name, {value, {}, 0}, {}});
  for (const auto& [name, value] : motion.parameters) problem.parameters.push_back({name, {value, {}, 0}, {}});
  for (const auto& dof : motion.dofs) problem.dofs.push_back({dof.name, dof.basis, {}, {}});
  problem.programs = motion.programs;
  problem.bodies = motion.bodies;
  return validate(problem);
}

}  // namespace

std::optional<Fault> validate(const Motion& motion) {
  const bool failed = motion.status == Status::failed;
  const auto term = [&](double value, const std::string& path) { return measured(value, failed, path); };
  if (auto fault = finite(motion.start, "/time/0")) return fault;
  if (auto fault = finite(motion.end, "/time/1")) return fault;
  if (!(motion.start < motion.end)) return Fault{"/time", "the time must rise"};
  if (motion.iterations < 0 || motion.iterations > limits::count) {
    return Fault{"/iterations", "must be from 0 to " + std::to_string(limits::count)};
  }
  if (auto fault = finite(motion.seconds.total, "/seconds/total")) return fault;
  if (auto fault = finite(motion.seconds.evaluate, "/seconds/evaluate")) return fault;
  if (auto fault = finite(motion.seconds.factor, "/seconds/factor")) return fault;
  if (auto fault = measured(motion.objective, failed, "/objective/total")) return fault;
  if (auto fault = validate_named(motion.terms, "/objective/terms", term)) return fault;
  if (auto fault = measured(motion.violation, failed, "/violation/max")) return fault;
  if (auto fault = validate_violations(motion, failed)) return fault;
  if (auto fault = validate_dofs(motion, motion.dofs, "/dofs")) return fault;
  if (auto fault = validate_named(motion.constants, "/constants", finite)) return fault;
  if (auto fault = validate_named(motion.parameters, "/parameters", finite)) return fault;
  if (auto fault = validate_multipliers(motion)) return fault;
  if (motion.samples) {
    if (auto fault = validate(*motion.samples, failed)) return fault;
  }
  if (auto fault = validate_minima(motion)) return fault;
  if (auto fault = validate_bodies(motion)) return fault;
  if (motion.checkpoint) {
    if (auto fault = validate(*motion.checkpoint, motion)) return fault;
  }
  return validate_record(motion, failed);
}

}  // namespace spacetime
