#include "symbolic/link.h"

#include <array>
#include <map>

#include "symbolic/dof.h"
#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

using Kind = LinkItem::Kind;

struct Items {
  std::map<Kind, const LinkItem*> by_kind;
  bool damaged = false;
};

constexpr double default_thickness = 0.05;  // a rod's drawn radius, of its length: slender, yet easily seen
constexpr double default_ball = 0.05;       // m, the drawn radius of a point mass: about a ball in a hand

bool is_joint(Kind kind) { return kind == Kind::revolute || kind == Kind::prismatic || kind == Kind::fixed; }
bool is_shape(Kind kind) { return kind == Kind::capsule || kind == Kind::sphere || kind == Kind::box; }

// The items by kind, each once, one joint and one shape at most.
Items sort_items(Model& model, const LinkDeclaration& link) {
  Items out{{}, link.damaged};
  const LinkItem *joint = nullptr, *shape = nullptr;
  for (const LinkItem& item : link.items) {
    const LinkItem*& other = is_joint(item.kind) ? joint : is_shape(item.kind) ? shape : out.by_kind[item.kind];
    if (other) {
      const std::string what = is_joint(item.kind)   ? "a link has one joint"
                               : is_shape(item.kind) ? "a link has one shape"
                                                     : "this stands twice in the link";
      report(model, item.span, what + ": remove one of them", {{other->span, "the first is here"}});
      continue;
    }
    other = &item;
    out.by_kind[item.kind] = &item;
  }
  return out;
}

const LinkItem* find(const Items& items, Kind kind) {
  const auto it = items.by_kind.find(kind);
  return it == items.by_kind.end() ? nullptr : it->second;
}

const LinkItem* find_any(const Items& items, std::initializer_list<Kind> kinds) {
  for (const Kind kind : kinds)
    if (const LinkItem* item = find(items, kind)) return item;
  return nullptr;
}

// Reports what lacks something else, unless that may have been lost.
void report_lack(Model& model, const Items& items, const Span& span, std::string message) {
  if (!items.damaged) report(model, span, std::move(message));
}

// The argument of an item, zero where it is absent or wrong.
Expr number(Model& model, const Items& items, Kind kind, std::string_view what) {
  const LinkItem* item = find(items, kind);
  if (!item) return model.graph.number(0);
  return elaborate_still(model, *item->value, what).value_or(model.graph.number(0));
}

std::optional<Vector3> vector3(Model& model, const Items& items, Kind kind, std::string_view what) {
  const LinkItem* item = find(items, kind);
  if (!item) return std::nullopt;
  return elaborate_still_vector(model, *item->value, what)
      .value_or(Vector3{model.graph.number(0), model.graph.number(0), model.graph.number(1)});
}

void set_geometry(Model& model, const Items& items, Link& link) {
  const LinkItem* row = find_any(items, {Kind::a, Kind::alpha, Kind::d, Kind::theta});
  const LinkItem* placed = find_any(items, {Kind::axis, Kind::origin});
  if (row && placed)
    report(model, placed->span, "a joint is placed by 'a alpha d theta' or by 'axis' and 'origin', not by both",
           {{row->span, "the other is here"}});
  link.offset = number(model, items, Kind::offset, "a joint's offset");
  link.a = number(model, items, Kind::a, "a length");
  link.alpha = number(model, items, Kind::alpha, "an angle");
  link.d = number(model, items, Kind::d, "a length");
  link.theta = number(model, items, Kind::theta, "an angle");
  const LinkItem* offset = find(items, Kind::offset);
  if (offset && link.joint == Link::Joint::fixed)
    report(model, offset->span, "a fixed joint has no offset: use 'theta' or 'd'");
  if (!placed) return;
  const LinkItem* axis = find(items, Kind::axis);
  if (link.joint == Link::Joint::fixed && axis)
    report(model, axis->span, "a fixed joint has no axis: leave it out, or use 'theta' and 'alpha' to turn the link");
  if (link.joint != Link::Joint::fixed && !axis)
    report_lack(model, items, placed->span, "a joint with an 'origin' needs an 'axis' too");
  Graph& graph = model.graph;
  link.axis =
      vector3(model, items, Kind::axis, "an axis").value_or(Vector3{graph.number(0), graph.number(0), graph.number(1)});
  link.origin = vector3(model, items, Kind::origin, "an origin").value_or(Vector3{});
  const auto zero = [&](Expr e) { return model.facts.known(e) == 0.0; };
  if (zero((*link.axis)[0]) && zero((*link.axis)[1]) && zero((*link.axis)[2]))
    report(model, axis ? axis->span : placed->span, "an axis must not be (0, 0, 0)");
}

