// An operator new that can be made to fail.
#pragma once

namespace spacetime::test {

// As long as it lives, its thread has so many allocations; the next one throws std::bad_alloc.
class Allocations {
 public:
  explicit Allocations(long most);
  ~Allocations();
  Allocations(const Allocations&) = delete;
  Allocations& operator=(const Allocations&) = delete;
};

}  // namespace spacetime::test
