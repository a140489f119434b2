#include "symbolic/mechanics.h"

#include <optional>

#include "symbolic/bodies.h"

namespace spacetime::symbolic {
namespace {

// How a body stands in the world.  Joints in a row that turn about parallel axes turn by the sum of their angles, and
// what lies between them is added up before it is turned into the world.
struct Stand {
  Frame base;                  // axes that stand still against the body's but for turning about `run`
  std::optional<Vector3> run;  // in the base's axes
  Expr angle;
  Matrix3 rotation;  // the base's axes from the body's
  Vector3 position;  // of the body's point, in the base
};

Stand stand_of(Graph& graph, const Body& body, const Stand& parent) {
  Stand stand = parent;
  const auto slide = body.turns ? Vector3{} : scale(graph, body.travel, body.axis);
  const auto arm = add(graph, body.joint, slide);
  stand.position = add(graph, parent.position, multiply(graph, parent.rotation, arm));
  if (!body.turns) return stand;
  const bool has_run = parent.run && body.fixed == identity(graph);
  const bool along = has_run && body.axis == *parent.run;
  const bool against = has_run && body.axis == scale(graph, graph.number(-1), *parent.run);
  if (along || against) {
    stand.angle = along ? graph.add(parent.angle, body.travel) : graph.subtract(parent.angle, body.travel);
  } else {
    stand.base.position = transform(graph, parent.base, stand.position);
    stand.base.rotation = multiply(graph, multiply(graph, parent.base.rotation, parent.rotation), body.fixed);
    stand.position = {};
    stand.run = body.axis;
    stand.angle = body.travel;
  }
  stand.rotation = turn(graph, *stand.run, stand.angle);
  return stand;
}

}  // namespace

std::vector<Frame> frames(Graph& graph, const Linkage& linkage) {
  const auto [bodies, mounts] = bodies_of(graph, linkage);
  std::vector<Stand> stands(bodies.size());
  stands[0].base.rotation = stands[0].rotation = identity(graph);
  for (std::size_t b = 1; b < bodies.size(); ++b) stands[b] = stand_of(graph, bodies[b], stands[bodies[b].parent]);
  std::vector<Frame> result;
  for (const auto& [body, rotation, position] : mounts) {
    const auto& stand = stands[body];
    const auto within = add(graph, stand.position, multiply(graph, stand.rotation, position));
    const auto turned = multiply(graph, stand.rotation, rotation);
    result.push_back({multiply(graph, stand.base.rotation, turned), transform(graph, stand.base, within)});
  }
  return result;
}

Vector3 transform(Graph& graph, const Frame& frame, const Vector3& point) {
  return add(graph, frame.position, multiply(graph, frame.rotation, point));
}

Vector3 centre_of_mass(Graph& graph, const Linkage& linkage, const std::vector<Frame>& frames) {
  Expr mass;
  Vector3 moment;
  for (std::size_t i = 0; i < linkage.links.size(); ++i) {
    const auto& link = linkage.links[i];
    mass = graph.add(mass, link.mass);
    moment = add(graph, moment, scale(graph, link.mass, transform(graph, frames[i], link.com)));
  }
  return {graph.divide(moment[0], mass), graph.divide(moment[1], mass), graph.divide(moment[2], mass)};
}

Expr potential_energy(Graph& graph, const Linkage& linkage, const std::vector<Frame>& frames) {
  Expr sum;
  for (std::size_t i = 0; i < linkage.links.size(); ++i) {
    const auto& link = linkage.links[i];
    const auto height = dot(graph, linkage.gravity, transform(graph, frames[i], link.com));
    sum = graph.subtract(sum, graph.multiply(link.mass, height));
  }
  return sum;
}

}  // namespace spacetime::symbolic
