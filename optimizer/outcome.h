// What came of a run, in words and numbers.
#pragma once

#include <span>
#include <string>
#include <utility>
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

// "every hard constraint holds", or which is off most, where and by how much, where that is more than the tolerance.
std::string worst_of(const std::vector<Violation>& all, double tolerance);

Outcome outcome_of(StepResult result, const Transcription& transcription, const Layout& layout,
                   const NewtonState& state, double tolerance);

// What a motion's message has at its end where that many steps needed a pivoted solve.
std::string remark_of(int pivoted);

// What the objective is the sum of: its terms, weighted, then soft constraints by their names.
std::vector<std::pair<std::string, double>> terms_of(const Transcription& transcription, const Values& values);
int count_of_terms(const Transcription& transcription);

// Fills the measures of a motion: objective, terms, violations.
void measure(const Transcription& transcription, std::span<const double> x, const Values& values, Motion& motion);

// What each instance of each hard constraint and each coefficient of each bounded degree of freedom costs; without
// those whose multiplier is no number.
std::vector<Multipliers> multipliers_of(const Transcription& transcription, const Layout& layout,
                                        const NewtonState& state);

// Adds the largest of each to the violations, by name and line.
void add_multipliers(const std::vector<Multipliers>& multipliers, Motion& motion);

}  // namespace spacetime::optimizer
