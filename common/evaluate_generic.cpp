#define SPACETIME_KERNELS generic_kernels
#define SPACETIME_TARGET "generic"
#define SPACETIME_VECTOR_BYTES 16
#include "common/evaluate_kernels.inl"
