#include "tests/optimizer/failing_new.h"

#include <cstdlib>
#include <new>

namespace spacetime::test {
namespace {

thread_local long left = -1;  // -1: as many as are wanted

void* allocate(std::size_t size) noexcept {
  if (left == 0) return nullptr;
  if (left > 0) --left;
  return std::malloc(size);
}

}  // namespace

Allocations::Allocations(long most) { left = most; }
Allocations::~Allocations() { left = -1; }

}  // namespace spacetime::test

void* operator new(std::size_t size) {
  if (void* memory = spacetime::test::allocate(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return spacetime::test::allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
