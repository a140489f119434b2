// Making a batch from a program and its times: what its inputs are and where its derivatives go.
#pragma once

#include <string>

#include "optimizer/transcription.h"

namespace spacetime::optimizer {

int index_of(const Problem& problem, const std::string& dof);

// A functional's or a parameter's place among the unknowns of the border; -1 for other inputs.
int border_index_of(const Problem& problem, const Input& input);

// Slots, tables, derivative entries and chunks of a batch whose program and times are there.
void complete(const Problem& problem, Batch& batch);

}  // namespace spacetime::optimizer
