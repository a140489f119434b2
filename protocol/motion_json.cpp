#include "protocol/motion_json.h"

#include <array>

#include "protocol/check.h"
#include "protocol/checkpoint_json.h"
#include "protocol/measure.h"
#include "protocol/program_json.h"

namespace spacetime {
namespace {

constexpr std::array statuses{Status::converged, Status::stopped, Status::infeasible, Status::failed};

using Rows = std::vector<std::vector<double>>;

void member(const Measures& measures, std::string_view name, const std::map<std::string, Rows>& tables) {
  auto& to = measures.to;
  to.key(name);
  to.object(
      [&] {
        for (const auto& [key, rows] : tables) {
          to.key(key);
          to.list_of(rows, [&](const std::vector<double>& row) {
            to.list_of(row, [&](double value) { measures.value(value); });
          });
        }
      },
      Set::in_lines);
}

std::map<std::string, Rows> tables_from(const Node& node) {
  std::map<std::string, Rows> result;
  node.members([&](const std::string& name, const Node& rows) {
    result.emplace(name, rows.each([](const Node& row) { return row.each(measure_from); }));
  });
  return result;
}

void write_time(Writer& to, const std::optional<double>& time) {
  to.key("time");
  if (time) {
    to.number(*time);
  } else {
    to.null();
  }
}

std::optional<double> time_from(const Node& node) {
  return node.is_null() ? std::nullopt : std::optional(node.number());
}

void write(const Measures& measures, const Violation& violation) {
  auto& to = measures.to;
  to.object([&] {
    to.member("name", violation.name);
    measures.member("max", violation.max);
    write_time(to, violation.time);
    to.member("line", violation.line);
    if (const auto& multiplier = violation.multiplier) {
      to.key("multiplier");
      to.object([&] {
        to.member("value", multiplier->value);
        write_time(to, multiplier->time);
      });
    }
  });
}

Violation violation_from(const Node& node) {
  node.object({"name", "max", "time", "line"}, {"multiplier"});
  Violation violation{node["name"].string(), measure_from(node["max"]), time_from(node["time"]),
                      node["line"].integer()};
  if (const auto multiplier = node.find("multiplier")) {
    multiplier->object({"value", "time"});
    violation.multiplier = Multiplier{(*multiplier)["value"].number(), time_from((*multiplier)["time"])};
  }
  return violation;
}

void write(Writer& to, const Multipliers& multipliers) {
  to.object([&] {
    to.member("name", multipliers.name);
    to.member("line", multipliers.line);
    to.key("times");
    to.numbers(multipliers.times);
    to.key("values");
    to.list_of(multipliers.values, [&](const std::vector<double>& row) { to.numbers(row); });
  });
}

Multipliers multipliers_from(const Node& node) {
  node.object({"name", "line", "times", "values"});
  return {node["name"].string(), node["line"].integer(), node["times"].numbers(),
          node["values"].each([](const Node& row) { return row.numbers(); })};
}

void write(const Measures& measures, const Samples& samples) {
  auto& to = measures.to;
  to.object(
      [&] {
        to.key("times");
        to.numbers(samples.times);
        member(measures, "values", samples.values);
        member(measures, "poses", samples.poses);
      },
      Set::in_lines);
}

Samples samples_from(const Node& node) {
  node.object({"times", "values", "poses"});
  return {node["times"].numbers(), tables_from(node["values"]), tables_from(node["poses"])};
}

void write(Writer& to, const Minimum& minimum) {
  to.object([&] {
    to.member("objective", minimum.objective);
    to.key("starts");
    to.list_of(minimum.starts, [&](int start) { to.number(start); });
    to.key("dofs");
    to.list_of(
        minimum.dofs, [&](const Trajectory& dof) { write(to, dof); }, Set::in_lines);
  });
}

Minimum minimum_from(const Node& node) {
  node.object({"objective", "starts", "dofs"});
  return {node["objective"].number(), node["starts"].each([](const Node& start) { return start.integer(); }),
          node["dofs"].each(trajectory_from)};
}

Status status_from(const Node& node) {
  std::array<std::string_view, statuses.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = name_of(statuses[i]);
  return statuses[node.choice(names)];
}

}  // namespace

void write(Writer& to, const IterationRecord& record, bool failed) {
  const Measures measures{to, failed};
  to.object([&] {
    to.member("iteration", record.iteration);
    measures.member("objective", record.objective);
    to.key("terms");
    to.object([&] {
      for (const auto& [name, value] : record.terms) measures.member(name, value);
    });
    measures.member("violation", record.violation);
    measures.member("stationarity", record.stationarity);
    to.member("step", record.step);
    to.member("shift", record.shift);
    to.member("seconds", record.seconds);
  });
}

IterationRecord record_from(const Node& node) {
  node.object({"iteration", "objective", "terms", "violation", "stationarity", "step", "shift", "seconds"});
  return {.iteration = node["iteration"].integer(),
          .objective = measure_from(node["objective"]),
          .terms = named(node["terms"], measure_from),
          .violation = measure_from(node["violation"]),
          .stationarity = measure_from(node["stationarity"]),
          .step = node["step"].number(),
          .shift = node["shift"].number(),
          .seconds = node["seconds"].number()};
}

void write(Writer& to, const Motion& motion) {
  const Measures measures{to, motion.status == Status::failed};
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
          measures.member("total", motion.objective);
          to.key("terms");
          to.object([&] {
            for (const auto& [name, value] : motion.terms) measures.member(name, value);
          });
        });
        to.key("violation");
        to.object([&] {
          measures.member("max", motion.violation);
          to.key("constraints");
          to.list_of(
              motion.violations, [&](const Violation& violation) { write(measures, violation); }, Set::in_lines);
        });
        to.key("dofs");
        to.list_of(
            motion.dofs, [&](const Trajectory& dof) { write(to, dof); }, Set::in_lines);
        member(to, "constants", motion.constants);
        member(to, "parameters", motion.parameters);
        if (!motion.multipliers.empty()) {
          to.key("multipliers");
          to.list_of(
              motion.multipliers, [&](const Multipliers& multipliers) { write(to, multipliers); }, Set::in_lines);
        }
        if (motion.samples) {
          to.key("samples");
          write(measures, *motion.samples);
        }
        if (!motion.record.empty()) {
          to.key("record");
          to.list_of(
              motion.record, [&](const IterationRecord& record) { write(to, record, measures.failed); }, Set::in_lines);
        }
        if (!motion.minima.empty()) {
          to.key("minima");
          to.list_of(
              motion.minima, [&](const Minimum& minimum) { write(to, minimum); }, Set::in_lines);
        }
        if (!motion.bodies.empty()) {
          to.key("bodies");
          to.list_of(
              motion.bodies, [&](const Body& body) { write(to, body); }, Set::in_lines);
          write_programs(to, motion.programs);
        }
        if (motion.checkpoint) {
          to.key("checkpoint");
          write_checkpoint(to, motion);
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
  static constexpr std::array formats{first_motion_format, motion_format};
  const bool stamped = formats[static_cast<std::size_t>(node["format"].choice(formats))] == motion_format;
  node.object({"format", "time", "status", "message", "iterations", "seconds", "objective", "violation", "dofs",
               "constants", "parameters"},
              {"multipliers", "samples", "record", "minima", "bodies", "programs", "checkpoint"});
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
  motion.objective = measure_from(objective["total"]);
  motion.terms = named(objective["terms"], measure_from);
  const auto violation = node["violation"];
  violation.object({"max", "constraints"});
  motion.violation = measure_from(violation["max"]);
  motion.violations = violation["constraints"].each(violation_from);
  motion.dofs = node["dofs"].each(trajectory_from);
  motion.constants = named_numbers(node["constants"]);
  motion.parameters = named_numbers(node["parameters"]);
  if (const auto multipliers = node.find("multipliers")) motion.multipliers = multipliers->each(multipliers_from);
  if (const auto samples = node.find("samples")) motion.samples = samples_from(*samples);
  if (const auto record = node.find("record")) motion.record = record->each(record_from);
  if (const auto minima = node.find("minima")) motion.minima = minima->each(minimum_from);
  if (const auto bodies = node.find("bodies")) {
    motion.bodies = bodies->each(body_from);
    motion.programs = programs_from(node["programs"]);
  } else if (const auto programs = node.find("programs")) {
    node["bodies"];  // is missing
  }
  if (const auto checkpoint = node.find("checkpoint")) motion.checkpoint = checkpoint_from(*checkpoint, stamped);
  return motion;
}

Motion read_motion(std::string_view json) {
  const auto tree = parse(json, motion_document);
  auto motion = motion_from({tree, motion_document});
  if (auto fault = validate(motion)) throw DocumentError(motion_document, fault->path, fault->message);
  return motion;
}

}  // namespace spacetime
