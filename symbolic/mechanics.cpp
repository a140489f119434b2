#include "symbolic/mechanics.h"

#include <optional>

#include "common/assert.h"
#include "symbolic/bodies.h"

namespace spacetime::symbolic {
namespace {

// The axes in which a body's vectors are written.  Joints in a row that turn about parallel axes make a run: the axes
// of its bodies are those it starts from, in which the bodies are turned by the sum of the angles.  Then nothing needs
// to be turned from one body of a run to the next.  A joint that is alone has its own body's axes.
struct Axes {
  bool follows = true;         // the parent's axes, taken over as they are
  Matrix3 from_parent;         // else: turns vectors from the parent's axes into these
  Matrix3 rotation;            // these axes from the body's own
  std::optional<Vector3> run;  // the axis about which `rotation` turns
  Expr angle;                  // ... and by how much
};

std::vector<Axes> axes_of(Graph& graph, const std::vector<Body>& bodies) {
  // The run of the last joint that turned: its first body, and the joints in it.
  std::vector<int> run(bodies.size()), length(bodies.size());
  const auto parallel = [&](const Vector3& u, const Vector3& v) {
    return u == v || u == scale(graph, graph.number(-1), v);
  };
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    run[b] = run[body.parent];
    if (!body.turns) continue;
    const bool goes_on = run[b] > 0 && body.fixed == identity(graph) && parallel(body.axis, bodies[run[b]].axis);
    if (!goes_on) run[b] = static_cast<int>(b);
    ++length[run[b]];
  }
  std::vector<Axes> result(bodies.size());
  result[0].rotation = identity(graph);
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    const auto& parent = result[body.parent];
    auto& axes = result[b];
    axes = parent;
    axes.follows = true;
    if (!body.turns) continue;
    if (run[b] != static_cast<int>(b)) {  // goes on
      const bool same = body.axis == bodies[run[b]].axis;
      axes.angle = same ? graph.add(parent.angle, body.travel) : graph.subtract(parent.angle, body.travel);
      axes.rotation = turn(graph, *axes.run, axes.angle);
      continue;
    }
    auto back = transpose(multiply(graph, parent.rotation, body.fixed));
    const auto turning = turn(graph, body.axis, body.travel);
    if (length[b] == 1) {
      back = multiply(graph, transpose(turning), back);
      axes = {.from_parent = back, .rotation = identity(graph), .run = {}, .angle = {}};
    } else {
      axes = {.from_parent = back, .rotation = turning, .run = body.axis, .angle = body.travel};
    }
    axes.follows = back == identity(graph);
  }
  return result;
}

// A body-fixed vector where it has a single component: k-th of the body's axes.
std::optional<int> single_component(const Vector3& x) {
  std::optional<int> found;
  for (int k = 0; k < 3; ++k) {
    if (x[k] == Expr{}) continue;
    if (found) return std::nullopt;
    found = k;
  }
  return found;
}

// The motion of a body, in its axes; of its point `position` and `velocity` from where the axes start.
struct State {
  Vector3 omega, alpha;  // angular velocity and acceleration
  Matrix3 spread;        // U = [alpha]x + [omega]x^2, so that a point x has acceleration a + U x
  Vector3 acceleration;  // of the body's point, less gravity
  Vector3 arm;           // from the parent's point to the body's, in the parent's axes
};

Matrix3 spread_of(Graph& graph, const Vector3& w, const Vector3& alpha) {
  Matrix3 p = outer(graph, w, w), u;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    u[k][k] = graph.negate(graph.add(p[i][i], p[j][j]));
    u[i][j] = graph.subtract(p[i][j], alpha[k]);
    u[j][i] = graph.add(p[i][j], alpha[k]);
  }
  return u;
}

// Numbers that body-fixed vectors are multiplied with: matrix * (rotation * x), through the rotated axis where x has
// a single component, so that several vectors along it share the product.
Vector3 applied(Graph& graph, const Matrix3& matrix, const Matrix3& rotation, const Vector3& x) {
  if (const auto k = single_component(x)) {
    return scale(graph, x[*k], multiply(graph, matrix, column(rotation, *k)));
  }
  return multiply(graph, matrix, multiply(graph, rotation, x));
}

// Moments of forces whose arms lie along one of a body's axes, gathered by the axis so that the cross product is made
// once: e_k x (l0 f0 + l1 f1 + ...) = l0 e_k x (f0 + l1/l0 f1 + ...).
class Levers {
 public:
  void add(Graph& graph, int axis, Expr length, const Vector3& force) {
    auto& [unit, sum] = by_axis_[axis];
    if (unit == Expr{} && graph.constant(length)) unit = length;
    const bool in_units = unit != Expr{} && graph.constant(length);
    auto& part = in_units ? sum : rest_[axis];
    part = symbolic::add(graph, part, scale(graph, in_units ? graph.divide(length, unit) : length, force));
  }
  Vector3 moment(Graph& graph, const Matrix3& rotation) const {
    Vector3 result;
    for (int k = 0; k < 3; ++k) {
      const auto along = column(rotation, k);
      const auto& [unit, sum] = by_axis_[k];
      result = symbolic::add(graph, result, scale(graph, unit, cross(graph, along, sum)));
      result = symbolic::add(graph, result, cross(graph, along, rest_[k]));
    }
    return result;
  }

