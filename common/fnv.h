// A number that tells contents apart.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace spacetime {

// FNV-1a with 128 bits (Fowler, Noll, Vo; http://www.isthe.com/chongo/tech/comp/fnv).
class Fnv1a {
 public:
  void byte(std::uint8_t value) { state_ = (state_ ^ value) * prime; }
  void number(std::uint64_t value, int bytes = 8) {
    for (int i = 0; i < bytes; ++i) byte(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void index(std::int32_t value) { number(static_cast<std::uint32_t>(value), 4); }
  void text(std::string_view value) {
    number(value.size());
    for (const char character : value) byte(static_cast<std::uint8_t>(character));
  }
  std::string digits() const {
    std::string result(32, '0');
    for (int i = 0; i < 32; ++i) result[i] = "0123456789abcdef"[static_cast<int>(state_ >> (124 - 4 * i)) & 15];
    return result;
  }

 private:
  __extension__ typedef unsigned __int128 Word;
  static constexpr Word prime = (Word{1} << 88) | 0x13B;
  Word state_ = (Word{0x6c62272e07bb0142} << 64) | 0x62b821756295c58d;
};

}  // namespace spacetime
