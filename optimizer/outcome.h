// What came of a run, in words and numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/motion.h"
#include "optimizer/newton.h"

namespace spacetime::optimizer {

struct Outcome {
  Status status = Status::stopped;
  std::string message;
};

// The largest violation of each hard constraint, in the scene's order, then of each bounded degree of freedom.
std::vector<Violation> violations(const Transcription& transcription, std::span<const double> x, const Values& values);

// "every hard constraint holds", or which is off most, where and by how much.
std::string worst_of(const std::vector<Violation>& all);

Outcome outcome_of(StepResult result, const Transcription& transcription, const Layout& layout,
                   const NewtonState& state, double tolerance);

// What a motion's message has at its end where that many steps needed a pivoted solve.
std::string remark_of(int pivoted);

// Fills the measures of a motion: objective, terms, violations.
void measure(const Transcription& transcription, std::span<const double> x, const Values& values, Motion& motion);

// Adds what each constraint and bound costs: its largest multiplier, by name and line.  Only where there are any that
// mean something: the state is Newton's own, and not infeasible or failed.
void add_multipliers(const Transcription& transcription, const Layout& layout, const NewtonState& state,
                     Motion& motion);

}  // namespace spacetime::optimizer
