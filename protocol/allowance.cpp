#include "protocol/allowance.h"

#include <algorithm>
#include <charconv>

#include "common/assert.h"

namespace spacetime::protocol {
namespace {

std::string text_of(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

}  // namespace

const Bound& bound_named(std::string_view name) {
  const auto found = std::ranges::find(bounds, name, &Bound::name);
  SPACETIME_ASSERT(found != bounds.end());
  return *found;
}

Error beyond(std::string_view name, const Allowance& allowance, double found) {
  const Bound& bound = bound_named(name);
  const double most = allowance.*bound.value;
  return {bound.code,
          text_of(found) + " " + std::string(bound.help) + ", more than the limit of " + text_of(most) +
              ": ask for less, or start the daemon with a higher --limit-" + std::string(name),
          limit_data(name, most)};
}

}  // namespace spacetime::protocol
