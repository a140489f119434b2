#include "protocol/check.h"

#include <algorithm>
#include <cmath>

#include "protocol/limits.h"
#include "protocol/path.h"

namespace spacetime {

std::optional<Fault> validate(const Basis& basis, double start, double end, std::string_view path) {
  const auto& knots = basis.knots;
  const auto list = below(path, "knots");
  const auto size = knots.size();
  if (size < 8) return Fault{list, "a clamped cubic has at least 8 knots, not " + std::to_string(size)};
  if (size > limits::spans + 7) {
    return Fault{list, std::to_string(size - 7) + " spans, more than the limit of " + std::to_string(limits::spans)};
  }
  for (std::size_t i = 0; i < size; ++i) {
    const auto fault = [&](const char* message) { return Fault{below(list, i), message}; };
    if (!std::isfinite(knots[i])) return fault("must be finite");
    if (i < 4 && knots[i] != start) return fault("the first four knots are the start of the time");
    if (i >= size - 4 && knots[i] != end) return fault("the last four knots are the end of the time");
    if (i >= 4 && i <= size - 4 && !(knots[i] > knots[i - 1])) return fault("knots between the ends must rise");
  }
  return std::nullopt;
}

std::optional<Fault> validate_name(std::string_view name, std::string_view path) {
  if (name.empty()) return Fault{std::string(path), "a name must not be empty"};
  if (name.size() > limits::name_bytes) {
    return Fault{std::string(path), "a name of " + std::to_string(name.size()) + " bytes, more than the limit of " +
                                        std::to_string(limits::name_bytes)};
  }
  const auto is_control = [](char character) {
    return static_cast<unsigned char>(character) < 0x20 || character == 0x7F;
  };
  if (std::any_of(name.begin(), name.end(), is_control)) {
    return Fault{std::string(path), "a name must not contain control characters"};
  }
  return std::nullopt;
}

}  // namespace spacetime
