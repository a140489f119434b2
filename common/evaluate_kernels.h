// The interpreter's inner loops, compiled once for each target, and the instructions they run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/program.h"

namespace spacetime {

// One operation over a block of samples.  Operands are slots: arrays of as many numbers as the block has lanes.
struct Instruction {
  std::uint32_t code;                // an Op's number, or store_code
  std::uint32_t d, a, b = 0, c = 0;  // slots: the result, the operands.  A store writes slot a to the output row d
};
inline constexpr std::uint32_t store_code = op_count;

struct Block {
  double* slots;       // 64-byte aligned; slot s begins at s * lanes
  double* outputs;     // the first row's number for the block's first sample
  std::size_t stride;  // between output rows
  std::size_t valid;   // lanes that are samples; the others are copies of the last and are not stored
};

using RunBlock = void (*)(const Instruction* begin, const Instruction* end, const Block& block);

// Lanes of a block.  Wide ones make little of the interpreter's own work; narrow ones serve what is left over, and
// single points.
inline constexpr std::size_t wide = 64, narrow = 8;

struct Kernels {
  std::string_view target;
  bool fused;  // whether multiply_add is one instruction of the machine
  RunBlock run_wide, run_narrow;
};

Kernels generic_kernels();
Kernels avx2_kernels();    // AVX2 and FMA, that is x86-64-v3
Kernels avx512_kernels();  // and AVX-512 F, DQ and VL

}  // namespace spacetime
