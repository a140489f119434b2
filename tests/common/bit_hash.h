// The bits of many numbers as one, to hold a machine to what others gave.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "common/evaluate.h"

namespace spacetime {

// FNV-1a over the numbers' bytes, least significant first; all NaNs count as one, since their bits are no promise.
class BitHash {
 public:
  void add(std::span<const double> numbers) {
    for (const double x : numbers) {
      const auto bits = std::bit_cast<std::uint64_t>(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x);
      for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ ((bits >> shift) & 0xff)) * 0x100000001b3;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

// The targets that this machine can run and that promise one another's bits.
inline std::vector<std::string_view> vector_targets() {
  auto targets = evaluation_targets();
  std::erase(targets, "generic");
  return targets;
}

}  // namespace spacetime
