#include "symbolic/bodies.h"

#include <algorithm>
#include <cmath>

#include "common/assert.h"

namespace spacetime::symbolic {
namespace {

Vector3 unit(Graph& graph, int k) { return identity(graph)[k]; }

bool is_coordinate_axis(const Graph& graph, const Vector3& u) {
  return std::ranges::count(u, Expr{}) == 2 &&
         std::ranges::any_of(u, [&](Expr x) { return graph.is_number(x, 1) || graph.is_number(x, -1); });
}

// A link's way from its parent: to the joint, the joint, and on to the link's frame.
struct Way {
  Vector3 origin, axis;  // of the joint, in the parent link's axes
  Expr travel;           // without the coordinate
  Matrix3 rotation;      // after the joint
  Vector3 position;
};

Way way_of(Graph& graph, const Link& link) {
  if (link.axis) return {link.origin, normalised(graph, *link.axis), link.offset, identity(graph), {}};
  const auto x = unit(graph, 0), z = unit(graph, 2);
  const auto tilt = turn(graph, x, link.alpha);
  if (link.joint != Link::Joint::prismatic) {  // a fixed link is a revolute one at rest
    return {{}, z, graph.add(link.theta, link.offset), tilt, {link.a, {}, link.d}};
  }
  const auto yaw = turn(graph, z, link.theta);
  return {{}, z, graph.add(link.d, link.offset), multiply(graph, yaw, tilt), scale(graph, link.a, column(yaw, 0))};
}

void add_mass(Graph& graph, Body& body, Expr mass, const Vector3& at) {
  body.mass = graph.add(body.mass, mass);
  const auto moment = scale(graph, mass, at);
  body.moment = add(graph, body.moment, moment);
  body.second = add(graph, body.second, outer(graph, moment, at));
}

// The link's mass and inertia on its body.
void add_link(Graph& graph, Body& body, const Mount& mount, const Link& link) {
  add_mass(graph, body, link.mass, add(graph, mount.position, multiply(graph, mount.rotation, link.com)));
  const auto [xx, yy, zz, xy, xz, yz] = link.inertia;
  if (std::ranges::count(link.inertia, Expr{}) == 6) return;
  const auto half = [&](Expr plus, Expr also, Expr minus) {
    return graph.multiply(graph.number(0.5), graph.subtract(graph.add(plus, also), minus));
  };
  const auto minus = [&](Expr e) { return graph.negate(e); };
  const Matrix3 second{Vector3{half(yy, zz, xx), minus(xy), minus(xz)}, Vector3{minus(xy), half(xx, zz, yy), minus(yz)},
                       Vector3{minus(xz), minus(yz), half(xx, yy, zz)}};
  const auto turned = multiply(graph, multiply(graph, mount.rotation, second), transpose(mount.rotation));
  body.second = add(graph, body.second, turned);
}

// Hands to the parent what moves with it.
void hand_on(Graph& graph, Body& body, Body& parent) {
  if (!body.turns) {  // the same angular velocity: the second moment may belong to either
    parent.second = add(graph, parent.second, body.second);
    body.second = {};
    return;
  }
  // Whatever lies on the axis: its mass, and its first and second moment along the axis.
  const auto u = body.axis, axis = multiply(graph, body.fixed, u);
  if (!is_coordinate_axis(graph, u)) {
    add_mass(graph, parent, body.mass, body.joint);
    body.mass = {};
    return;
  }
  const Expr along = dot(graph, body.moment, u), second = dot(graph, u, multiply(graph, body.second, u));
  const auto dipole = scale(graph, along, axis);
  add_mass(graph, parent, body.mass, body.joint);
  parent.moment = add(graph, parent.moment, dipole);
  const auto mixed = outer(graph, body.joint, dipole);
  parent.second = add(graph, parent.second, add(graph, mixed, transpose(mixed)));
  parent.second = add(graph, parent.second, scale(graph, second, outer(graph, axis, axis)));
  body.mass = {};
  body.moment = subtract(graph, body.moment, scale(graph, along, u));
  body.second = subtract(graph, body.second, scale(graph, second, outer(graph, u, u)));
}

}  // namespace

Bodies bodies_of(Graph& graph, const Linkage& linkage) {
  Bodies result;
  auto& [bodies, mounts] = result;
  bodies.push_back({.fixed = identity(graph)});
  for (const auto& link : linkage.links) {
    SPACETIME_ASSERT(link.parent < static_cast<int>(mounts.size()));
    const auto on = link.parent < 0 ? Mount{0, identity(graph), {}} : mounts[link.parent];
    const auto way = way_of(graph, link);
    const auto joint = add(graph, on.position, multiply(graph, on.rotation, way.origin));
    if (link.joint == Link::Joint::fixed) {
      const auto turned = multiply(graph, on.rotation, turn(graph, way.axis, way.travel));
      mounts.push_back(
          {on.body, multiply(graph, turned, way.rotation), add(graph, joint, multiply(graph, turned, way.position))});
    } else {
      SPACETIME_ASSERT(link.coordinate.has_value());
      // A constant turn ahead of the joint is folded into the axis, unless that would tilt it off the axes.
      const auto axis = multiply(graph, on.rotation, way.axis);
      const bool folds = !is_coordinate_axis(graph, way.axis) || is_coordinate_axis(graph, axis) ||
                         link.joint == Link::Joint::prismatic;
      const auto after = folds ? on.rotation : identity(graph);
      bodies.push_back({.parent = on.body,
                        .turns = link.joint == Link::Joint::revolute,
                        .travel = graph.add(link.coordinate->q, way.travel),
                        .coordinate = *link.coordinate,
                        .fixed = folds ? identity(graph) : on.rotation,
                        .axis = folds ? axis : way.axis,
                        .joint = joint});
      mounts.push_back({static_cast<int>(bodies.size()) - 1, multiply(graph, after, way.rotation),
                        multiply(graph, after, way.position)});
    }
  }
  for (std::size_t i = 0; i < linkage.links.size(); ++i) {
    add_link(graph, bodies[mounts[i].body], mounts[i], linkage.links[i]);
  }
  for (std::size_t b = bodies.size(); b-- > 1;) hand_on(graph, bodies[b], bodies[bodies[b].parent]);
  return result;
}

}  // namespace spacetime::symbolic
