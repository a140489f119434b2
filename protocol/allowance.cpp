#include "protocol/allowance.h"

#include <algorithm>

#include "common/assert.h"

namespace spacetime::protocol {

const Bound& bound_named(std::string_view name) {
  const auto found = std::ranges::find(bounds, name, &Bound::name);
  SPACETIME_ASSERT(found != bounds.end());
  return *found;
}

Error beyond(std::string_view name, const Allowance& allowance, double found) {
  const Bound& bound = bound_named(name);
  const double most = allowance.*bound.value;
  return {bound.code,
          amount(found) + " " + std::string(bound.help) + ", more than the limit of " + amount(most) +
              ": ask for less, or start the daemon with a higher --limit-" + std::string(name),
          limit_data(name, most)};
}

}  // namespace spacetime::protocol