// A uniform thin rod from the frame's origin to p: its middle, and m/12 (|p|^2 I - p p^T).
void set_rod(Model& model, const Items& items, Link& link, const LinkItem& rod, const Vector3& p) {
  Graph& graph = model.graph;
  if (!find(items, Kind::mass)) return report_lack(model, items, rod.span, "a rod needs a 'mass'");
  if (const LinkItem* other = find_any(items, {Kind::com, Kind::inertia}))
    return report(model, other->span, "a rod has its own centre of mass and inertia: remove these, or the 'rod'",
                  {{rod.span, "the rod is here"}});
  if (!rod.value && model.facts.known(link.a) == 0.0)
    return report_lack(model, items, rod.span, "a rod needs a length: give the link an 'a', or write rod (x, y, z)");
  const Expr twelfth = graph.divide(link.mass, graph.number(12));
  const auto squared = [&](std::size_t i) { return graph.multiply(p[i], p[i]); };
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    link.com[i] = graph.divide(p[i], graph.number(2));
    link.inertia[i] = graph.multiply(twelfth, graph.add(squared(j), squared(k)));
  }
  const auto product = [&](std::size_t i, std::size_t j) {
    return graph.negate(graph.multiply(twelfth, graph.multiply(p[i], p[j])));
  };
  link.inertia[3] = product(0, 1), link.inertia[4] = product(0, 2), link.inertia[5] = product(1, 2);
}

void set_inertia(Model& model, const Items& items, Link& link) {
  const LinkItem* item = find(items, Kind::inertia);
  if (!item) return;
  const auto components = elaborate_numbers(model, *item->value, "an inertia");
  if (!components) return;
  if (components->size() != 3 && components->size() != 6)
    return report(model, model.scene.nodes[*item->value].span,
                  "an inertia has 3 components (ixx, iyy, izz), or 6 with (ixy, ixz, iyz)");
  for (std::size_t i = 0; i < components->size(); ++i) {
    if (!is_still(model, (*components)[i], model.scene.nodes[*item->value].span, "an inertia")) return;
    link.inertia[i] = (*components)[i];
    const auto known = model.facts.known(link.inertia[i]);
    if (i < 3 && known && *known < 0)
      return report(model, model.scene.nodes[*item->value].span, "a moment of inertia cannot be negative");
  }
}

// Where the rod ends that begins at the frame's origin.
Vector3 rod_end(Model& model, const Items& items, const Link& link) {
  const LinkItem* rod = find(items, Kind::rod);
  if (rod && rod->value) return vector3(model, items, Kind::rod, "a rod's end").value_or(Vector3{});
  return {model.graph.negate(link.a), model.graph.number(0), model.graph.number(0)};
}

void set_mass(Model& model, const Items& items, Link& link, const Vector3& end) {
  link.mass = number(model, items, Kind::mass, "a mass");
  if (const auto mass = model.facts.known(link.mass); mass && *mass < 0)
    report(model, find(items, Kind::mass)->span, "a mass cannot be negative");
  if (const LinkItem* rod = find(items, Kind::rod)) return set_rod(model, items, link, *rod, end);
  if (const LinkItem* com = find(items, Kind::com)) {
    if (!find(items, Kind::mass)) report_lack(model, items, com->span, "a centre of mass needs a 'mass'");
    link.com = vector3(model, items, Kind::com, "a centre of mass").value_or(Vector3{});
  }
  set_inertia(model, items, link);
}

