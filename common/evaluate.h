// The interpreter: runs a program over many samples at once, each operation over a block of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/program.h"

namespace spacetime {

// How much of a program to run.
enum class Depth { values, jacobian, hessian };

// The kernels this machine can run, best first, out of "avx512", "avx2", "generic".  The first two give the same bits;
// the last has the C library's transcendentals.
std::vector<std::string_view> evaluation_targets();

// The one in use: the best, or the one that the environment variable SPACETIME_TARGET names (read once; InputError
// where this machine cannot run it).
std::string_view evaluation_target();

// A program prepared for running: values mapped to reused slots, outputs listed.  Immutable; may be shared by threads.
class Evaluator {
 public:
  // The program must be valid.
  explicit Evaluator(const Program& program, std::string_view target = evaluation_target());
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;
  Evaluator& operator=(Evaluator&&) noexcept;

  // Runs the program at `samples` samples.
  //   inputs   one pointer an input, in the program's order; inputs[i] points at `samples` numbers, or at one number
  //            where uniform[i] is nonzero (constants, parameters, functionals)
  //   outputs  `outputs(depth)` rows of `stride` >= samples numbers: first the values, then, for Depth::jacobian, the
  //            Jacobian's entries, then, for Depth::hessian, the Hessian's, each in the program's order
  // A sample's bits depend on its own inputs alone: lanes never influence one another, and the last block is padded.
  // Thread-safe: scratch memory, blocks of samples times the most values alive at once, belongs to the thread.
  void run(Depth depth, std::size_t samples, std::span<const double* const> inputs,
           std::span<const std::uint8_t> uniform, double* outputs, std::size_t stride) const;

  std::size_t outputs(Depth depth) const;     // rows written
  std::size_t operations(Depth depth) const;  // operations run a sample

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

// Evaluates at a single point: `inputs` in the program's order.  Returns values, Jacobian entries, Hessian entries as
// `depth` asks, the bits of `run`.  Prepares the program anew, so it is for programs that are run once.
std::vector<double> evaluate_once(const Program& program, Depth depth, std::span<const double> inputs);

}  // namespace spacetime
