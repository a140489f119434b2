// A motion: what a run leaves.  Written as a document by protocol/motion_json.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace spacetime {

enum class Status { converged, stopped, infeasible, failed };
std::string_view name_of(Status status);

struct Seconds {
  double total = 0;     // from the loaded problem to the motion; files and process start left out
  double evaluate = 0;  // running programs and assembling
  double factor = 0;    // factorising and solving
  bool operator==(const Seconds&) const = default;
};

struct Violation {
  std::string name;            // of the constraint
  double max = 0;              // in the relation's own units
  std::optional<double> time;  // where the largest is; absent for a constraint without time
  int line = 0;
  bool operator==(const Violation&) const = default;
};

struct Trajectory {
  std::string name;  // of the degree of freedom
  Basis basis;
  std::vector<double> coefficients;
  bool operator==(const Trajectory&) const = default;
};

// Sampled expressions and body poses, on request.
struct Samples {
  std::vector<double> times;
  std::map<std::string, std::vector<std::vector<double>>>
      values;  // by plot name: one row a time, one column a component
  std::map<std::string, std::vector<std::vector<double>>> poses;  // by body name: twelve columns
  bool operator==(const Samples&) const = default;
};

struct Motion {
  double start = 0, end = 1;
  Status status = Status::stopped;
  std::string message;
  int iterations = 0;
  Seconds seconds;
  double objective = 0;                               // weighted, as minimised
  std::vector<std::pair<std::string, double>> terms;  // weighted; soft constraints by their names among them
  double violation = 0;
  std::vector<Violation> violations;  // hard constraints, in the scene's order
  std::vector<Trajectory> dofs;
  std::vector<std::pair<std::string, double>> constants;
  std::optional<Samples> samples;
  bool operator==(const Motion&) const = default;
};

}  // namespace spacetime