 private:
  struct InUnits {
    Expr unit;
    Vector3 sum;
  };
  std::array<InUnits, 3> by_axis_;
  std::array<Vector3, 3> rest_;  // of lengths that are no numbers
};

class Recursion {
 public:
  Recursion(Graph& graph, const Linkage& linkage)
      : graph_(graph), layout_(bodies_of(graph, linkage)), axes_(axes_of(graph, layout_.bodies)) {}

  const std::vector<Body>& bodies() const { return layout_.bodies; }
  const std::vector<Mount>& mounts() const { return layout_.mounts; }
  const Axes& axes(std::size_t b) const { return axes_[b]; }

  // A vector from the parent's axes into the body's, and back.
  Vector3 into(std::size_t b, const Vector3& x) {
    return axes_[b].follows ? x : multiply(graph_, axes_[b].from_parent, x);
  }
  Vector3 out_of(std::size_t b, const Vector3& x) {
    return axes_[b].follows ? x : multiply(graph_, transpose(axes_[b].from_parent), x);
  }
  Vector3 turned(std::size_t b, const Vector3& x) { return multiply(graph_, axes_[b].rotation, x); }

  // The joint's axis in the body's axes: the joint's own turn leaves it alone.
  Vector3 joint_axis(std::size_t b) {
    const auto& body = bodies()[b];
    return body.turns ? turned(b, body.axis) : turned(body.parent, body.axis);
  }
  // From the parent's point to the body's, in the parent's axes.
  Vector3 arm(std::size_t b) {
    const auto& body = bodies()[b];
    auto result = turned(body.parent, body.joint);
    if (!body.turns) result = add(graph_, result, scale(graph_, body.travel, joint_axis(b)));
    return result;
  }

  // Angular velocities; with them the rest of the recursion outwards.
  std::vector<State> motion(const Vector3& gravity) {
    std::vector<State> states(bodies().size());
    states[0].acceleration = scale(graph_, graph_.number(-1), gravity);
    for (std::size_t b = 1; b < bodies().size(); ++b) states[b] = moved(b, states[bodies()[b].parent]);
    return states;
  }

  // For every body the rotation from its axes to the world's, and the position of its point.
  std::vector<Frame> world() {
    std::vector<Frame> result(bodies().size());
    std::vector<Vector3> within(bodies().size());  // from the point at which the axes start
    std::vector<Vector3> start(bodies().size());   // that point, in the world
    result[0].rotation = identity(graph_);
    for (std::size_t b = 1; b < bodies().size(); ++b) {
      const auto p = bodies()[b].parent;
      within[b] = add(graph_, within[p], arm(b));
      start[b] = start[p];
      result[b].rotation = result[p].rotation;
      if (!axes_[b].follows) {
        start[b] = add(graph_, start[p], multiply(graph_, result[p].rotation, within[b]));
        within[b] = {};
        result[b].rotation = multiply(graph_, result[p].rotation, transpose(axes_[b].from_parent));
      }
      result[b].position = add(graph_, start[b], multiply(graph_, result[b].rotation, within[b]));
    }
    return result;
  }

 private:
  State moved(std::size_t b, const State& parent) {
    const auto& body = bodies()[b];
    const auto [q, v, a] = body.coordinate;
    State state;
    state.arm = arm(b);
    const auto at_joint =
        add(graph_, parent.acceleration, applied(graph_, parent.spread, axes_[body.parent].rotation, body.joint));
    const auto u = joint_axis(b);
    if (body.turns) {
      const auto carried = into(b, parent.omega);
      state.omega = add(graph_, carried, scale(graph_, v, u));
      const auto precession = scale(graph_, v, cross(graph_, carried, u));
      state.alpha = add(graph_, into(b, parent.alpha), add(graph_, scale(graph_, a, u), precession));
      state.acceleration = into(b, at_joint);
      state.spread = spread_of(graph_, state.omega, state.alpha);
    } else {
      state.omega = parent.omega;
      state.alpha = parent.alpha;
      state.spread = parent.spread;
      const auto coriolis = scale(graph_, graph_.multiply(graph_.number(2), v), cross(graph_, parent.omega, u));
      const auto sliding = add(graph_, coriolis, scale(graph_, a, u));
      const auto reach = scale(graph_, body.travel, multiply(graph_, parent.spread, u));
      state.acceleration = add(graph_, add(graph_, at_joint, reach), sliding);
    }
    return state;
  }

  Graph& graph_;
  Bodies layout_;
  std::vector<Axes> axes_;
};

}  // namespace

std::vector<Frame> frames(Graph& graph, const Linkage& linkage) {
  Recursion recursion(graph, linkage);
  const auto world = recursion.world();
  std::vector<Frame> result;
  for (const auto& mount : recursion.mounts()) {
    const auto& base = world[mount.body];
    const auto rotation = multiply(graph, base.rotation, recursion.axes(mount.body).rotation);
    result.push_back({multiply(graph, rotation, mount.rotation),
                      add(graph, base.position, multiply(graph, rotation, mount.position))});
  }
  return result;
}

