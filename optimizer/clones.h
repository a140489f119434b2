// Inner loops are compiled for wider vectors too.  Such a function may only multiply, add and store element by element:
// contraction is off, so that every clone gives the same bits.  Clones are chosen by the loader, which the sanitizers'
// run-time libraries do not survive.
#pragma once

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SPACETIME_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SPACETIME_CLONES
#endif
