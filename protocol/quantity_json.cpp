#include "protocol/quantity_json.h"

#include <array>

#include "protocol/limits.h"

namespace spacetime {
namespace {

constexpr std::array<std::string_view, 6> scope_kinds{"once", "times", "every", "count", "knots", "whole"};

}  // namespace

void write(Writer& to, const Quantity& quantity) {
  if (quantity.program.empty()) {
    to.number(quantity.number);
    return;
  }
  to.object([&] {
    to.member("program", quantity.program);
    to.member("output", quantity.output);
  });
}

Quantity quantity_from(const Node& node) {
  if (node.is_number()) return {node.number(), {}, 0};
  if (!node.is_object()) node.expected("a number, or an object with program and output");
  node.object({"program", "output"});
  Quantity quantity{0, node["program"].string(), node["output"].integer()};
  if (quantity.program.empty()) node["program"].expected("the name of a program");
  return quantity;
}

std::optional<Quantity> optional_quantity(const Node& node, std::string_view name) {
  const auto found = node.find(name);
  return found ? std::optional(quantity_from(*found)) : std::nullopt;
}

void member(Writer& to, std::string_view name, const Quantity& quantity) {
  to.key(name);
  write(to, quantity);
}

void member(Writer& to, std::string_view name, const std::optional<Quantity>& quantity) {
  if (quantity) member(to, name, *quantity);
}

void member(Writer& to, std::string_view name, const std::vector<Quantity>& quantities) {
  to.key(name);
  to.list_of(quantities, [&](const Quantity& quantity) { write(to, quantity); });
}

void write(Writer& to, const Scope& scope) {
  using Kind = Scope::Kind;
  to.object([&] {
    to.choice("kind", scope_kinds, scope.kind);
    if (scope.kind == Kind::times) member(to, "times", scope.times);
    if (scope.kind == Kind::once || scope.kind == Kind::times || scope.kind == Kind::whole) return;
    member(to, "from", scope.from);
    member(to, "to", scope.to);
    if (scope.kind == Kind::every) member(to, "step", scope.step);
    if (scope.kind == Kind::count) to.member("count", scope.count);
  });
}

Scope scope_from(const Node& node) {
  Scope scope;
  scope.kind = static_cast<Scope::Kind>(node["kind"].choice(scope_kinds));
  switch (scope.kind) {
    case Scope::Kind::once:
    case Scope::Kind::whole:
      node.object({"kind"});
      return scope;
    case Scope::Kind::times:
      node.object({"kind", "times"});
      scope.times = node["times"].each(quantity_from);
      return scope;
    case Scope::Kind::every:
      node.object({"kind", "from", "to", "step"});
      scope.step = quantity_from(node["step"]);
      break;
    case Scope::Kind::count:
      node.object({"kind", "from", "to", "count"});
      scope.count = node["count"].integer(2, limits::instances);
      break;
    case Scope::Kind::knots:
      node.object({"kind", "from", "to"});
      break;
  }
  scope.from = quantity_from(node["from"]);
  scope.to = quantity_from(node["to"]);
  return scope;
}

void write_place(Writer& to, const Place& place) {
  if (place.line != 0) to.member("line", place.line);
  if (place.column != 0) to.member("column", place.column);
}

Place place_from(const Node& node) {
  Place place;
  if (const auto line = node.find("line")) place.line = line->integer(1);
  if (const auto column = node.find("column")) place.column = column->integer(1);
  return place;
}

}  // namespace spacetime
