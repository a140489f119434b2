// Symbolic mechanics of trees of rigid links: recursive Newton-Euler in link frames (Luh, Walker and Paul 1980;
// Craig, Introduction to Robotics, ch. 6), positions, energies.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/graph.h"
#include "symbolic/vector.h"

namespace spacetime::symbolic {

// A joint's variable with its two time derivatives: inputs, or (after `eliminate`) any expressions.
struct Coordinate {
  Expr q, v, a;
};

// One link and the joint that carries it.  Distal Denavit-Hartenberg: Rz(theta) Tz(d) Tx(a) Rx(alpha), the joint's
// coordinate (plus offset) added to theta (revolute) or d (prismatic); or, where `axis` is set, a turn about or a slide
// along `axis` (made a unit vector) through `origin`, both in the parent's frame.
struct Link {
  enum class Joint { revolute, prismatic, fixed } joint = Joint::fixed;
  int parent = -1;                       // index of an earlier link, -1: ground
  std::optional<Coordinate> coordinate;  // revolute, prismatic
  Expr offset, a, alpha, d, theta;       // metres and radians
  std::optional<Vector3> axis;
  Vector3 origin;
  Expr mass;                    // kg
  Vector3 com;                  // centre of mass in the link's frame, m
  std::array<Expr, 6> inertia;  // about the centre of mass, link axes: ixx iyy izz ixy ixz iyz, kg m^2
};

struct PointForce {
  int link = 0;
  Vector3 point;  // in the link's frame
  Vector3 force;  // in world axes, N
};

struct Linkage {
  Vector3 gravity;          // m/s^2, world axes
  std::vector<Link> links;  // parents before children
  std::vector<PointForce> forces;
};

struct Frame {
  Matrix3 rotation;  // world from link
  Vector3 position;  // of the link's frame, world
};

// World frames of all links.
std::vector<Frame> frames(Graph& graph, const Linkage& linkage);
Vector3 transform(Graph& graph, const Frame& frame, const Vector3& point);

// Generalised forces, one for each link with a coordinate, in the order of links: what a motor must supply, gravity
// and outside forces accounted for.
std::vector<Expr> generalised_forces(Graph& graph, const Linkage& linkage);

Vector3 centre_of_mass(Graph& graph, const Linkage& linkage,
                       const std::vector<Frame>& frames);  // total mass must not be zero
Expr kinetic_energy(Graph& graph, const Linkage& linkage);
Expr potential_energy(Graph& graph, const Linkage& linkage, const std::vector<Frame>& frames);  // -sum m g.p

}  // namespace spacetime::symbolic
