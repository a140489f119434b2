// Scripted bodies: checked as far as their text goes.
#include <algorithm>

#include "symbolic/expression.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

constexpr std::size_t least_control_points = 4;  // of a cubic

const Node& node_of(const Model& model, NodeId id) { return model.scene.nodes[id]; }

// Every entry of a list is a tuple of so many numbers, parameters among them where they may be.  The first component of
// each, where it is a time, must rise.
struct Entries {
  std::size_t components = 3;
  bool parameters = false;
  bool timed = false;
};

bool check_entry(Model& model, NodeId id, std::string_view what, const Entries& kind, std::optional<double>& before) {
  const auto components = elaborate_numbers(model, id, what);
  const Span& span = node_of(model, id).span;
  if (!components) return false;
  if (components->size() != kind.components) {
    report(model, span,
           std::string(what) + " has " + std::to_string(kind.components) + " components, but here are " +
               std::to_string(components->size()));
    return false;
  }
  for (const Expr e : *components) {
    if (!is_still(model, e, span, what)) return false;
    if (!kind.parameters && model.facts.has_parameter(e)) {
      report(model, span,
             std::string(what) + " must be made of numbers and constants, but this depends on a parameter");
      return false;
    }
  }
  const auto time = model.facts.known((*components)[0]);
  if (!kind.timed || !time) return true;
  if (before && *time <= *before) return report(model, span, "times must rise from key to key"), false;
  before = time;
  return true;
}

bool check_list(Model& model, NodeId list, std::string_view what, const Entries& kind, std::size_t least) {
  const Node& node = node_of(model, list);
  std::optional<double> before;
  for (const NodeId id : node.operands)
    if (!check_entry(model, id, what, kind, before)) return false;
  if (node.operands.size() >= least) return true;
  report(model, node.span,
         "here must be at least " + std::to_string(least) + " of them, but there are " +
             std::to_string(node.operands.size()));
  return false;
}

bool check_knots(Model& model, const std::optional<NodeId>& list, std::size_t points) {
  if (!list) return true;
  const Node& node = node_of(model, *list);
  std::optional<double> before;
  for (const NodeId id : node.operands) {
    const auto knot = elaborate_fixed(model, id, "a knot");
    if (!knot) return false;
    if (before && knot->value <= *before)
      return report(model, node_of(model, id).span, "knots must rise from one to the next"), false;
    before = knot->value;
  }
  // A clamped cubic with n points has n - 3 spans between distinct knots.
  const std::size_t expected = points - least_control_points + 2;
  if (node.operands.size() == expected) return true;
  report(model, node.span,
         std::to_string(points) + " control points of a cubic need " + std::to_string(expected) +
             " knots, the ends among them, but here are " + std::to_string(node.operands.size()));
  return false;
}

bool check(Model& model, const PathItem& path) {
  if (!check_list(model, path.points, "a path's point", {3, false, false}, path.through ? 2 : least_control_points))
    return false;
  if (path.through && path.knots)
    return report(model, node_of(model, *path.knots).span,
                  "a path through points finds its knots by itself: leave them out"),
           false;
  return check_knots(model, path.knots, node_of(model, path.points).operands.size());
}

bool check(Model& model, const TravelItem& travel) {
  using Kind = TravelItem::Kind;
  if (travel.kind == Kind::constant) return true;
  const bool control = travel.kind == Kind::control;
  if (!check_list(model, *travel.points, "a travel key (time, distance)", {2, true, true},
                  control ? least_control_points : 2))
    return false;
  if (travel.speed && control)
    return report(model, node_of(model, *travel.speed).span, "'speed' goes with keys, not with control points"), false;
  if (travel.knots && !control)
    return report(model, node_of(model, *travel.knots).span, "'knots' go with 'travel control', not with keys"), false;
  std::optional<double> none;
  if (travel.speed && !check_entry(model, *travel.speed, "a speed (first, last)", {2, true, false}, none)) return false;
  return !control || check_knots(model, travel.knots, node_of(model, *travel.points).operands.size());
}

// (t, (w, x, y, z)) is flattened to five numbers.
bool check(Model& model, const OrientItem& orient) {
  std::optional<double> none;
  if (orient.up) return check_entry(model, *orient.up, "a direction", {3, false, false}, none);
  return check_list(model, *orient.keys, "an orientation (time, (w, x, y, z))", {5, false, true}, 1);
}

}  // namespace

void elaborate_script(Model& model, const ScriptDeclaration& declaration, const Span& span) {
  const std::size_t mistakes = model.diagnostics.size();
  int items[3] = {0, 0, 0};
  for (const auto& item : declaration.items) {
    ++items[item.index()];
    std::visit([&](const auto& own) { check(model, own); }, item);
  }
  const auto complain = [&](std::string message) {
    if (model.diagnostics.size() == mistakes && !declaration.damaged)
      report(model, declaration.name.span, std::move(message));
  };
  if (items[0] != 1) complain("a scripted body has one 'path', but here are " + std::to_string(items[0]));
  if (items[1] > 1 || items[2] > 1) complain("a scripted body has one 'travel' and one 'orient' at most");
  if (model.diagnostics.size() == mistakes && !declaration.damaged)
    report(model, span, "scripted bodies are not built yet: write the motion as expressions of t");
  declare(model, declaration.name, {});
}

}  // namespace spacetime::symbolic
