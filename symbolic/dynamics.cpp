#include <vector>

#include "symbolic/bodies.h"
#include "symbolic/mechanics.h"

namespace spacetime::symbolic {
namespace {

// The motion of a body, in its own axes.
struct State {
  Matrix3 rotation;      // the parent's axes from these
  Vector3 arm;           // from the parent's point to this body's, in the parent's axes
  Vector3 omega, alpha;  // angular velocity and acceleration
  Matrix3 spread;        // U = [alpha]x + [omega]x^2, so that a point x of the body accelerates by a + U x
  Vector3 acceleration;  // of the body's point, less gravity
  Vector3 velocity;      // of the body's point
};

Matrix3 spread_of(Graph& graph, const Vector3& omega, const Vector3& alpha) {
  const auto p = outer(graph, omega, omega);
  Matrix3 u;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    u[k][k] = graph.negate(graph.add(p[i][i], p[j][j]));
    u[i][j] = graph.subtract(p[i][j], alpha[k]);
    u[j][i] = graph.add(p[i][j], alpha[k]);
  }
  return u;
}

// x turned from the body's axes into the parent's, and back.
Vector3 out_of(Graph& graph, const State& state, const Vector3& x) { return multiply(graph, state.rotation, x); }
Vector3 into(Graph& graph, const State& state, const Vector3& x) {
  return multiply(graph, transpose(state.rotation), x);
}

// One step outwards.  A joint that turns carries its point along with the parent, one that slides moves it.
State moved(Graph& graph, const Body& body, const State& parent) {
  const auto [q, v, a] = body.coordinate;
  const auto& u = body.axis;
  State state;
  state.rotation = multiply(graph, body.fixed, body.turns ? turn(graph, u, body.travel) : identity(graph));
  state.arm = body.turns ? body.joint : add(graph, body.joint, scale(graph, body.travel, u));
  auto acceleration = add(graph, parent.acceleration, multiply(graph, parent.spread, state.arm));
  auto velocity = add(graph, parent.velocity, cross(graph, parent.omega, state.arm));
  state.omega = into(graph, state, parent.omega);
  state.alpha = into(graph, state, parent.alpha);
  if (body.turns) {
    state.alpha =
        add(graph, state.alpha, add(graph, scale(graph, a, u), scale(graph, v, cross(graph, state.omega, u))));
    state.omega = add(graph, state.omega, scale(graph, v, u));
    state.spread = spread_of(graph, state.omega, state.alpha);
  } else {
    const auto coriolis = scale(graph, graph.multiply(graph.number(2), v), cross(graph, parent.omega, u));
    acceleration = add(graph, acceleration, add(graph, scale(graph, a, u), coriolis));
    velocity = add(graph, velocity, scale(graph, v, u));
    state.spread = parent.spread;
  }
  state.acceleration = into(graph, state, acceleration);
  state.velocity = into(graph, state, velocity);
  return state;
}

std::vector<State> motion(Graph& graph, const std::vector<Body>& bodies, const Vector3& gravity) {
  std::vector<State> states(bodies.size());
  states[0].acceleration = scale(graph, graph.number(-1), gravity);  // as if the ground fell upwards
  for (std::size_t b = 1; b < bodies.size(); ++b) states[b] = moved(graph, bodies[b], states[bodies[b].parent]);
  return states;
}

// The moment that turning takes about the body's point: sum_jk S_jk e_j x U e_k = alpha x' I + omega x I omega.
Vector3 spin(Graph& graph, const Matrix3& spread, const Matrix3& second) {
  const auto us = multiply(graph, spread, second);
  Vector3 result;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    result[k] = graph.subtract(us[j][i], us[i][j]);
  }
  return result;
}

}  // namespace

// Outwards the motion, inwards what each body needs, by itself and for its children:
//   f = m a + U h - F             + sum f_child
//   n = h x a + spin(U, S) - x x F + sum (n_child + arm x f_child)
// about each body's point, where m, h and S are its mass, first and second moment and F acts at x.
std::vector<Expr> generalised_forces(Graph& graph, const Linkage& linkage) {
  const auto [bodies, mounts] = bodies_of(graph, linkage);
  const auto states = motion(graph, bodies, linkage.gravity);
  std::vector<Vector3> force(bodies.size()), moment(bodies.size());
  for (const auto& [link, point, world_force] : linkage.forces) {
    const auto b = static_cast<std::size_t>(mounts[link].body);
    std::vector<std::size_t> chain;
    for (auto k = b; k > 0; k = static_cast<std::size_t>(bodies[k].parent)) chain.push_back(k);
    auto f = world_force;
    for (auto k = chain.rbegin(); k != chain.rend(); ++k) f = into(graph, states[*k], f);
    const auto at = add(graph, mounts[link].position, multiply(graph, mounts[link].rotation, point));
    force[b] = subtract(graph, force[b], f);
    moment[b] = subtract(graph, moment[b], cross(graph, at, f));
  }
  std::vector<Expr> result(bodies.size() - 1);
  for (std::size_t b = bodies.size(); b-- > 1;) {
    const auto& body = bodies[b];
    const auto& state = states[b];
    const auto inertial =
        add(graph, scale(graph, body.mass, state.acceleration), multiply(graph, state.spread, body.moment));
    force[b] = add(graph, force[b], inertial);
    moment[b] = add(graph, moment[b], cross(graph, body.moment, state.acceleration));
    moment[b] = add(graph, moment[b], spin(graph, state.spread, body.second));
    result[b - 1] = dot(graph, body.turns ? moment[b] : force[b], body.axis);

    const auto p = static_cast<std::size_t>(body.parent);
    const auto f = out_of(graph, state, force[b]);
    force[p] = add(graph, force[p], f);
    moment[p] = add(graph, moment[p], out_of(graph, state, moment[b]));
    moment[p] = add(graph, moment[p], cross(graph, state.arm, f));
  }
  return result;
}

// 1/2 m v.v + v.(w x h) + 1/2 w.(I w), I = trace(S) - S, over all bodies.
Expr kinetic_energy(Graph& graph, const Linkage& linkage) {
  const auto bodies = bodies_of(graph, linkage).bodies;
  const auto states = motion(graph, bodies, {});
  Expr twice;
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    const auto& [v, w] = std::pair(states[b].velocity, states[b].omega);
    const Expr trace = graph.add(graph.add(body.second[0][0], body.second[1][1]), body.second[2][2]);
    const auto spinning = subtract(graph, scale(graph, trace, w), multiply(graph, body.second, w));
    const Expr mixed = dot(graph, v, cross(graph, w, body.moment));
    twice = graph.add(twice, graph.multiply(body.mass, dot(graph, v, v)));
    twice = graph.add(twice, graph.multiply(graph.number(2), mixed));
    twice = graph.add(twice, dot(graph, w, spinning));
  }
  return graph.multiply(graph.number(0.5), twice);
}

}  // namespace spacetime::symbolic
