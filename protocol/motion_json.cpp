#include "protocol/motion_json.h"

#include <array>

#include "protocol/check.h"
#include "protocol/program_json.h"

namespace spacetime {
namespace {

constexpr std::array statuses{Status::converged, Status::stopped, Status::infeasible, Status::failed};

using Named = std::vector<std::pair<std::string, double>>;
using Rows = std::vector<std::vector<double>>;

void member(Writer& to, std::string_view name, const Named& numbers) {
  to.key(name);
  to.object([&] {
    for (const auto& [key, number] : numbers) to.member(key, number);
  });
}

Named named_numbers(const Node& node) {
  Named result;
  node.members([&](const std::string& name, const Node& number) { result.emplace_back(name, number.number()); });
  return result;
}

void member(Writer& to, std::string_view name, const std::map<std::string, Rows>& tables) {
  to.key(name);
  to.object(
      [&] {
        for (const auto& [key, rows] : tables) {
          to.key(key);
          to.list_of(rows, [&](const std::vector<double>& row) { to.numbers(row); });
        }
      },
      Set::in_lines);
}

std::map<std::string, Rows> tables_from(const Node& node) {
  std::map<std::string, Rows> result;
  node.members([&](const std::string& name, const Node& rows) {
    result.emplace(name, rows.each([](const Node& row) { return row.numbers(); }));
  });
  return result;
}

void write(Writer& to, const Violation& violation) {
  to.object([&] {
    to.member("name", violation.name);
    to.member("max", violation.max);
    to.key("time");
    if (violation.time) {
      to.number(*violation.time);
    } else {
      to.null();
    }
    to.member("line", violation.line);
  });
}

Violation violation_from(const Node& node) {
  node.object({"name", "max", "time", "line"});
  Violation violation{node["name"].string(), node["max"].number(), {}, node["line"].integer()};
  const auto time = node["time"];
  if (!time.is_null()) violation.time = time.number();
  return violation;
}

void write(Writer& to, const Trajectory& dof) {
  to.object([&] {
    to.member("name", dof.name);
    to.key("basis");
    write(to, dof.basis);
    to.key("coefficients");
    to.numbers(dof.coefficients);
  });
}

Trajectory dof_from(const Node& node) {
  node.object({"name", "basis", "coefficients"});
  return {node["name"].string(), basis_from(node["basis"]), node["coefficients"].numbers()};
}

void write(Writer& to, const Samples& samples) {
  to.object(
      [&] {
        to.key("times");
        to.numbers(samples.times);
        member(to, "values", samples.values);
        member(to, "poses", samples.poses);
      },
      Set::in_lines);
}

Samples samples_from(const Node& node) {
  node.object({"times", "values", "poses"});
  return {node["times"].numbers(), tables_from(node["values"]), tables_from(node["poses"])};
}

Status status_from(const Node& node) {
  std::array<std::string_view, statuses.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = name_of(statuses[i]);
  return statuses[node.choice(names)];
}

}  // namespace

void write(Writer& to, const Motion& motion) {
  to.object(
      [&] {
        to.member("format", motion_format);
        to.key("time");
        to.numbers(std::array{motion.start, motion.end});
        to.member("status", name_of(motion.status));
        to.member("message", motion.message);
        to.member("iterations", motion.iterations);
        to.key("seconds");
        to.object([&] {
          to.member("total", motion.seconds.total);
          to.member("evaluate", motion.seconds.evaluate);
          to.member("factor", motion.seconds.factor);
        });
        to.key("objective");
        to.object([&] {
          to.member("total", motion.objective);
          member(to, "terms", motion.terms);
        });
        to.key("violation");
        to.object([&] {
          to.member("max", motion.violation);
          to.key("constraints");
          to.list_of(
              motion.violations, [&](const Violation& violation) { write(to, violation); }, Set::in_lines);
        });
        to.key("dofs");
        to.list_of(
            motion.dofs, [&](const Trajectory& dof) { write(to, dof); }, Set::in_lines);
        member(to, "constants", motion.constants);
        to.key("parameters");
        to.object([] {});
        if (motion.samples) {
          to.key("samples");
          write(to, *motion.samples);
        }
      },
      Set::in_lines);
}

std::string write(const Motion& motion) {
  Writer to;
  write(to, motion);
  return to.take();
}

Motion motion_from(const Node& node) {
  static constexpr std::array formats{motion_format};
  node["format"].choice(formats);
  node.object({"format", "time", "status", "message", "iterations", "seconds", "objective", "violation", "dofs",
               "constants", "parameters"},
              {"samples"});
  Motion motion;
  const auto time = node["time"];
  if (time.list() != 2) time.expected("a list of 2 numbers");
  motion.start = time[0].number();
  motion.end = time[1].number();
  motion.status = status_from(node["status"]);
  motion.message = node["message"].string();
  motion.iterations = node["iterations"].integer();
  const auto seconds = node["seconds"];
  seconds.object({"total", "evaluate", "factor"});
  motion.seconds = {seconds["total"].number(), seconds["evaluate"].number(), seconds["factor"].number()};
  const auto objective = node["objective"];
  objective.object({"total", "terms"});
  motion.objective = objective["total"].number();
  motion.terms = named_numbers(objective["terms"]);
  const auto violation = node["violation"];
  violation.object({"max", "constraints"});
  motion.violation = violation["max"].number();
  motion.violations = violation["constraints"].each(violation_from);
  motion.dofs = node["dofs"].each(dof_from);
  motion.constants = named_numbers(node["constants"]);
  node["parameters"].object({});
  if (const auto samples = node.find("samples")) motion.samples = samples_from(*samples);
  return motion;
}

Motion read_motion(std::string_view json) {
  const auto tree = parse(json, motion_document);
  auto motion = motion_from({tree, motion_document});
  if (auto fault = validate(motion)) throw DocumentError(motion_document, fault->path, fault->message);
  return motion;
}

}  // namespace spacetime
