// A motion: what a run leaves.  Written as a document by protocol/motion_json.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/checkpoint.h"
#include "common/problem.h"
#include "common/trajectory.h"

namespace spacetime {

enum class Status { converged, stopped, infeasible, failed };
std::string_view name_of(Status status);

struct Seconds {
  double total = 0;     // from the loaded problem to the motion; files and process start left out
  double evaluate = 0;  // running programs and assembling
  double factor = 0;    // factorising and solving
  bool operator==(const Seconds&) const = default;
};

// What a constraint costs: the objective falls by so much for each unit by which the relation's right side is raised.
struct Multiplier {
  double value = 0;            // of the instance where it is largest
  std::optional<double> time;  // of that instance; absent for a constraint without time
  bool operator==(const Multiplier&) const = default;
};

struct Violation {
  std::string name;            // of the constraint
  double max = 0;              // in the relation's own units
  std::optional<double> time;  // where the largest is; absent for a constraint without time
  int line = 0;
  std::optional<Multiplier> multiplier{};  // where the method knows it and constraints can be kept
  bool operator==(const Violation&) const = default;
};

// What each instance of a constraint costs, component by component, or each coefficient of a bounded degree of freedom.
struct Multipliers {
  std::string name;
  int line = 0;
  std::vector<double> times;                // s, of the instances; none of a constraint without time, which has one
  std::vector<std::vector<double>> values;  // one row an instance, one column a component
  bool operator==(const Multipliers&) const = default;
};

// Sampled expressions and body poses, on request.
struct Samples {
  std::vector<double> times;
  std::map<std::string, std::vector<std::vector<double>>>
      values;  // by plot name: one row a time, one column a component
  std::map<std::string, std::vector<std::vector<double>>> poses;  // by body name: twelve columns
  bool operator==(const Samples&) const = default;
};

// One accepted step; the first record, of iteration 0, is the start.
struct IterationRecord {
  int iteration = 0;  // summed over all actions
  double objective = 0;
  std::vector<std::pair<std::string, double>> terms{};  // what it is the sum of, as the motion's
  double violation = 0;                                 // largest, in its own units
  double stationarity = 0;                              // of the Lagrangian, relative
  double step = 0;                                      // largest change of a coefficient
  double shift = 0;                                     // inertia correction
  double seconds = 0;                                   // since the problem was loaded
  bool operator==(const IterationRecord&) const = default;
};

// A minimum that some of many starts ended in.
struct Minimum {
  double objective = 0;
  std::vector<int> starts;  // which, from 0; the first of them is whose curves are kept
  std::vector<Trajectory> dofs;
  bool operator==(const Minimum&) const = default;
};

// Where the status is `failed`, measures may be no numbers: the objective, its terms, violations, samples, and a
// record's objective, terms, violation and stationarity.  All else is finite always.
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
  std::vector<std::pair<std::string, double>> parameters;
  std::vector<Multipliers> multipliers;  // on request, where they are known: in the order of the violations
  std::optional<Samples> samples;
  std::vector<IterationRecord> record;      // on request: all iterations
  std::vector<Minimum> minima;              // distinct ones, best first, where the last `solve` had many starts
  std::vector<Body> bodies;                 // the problem's, so that a motion can be drawn by itself ...
  std::map<std::string, Program> programs;  // ... and what gives their poses and sizes, by hash
  std::optional<Checkpoint> checkpoint;     // on request: where to go on, bit for bit
  bool operator==(const Motion&) const = default;
};

}  // namespace spacetime
