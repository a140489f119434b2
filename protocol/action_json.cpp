#include "protocol/action_json.h"

#include <array>
#include <variant>

#include "protocol/place_json.h"

namespace spacetime {
namespace {

// In the order of Action's alternatives.
constexpr std::array<std::string_view, 2> names{"solve", "iterate"};
static_assert(names.size() == std::variant_size_v<Action>);

void write_members(Writer& to, const Solve& solve) {
  if (solve.iterations) to.member("iterations", *solve.iterations);
  to.member("tolerance", solve.tolerance);
}

void write_members(Writer& to, const Iterate& iterate) { to.member("iterations", iterate.iterations); }

}  // namespace

void write(Writer& to, const PlacedAction& action) {
  to.object([&] {
    to.member("action", names[action.action.index()]);
    std::visit([&](const auto& which) { write_members(to, which); }, action.action);
    write_place(to, action.place);
  });
}

PlacedAction action_from(const Node& node) {
  PlacedAction action;
  if (node["action"].choice(names) == 0) {
    node.object({"action"}, {"iterations", "tolerance", "line", "column"});
    Solve solve;
    if (const auto iterations = node.find("iterations")) solve.iterations = iterations->integer();
    if (const auto tolerance = node.find("tolerance")) solve.tolerance = tolerance->number();
    action.action = solve;
  } else {
    node.object({"action", "iterations"}, {"line", "column"});
    action.action = Iterate{node["iterations"].integer()};
  }
  action.place = place_from(node);
  return action;
}

}  // namespace spacetime