Vector3 transform(Graph& graph, const Frame& frame, const Vector3& point) {
  return add(graph, frame.position, multiply(graph, frame.rotation, point));
}

// Outwards the motion, inwards the forces:
//   f = m a + U h - F + sum f_child
//   n = h x a + N(U, S) - x x F + sum (n_child + arm x f_child)
// about each body's point, where h and S are its first and second moment and N = sum_jk S_jk e_j x U e_k.
std::vector<Expr> generalised_forces(Graph& graph, const Linkage& linkage) {
  Recursion recursion(graph, linkage);
  const auto& bodies = recursion.bodies();
  const auto states = recursion.motion(linkage.gravity);
  std::vector<Vector3> force(bodies.size()), moment(bodies.size());
  std::vector<Levers> levers(bodies.size());
  const auto add_lever = [&](std::size_t b, const Vector3& arm, const Vector3& f) {
    if (const auto k = single_component(arm)) {
      levers[b].add(graph, *k, arm[*k], f);
    } else {
      moment[b] = add(graph, moment[b], cross(graph, recursion.turned(b, arm), f));
    }
  };

  for (const auto& [link, point, world_force] : linkage.forces) {
    const auto& mount = recursion.mounts()[link];
    std::vector<int> chain;
    for (int b = mount.body; b > 0; b = bodies[b].parent) chain.push_back(b);
    auto f = scale(graph, graph.number(-1), world_force);
    for (auto b = chain.rbegin(); b != chain.rend(); ++b) f = recursion.into(*b, f);
    force[mount.body] = add(graph, force[mount.body], f);
    add_lever(mount.body, add(graph, mount.position, multiply(graph, mount.rotation, point)), f);
  }

  std::vector<Expr> result(bodies.size() - 1);
  for (std::size_t b = bodies.size(); b-- > 1;) {
    const auto& body = bodies[b];
    const auto& state = states[b];
    const auto& rotation = recursion.axes(b).rotation;
    const auto inertial =
        add(graph, scale(graph, body.mass, state.acceleration), applied(graph, state.spread, rotation, body.moment));
    force[b] = add(graph, force[b], inertial);
    add_lever(b, body.moment, state.acceleration);

    // N from U in the body's own axes, where S is constant.
    const auto omega = multiply(graph, transpose(rotation), state.omega);
    const auto alpha = multiply(graph, transpose(rotation), state.alpha);
    const auto us = multiply(graph, spread_of(graph, omega, alpha), body.second);
    Vector3 spin;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      spin[k] = graph.subtract(us[j][i], us[i][j]);
    }
    moment[b] = add(graph, moment[b], recursion.turned(b, spin));
    moment[b] = add(graph, moment[b], levers[b].moment(graph, rotation));

    const auto u = recursion.joint_axis(b);
    result[b - 1] = body.turns ? dot(graph, moment[b], u) : dot(graph, force[b], u);
    const auto p = static_cast<std::size_t>(body.parent);
    const auto f = recursion.out_of(b, force[b]);
    force[p] = add(graph, force[p], f);
    moment[p] = add(graph, moment[p], recursion.out_of(b, moment[b]));
    add_lever(p, body.joint, f);
    if (!body.turns) moment[p] = add(graph, moment[p], cross(graph, scale(graph, body.travel, u), f));
  }
  return result;
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

// 1/2 m v.v + v.(w x h) + 1/2 w.(I w), I = trace(S) - S, over all bodies.
Expr kinetic_energy(Graph& graph, const Linkage& linkage) {
  Recursion recursion(graph, linkage);
  const auto& bodies = recursion.bodies();
  const auto states = recursion.motion({});
  std::vector<Vector3> velocity(bodies.size());
  Expr twice;
  for (std::size_t b = 1; b < bodies.size(); ++b) {
    const auto& body = bodies[b];
    const auto& parent = states[body.parent];
    auto v = add(graph, velocity[body.parent], cross(graph, parent.omega, recursion.arm(b)));
    if (!body.turns) v = add(graph, v, scale(graph, body.coordinate.v, recursion.joint_axis(b)));
    velocity[b] = recursion.into(b, v);

    const auto& w = states[b].omega;
    const auto h = recursion.turned(b, body.moment);
    twice = graph.add(twice, graph.multiply(body.mass, dot(graph, velocity[b], velocity[b])));
    twice = graph.add(twice, graph.multiply(graph.number(2), dot(graph, velocity[b], cross(graph, w, h))));
    const auto own = multiply(graph, transpose(recursion.axes(b).rotation), w);
    const Expr trace = graph.add(graph.add(body.second[0][0], body.second[1][1]), body.second[2][2]);
    const auto spin = subtract(graph, scale(graph, trace, own), multiply(graph, body.second, own));
    twice = graph.add(twice, dot(graph, own, spin));
  }
  return graph.multiply(graph.number(0.5), twice);
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
