#include "protocol/action_json.h"

#include <array>
#include <utility>
#include <variant>

#include "protocol/limits.h"
#include "protocol/quantity_json.h"

namespace spacetime {
namespace {

constexpr std::array<std::string_view, 3> methods{"newton", "sqp92", "bfgs"};

void write_interval(Writer& to, const std::optional<Interval>& interval) {
  if (!interval) return;
  member(to, "from", interval->from);
  member(to, "to", interval->to);
}

std::optional<Interval> interval_from(const Node& node) {
  if (!node.find("from") && !node.find("to")) return std::nullopt;
  return Interval{quantity_from(node["from"]), quantity_from(node["to"])};
}

void write_dofs(Writer& to, const DofNames& dofs) {
  if (dofs.empty()) return;
  to.key("dofs");
  to.list_of(dofs, [&](const std::string& name) { to.string(name); });
}

// An empty list would mean all; whoever has selected none must not get them.
DofNames dofs_from(const Node& node) {
  const auto dofs = node.find("dofs");
  if (!dofs) return {};
  if (dofs->list() == 0) dofs->expected("at least one name");
  return dofs->each([](const Node& name) { return name.string(); });
}

// The members of each action but "action", "line" and "column"; one pair of functions an action.

void write_members(Writer& to, const Solve& solve) {
  const Solve usual;
  if (solve.iterations) to.member("iterations", *solve.iterations);
  if (solve.tolerance != usual.tolerance) to.member("tolerance", solve.tolerance);
  if (solve.method != usual.method) to.choice("method", methods, solve.method);
  if (solve.linear_cg) to.member("linear_cg", solve.linear_cg);
  if (solve.starts != usual.starts) to.member("starts", solve.starts);
}
void read_members(const Node& node, Solve& solve) {
  node.object({"action"}, {"iterations", "tolerance", "method", "linear_cg", "starts", "line", "column"});
  if (const auto iterations = node.find("iterations")) solve.iterations = iterations->integer();
  if (const auto tolerance = node.find("tolerance")) solve.tolerance = tolerance->number();
  if (const auto method = node.find("method")) solve.method = static_cast<Solve::Method>(method->choice(methods));
  if (const auto linear = node.find("linear_cg")) solve.linear_cg = linear->boolean();
  if (const auto starts = node.find("starts")) solve.starts = starts->integer(1, limits::starts);
}

void write_members(Writer& to, const Iterate& iterate) { to.member("iterations", iterate.iterations); }
void read_members(const Node& node, Iterate& iterate) {
  node.object({"action", "iterations"}, {"line", "column"});
  iterate.iterations = node["iterations"].integer();
}

void write_members(Writer& to, const Window& window) {
  write_interval(to, window.interval);
  write_dofs(to, window.dofs);
}
void read_members(const Node& node, Window& window) {
  node.object({"action"}, {"from", "to", "dofs", "line", "column"});
  window = {interval_from(node), dofs_from(node)};
}

void write_members(Writer& to, const Refine& refine) {
  write_interval(to, refine.interval);
  write_dofs(to, refine.dofs);
  if (refine.times != 1) to.member("times", refine.times);
  member(to, "tolerance", refine.automatic);
}
void read_members(const Node& node, Refine& refine) {
  node.object({"action"}, {"from", "to", "dofs", "times", "tolerance", "line", "column"});
  refine.interval = interval_from(node);
  refine.dofs = dofs_from(node);
  if (const auto times = node.find("times")) refine.times = times->integer(1, limits::halvings);
  refine.automatic = optional_quantity(node, "tolerance");
}

void write_members(Writer& to, const Shake& shake) {
  member(to, "amplitude", shake.amplitude);
  if (shake.seed) to.member("seed", *shake.seed);
  write_dofs(to, shake.dofs);
}
void read_members(const Node& node, Shake& shake) {
  node.object({"action", "amplitude"}, {"seed", "dofs", "line", "column"});
  shake.amplitude = quantity_from(node["amplitude"]);
  if (const auto seed = node.find("seed")) shake.seed = seed->integer();
  shake.dofs = dofs_from(node);
}

void write_members(Writer& to, const Smooth& smooth) {
  member(to, "strength", smooth.strength);
  write_dofs(to, smooth.dofs);
}
void read_members(const Node& node, Smooth& smooth) {
  node.object({"action", "strength"}, {"dofs", "line", "column"});
  smooth = {quantity_from(node["strength"]), dofs_from(node)};
}

void write_members(Writer& to, const Damp& damp) {
  member(to, "limit", damp.limit);
  write_dofs(to, damp.dofs);
}
void read_members(const Node& node, Damp& damp) {
  node.object({"action", "limit"}, {"dofs", "line", "column"});
  damp = {quantity_from(node["limit"]), dofs_from(node)};
}

void write_members(Writer& to, const Adapt& adapt) {
  member(to, "tolerance", adapt.tolerance);
  if (adapt.levels) to.member("levels", *adapt.levels);
}
void read_members(const Node& node, Adapt& adapt) {
  node.object({"action", "tolerance"}, {"levels", "line", "column"});
  adapt.tolerance = quantity_from(node["tolerance"]);
  if (const auto levels = node.find("levels")) adapt.levels = levels->integer();
}

void write_members(Writer& to, const Lock& lock) { to.member("level", lock.level); }
void read_members(const Node& node, Lock& lock) {
  node.object({"action", "level"}, {"line", "column"});
  lock.level = node["level"].integer();
}

void write_members(Writer& to, const SetConstant& set) {
  to.member("constant", set.constant);
  member(to, "value", set.value);
}
void read_members(const Node& node, SetConstant& set) {
  node.object({"action", "constant", "value"}, {"line", "column"});
  set = {node["constant"].string(), quantity_from(node["value"])};
}

void write_members(Writer& to, const SetWeight& set) {
  to.member("name", set.name);
  member(to, "weight", set.weight);
}
void read_members(const Node& node, SetWeight& set) {
  node.object({"action", "name"}, {"weight", "line", "column"});
  set = {node["name"].string(), optional_quantity(node, "weight")};
}

void write_members(Writer& to, const Enable& enable) { to.member("name", enable.name); }
void write_members(Writer& to, const Disable& disable) { to.member("name", disable.name); }
void write_members(Writer& to, const Delete& remove) { to.member("name", remove.name); }
std::string name_from(const Node& node) {
  node.object({"action", "name"}, {"line", "column"});
  return node["name"].string();
}
void read_members(const Node& node, Enable& enable) { enable.name = name_from(node); }
void read_members(const Node& node, Disable& disable) { disable.name = name_from(node); }
void read_members(const Node& node, Delete& remove) { remove.name = name_from(node); }

void write_members(Writer& to, const Replace& replace) {
  to.member("name", replace.name);
  to.member("with", replace.with);
}
void read_members(const Node& node, Replace& replace) {
  node.object({"action", "name", "with"}, {"line", "column"});
  replace = {node["name"].string(), node["with"].integer()};
}

void write_members(Writer& to, const Rescope& rescope) {
  to.member("name", rescope.name);
  to.key("scope");
  write(to, rescope.scope);
}
void read_members(const Node& node, Rescope& rescope) {
  node.object({"action", "name", "scope"}, {"line", "column"});
  rescope = {node["name"].string(), scope_from(node["scope"])};
}

void write_members(Writer& to, const Bound& bound) {
  to.member("dof", bound.dof);
  member(to, "lower", bound.lower);
  member(to, "upper", bound.upper);
}
void read_members(const Node& node, Bound& bound) {
  node.object({"action", "dof", "lower", "upper"}, {"line", "column"});
  bound = {node["dof"].string(), quantity_from(node["lower"]), quantity_from(node["upper"])};
}

void write_members(Writer& to, const PullKeys& pull) {
  member(to, "time", pull.time);
  write_keys(to, pull.keys);
}
void read_members(const Node& node, PullKeys& pull) {
  node.object({"action", "time", "keys"}, {"line", "column"});
  pull = {quantity_from(node["time"]), keys_from(node)};
}

void write_members(Writer& to, const Control& control) {
  to.member("dof", control.dof);
  to.member("index", control.index);
  member(to, "value", control.value);
}
void read_members(const Node& node, Control& control) {
  node.object({"action", "dof", "index", "value"}, {"line", "column"});
  control = {node["dof"].string(), node["index"].integer(), quantity_from(node["value"])};
}

void write_members(Writer&, const Reset&) {}
void read_members(const Node& node, Reset&) { node.object({"action"}, {"line", "column"}); }

// The action of that place among Action's alternatives, with its defaults.
template <std::size_t... i>
Action alternative(int which, std::index_sequence<i...>) {
  static const Action all[] = {std::variant_alternative_t<i, Action>{}...};
  return all[which];
}

}  // namespace

void write_keys(Writer& to, const std::vector<Key>& keys) {
  to.key("keys");
  to.list_of(keys, [&](const Key& key) {
    to.object([&] {
      to.member("dof", key.dof);
      member(to, "value", key.value);
    });
  });
}

std::vector<Key> keys_from(const Node& node) {
  return node["keys"].each([](const Node& key) {
    key.object({"dof", "value"});
    return Key{key["dof"].string(), quantity_from(key["value"])};
  });
}

void write(Writer& to, const PlacedAction& action) {
  to.object([&] {
    to.member("action", name_of(action.action));
    std::visit([&](const auto& which) { write_members(to, which); }, action.action);
    write_place(to, action.place);
  });
}

PlacedAction action_from(const Node& node) {
  const int which = node["action"].choice(action_names());
  PlacedAction action{alternative(which, std::make_index_sequence<std::variant_size_v<Action>>()), {}};
  std::visit([&](auto& members) { read_members(node, members); }, action.action);
  action.place = place_from(node);
  return action;
}

}  // namespace spacetime
