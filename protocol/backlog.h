// How many bytes of answers a peer has not taken yet, and whether that is so much that nothing more should be made for
// it.  One thread adds and sleeps while it is full; another takes off and wakes it.
#pragma once

#include <atomic>
#include <cstddef>

namespace spacetime::protocol {

class Backlog {
 public:
  explicit Backlog(std::size_t most) : most_(most) {}

  bool full() const { return bytes_ > most_; }
  void add(std::size_t bytes) { bytes_ += bytes; }
  // Whether it was full until now, so that whoever sleeps must be woken.  Before and after are those of one step: had
  // the other thread added between two looks, both would find the same, and nobody would be woken.
  bool take_off(std::size_t bytes) {
    const std::size_t before = bytes_.fetch_sub(bytes);
    return before > most_ && before - bytes <= most_;
  }

 private:
  const std::size_t most_;
  std::atomic<std::size_t> bytes_ = 0;
};

}  // namespace spacetime::protocol
