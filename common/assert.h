// An assert that stays on in release builds: for broken invariants of our own, never for input from outside.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace spacetime {

[[noreturn]] inline void assertion_failed(const char* expression, const char* file, int line, const char* function) {
  std::fprintf(stderr, "%s:%d: %s: assertion failed: %s\n", file, line, function, expression);
  std::abort();
}

}  // namespace spacetime

// Prints the expression and its place on standard error and aborts where it is false.
#define SPACETIME_ASSERT(expression) \
  ((expression) ? static_cast<void>(0) : ::spacetime::assertion_failed(#expression, __FILE__, __LINE__, __func__))
