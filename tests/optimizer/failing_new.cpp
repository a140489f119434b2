#include "tests/optimizer/failing_new.h"

#include <cstdlib>
#include <new>

namespace spacetime::test {
namespace {

thread_local long left = -1;  // -1: as many as are wanted

}  // namespace

Allocations::Allocations(long most) { left = most; }
Allocations::~Allocations() { left = -1; }

}  // namespace spacetime::test

void* operator new(std::size_t size) {
  using spacetime::test::left;
  if (left == 0) throw std::bad_alloc();
  if (left > 0) --left;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
