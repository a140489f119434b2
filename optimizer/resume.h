// Between a method's state and what a checkpoint keeps of it: positions of the KKT matrix there, instances here.
#pragma once

#include <string_view>
#include <vector>

#include "common/checkpoint.h"
#include "optimizer/newton.h"
#include "optimizer/sqp92.h"

namespace spacetime::optimizer {

Checkpoint::Newton kept(const Transcription& transcription, const Layout& layout, const NewtonState& state);
Checkpoint::Sqp92 kept(const Layout& layout, const Sqp92State& state);

// The state at x that was kept; Newton::complete adds the rest.  Throws CheckpointError where sizes do not fit.
NewtonState brought_back(const Transcription& transcription, const Layout& layout, const Checkpoint::Newton& kept,
                         std::vector<double> x);

// Throws InputError where the method 'bfgs' has too many unknowns for a checkpoint.
void refuse_checkpoint(int unknowns_of_bfgs);

// Throws CheckpointError where what stands at that path of the motion's document has another size.
void require_size(std::string_view path, std::size_t found, std::size_t expected);

}  // namespace spacetime::optimizer
