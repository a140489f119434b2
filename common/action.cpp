#include "common/action.h"

#include <array>

namespace spacetime {
namespace {

constexpr std::array<std::string_view, 20> names{
    "solve",  "iterate", "window",  "refine", "shake",   "filter", "damp",  "adapt", "lock",    "set",
    "weight", "enable",  "disable", "delete", "replace", "scope",  "bound", "key",   "control", "reset"};
static_assert(names.size() == std::variant_size_v<Action>);

}  // namespace

std::span<const std::string_view> action_names() { return names; }

std::string_view name_of(const Action& action) { return names[action.index()]; }

}  // namespace spacetime
