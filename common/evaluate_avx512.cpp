#define SPACETIME_KERNELS avx512_kernels
#define SPACETIME_TARGET "avx512"
#define SPACETIME_VECTOR_BYTES 64
#include "common/evaluate_kernels.inl"
