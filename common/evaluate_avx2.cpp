#define SPACETIME_KERNELS avx2_kernels
#define SPACETIME_TARGET "avx2"
#define SPACETIME_VECTOR_BYTES 32
#include "common/evaluate_kernels.inl"
