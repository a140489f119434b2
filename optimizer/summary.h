// What people read on standard error: the question, a line an iteration, the answer.
#pragma once

#include <string>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"
#include "optimizer/run.h"

namespace spacetime::optimizer {

// What is asked: unknowns, objective terms, constraints.
std::string question(const Problem& problem);

// The live table: a heading, then one line an iteration; on a terminal a run of many iterations stays readable because
// each line is complete by itself.
std::string heading();
std::string line(const IterationRecord& progress);

// An expression to tell of in the summary: a plot's name and a time, in seconds or by a constant's name.
struct Show {
  std::string plot;
  std::string time;
};

// Parses "arm.hand@release".  Throws InputError where there is no @, or the problem has no such plot or constant.
Show parse_show(const Problem& problem, const std::string& text);

// How it went: status, iterations, objective by term, violations, what was to be shown, time by phase.
std::string summary(const Problem& problem, const Motion& motion, const std::vector<Show>& shows);

}  // namespace spacetime::optimizer