// From the link's frame to that of its parent as the joint stands at zero, in the link's frame: -Rx(-alpha) (a, 0, d).
Vector3 near_end(Graph& graph, const Link& link) {
  if (link.axis) return {};
  return {graph.negate(link.a), graph.negate(graph.multiply(link.d, graph.sine(link.alpha))),
          graph.negate(graph.multiply(link.d, graph.cosine(link.alpha)))};
}

Drawing drawing_of(Model& model, const Items& items, const Link& link, const Vector3& rod_end) {
  Graph& graph = model.graph;
  Drawing out;
  const LinkItem* rod = find(items, Kind::rod);
  const Vector3 end = rod ? rod_end : near_end(graph, link);
  if (find(items, Kind::capsule)) {
    out = {Body::Shape::capsule, {number(model, items, Kind::capsule, "a radius"), end[0], end[1], end[2]}};
  } else if (find(items, Kind::sphere)) {
    out = {Body::Shape::sphere, {number(model, items, Kind::sphere, "a radius")}};
  } else if (const auto edges = vector3(model, items, Kind::box, "a box")) {
    out = {Body::Shape::box, {(*edges)[0], (*edges)[1], (*edges)[2]}};
  } else if (rod) {
    Expr squares = graph.number(0);
    for (const Expr e : end) squares = graph.add(squares, graph.multiply(e, e));
    const Expr radius = graph.multiply(graph.number(default_thickness), graph.square_root(squares));
    out = {Body::Shape::capsule, {radius, end[0], end[1], end[2]}};
  } else if (find(items, Kind::mass)) {
    out = {Body::Shape::sphere, {graph.number(default_ball)}};
  }
  // A drawing's sizes follow constants alone: parameters stand there with their start values.
  for (Expr& e : out.size) e = substitute(graph, e, model.parameter_starts);
  return out;
}

void set_joint(Model& model, Creature& creature, const LinkDeclaration& declaration, const Items& items, Link& link) {
  const LinkItem* joint = find_any(items, {Kind::revolute, Kind::prismatic, Kind::fixed});
  if (!joint) {
    report_lack(model, items, declaration.name.span,
                "link " + quoted(declaration.name.text) + " needs a joint: revolute, prismatic or fixed");
    creature.damaged = true;
    return;
  }
  if (joint->kind == Kind::fixed) return;
  if (joint->dof.text.empty()) return;  // reported by the parser
  link.joint = joint->kind == Kind::revolute ? Link::Joint::revolute : Link::Joint::prismatic;
  declare_member(model, creature, joint->dof);
  Joint out;
  out.name = joint->dof.text;
  out.link = static_cast<int>(creature.linkage.links.size());
  out.dof = add_dof(model, {creature.name + "." + out.name, joint->dof.span}, joint->value, joint->bounds);
  out.coordinate = coordinate_of(model, creature.name + "." + out.name);
  link.coordinate = out.coordinate;
  creature.joints.push_back(out);
}

}  // namespace

void add_link(Model& model, Creature& creature, const LinkDeclaration& declaration) {
  declare_member(model, creature, declaration.name);
  const Items items = sort_items(model, declaration);
  Link link;
  link.parent = static_cast<int>(creature.links.size()) - 1;
  if (declaration.parent) {
    const auto parent = find_link(model, creature, *declaration.parent);
    link.parent = parent.value_or(-1);
  }
  set_joint(model, creature, declaration, items, link);
  set_geometry(model, items, link);
  const Vector3 end = rod_end(model, items, link);
  set_mass(model, items, link, end);
  creature.drawings.push_back(drawing_of(model, items, link, end));
  creature.linkage.links.push_back(link);
  creature.links.push_back(declaration.name.text);
}

}  // namespace spacetime::symbolic
