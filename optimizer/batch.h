// Making a batch from a program and its times: what its inputs are and where its derivatives go.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimizer/transcription.h"

namespace spacetime::optimizer {

int index_of(const Problem& problem, const std::string& dof);     // their number where there is none
int require_dof(const Problem& problem, const std::string& dof);  // InputError where there is none

// 1 for each degree of freedom that an action names, or for all where it names none.
std::vector<char> named_dofs(const Problem& problem, const DofNames& names);

// An action's interval, or the animation's.  Throws InputError where they do not meet; `what` it is for the message.
struct Span {
  double from = 0, to = 0;
};
Span span_of(const Problem& problem, const Constants& constants, const std::optional<Interval>& interval,
             const std::string& what);

// A functional's or a parameter's place among the unknowns of the border; -1 for other inputs.
int border_index_of(const Problem& problem, const Input& input);

// Slots, tables, derivative entries and chunks of a batch whose program and times are there.
void complete(const Problem& problem, Batch& batch);

}  // namespace spacetime::optimizer
