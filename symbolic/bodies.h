// A linkage as its equations of motion see it: moving bodies with one joint each.
//
// Fixed links belong to the body that carries them, and constant rotations between joints are folded into where links
// and joints sit on a body, so that what is left between a body and its parent is the turn or slide of the joint.
// Mass that the joint does not move is handed to the parent: a joint's torque cannot tell which of two bodies a point
// on their common axis belongs to (the base parameters of Gautier and Khalil 1990, Khalil and Dombre ch. 9).
#pragma once

#include <vector>

#include "symbolic/mechanics.h"

namespace spacetime::symbolic {

// Vectors are in the body's own axes, which are the parent's, turned by `fixed` and then by the joint.
struct Body {
  int parent = 0;      // index of an earlier body; body 0 is the ground
  bool turns = false;  // revolute; else it slides
  Expr travel{};       // angle or distance, offsets included
  Coordinate coordinate{};
  Matrix3 fixed{};  // a constant turn ahead of the joint
  Vector3 axis{};   // unit vector of the joint, in the parent's axes turned by `fixed`
  Vector3 joint{};  // where the joint is, from the parent's point, in the parent's axes

  // Mass about the body's point: the joint's point for one that turns, the point it carries along for one that slides.
  Expr mass{};       // zero for one that turns: handed on
  Vector3 moment{};  // first moment, integral of x dm
  Matrix3 second{};  // second moment, integral of x x^T dm; the inertia tensor is trace(second) - second
};

// Where a link's frame sits on its body.
struct Mount {
  int body = 0;
  Matrix3 rotation;  // body's axes from the link's
  Vector3 position;  // of the link's frame from the body's point, in the body's axes
};

struct Bodies {
  std::vector<Body> bodies;   // the ground, then one for each link with a coordinate, parents before children
  std::vector<Mount> mounts;  // one a link
};

Bodies bodies_of(Graph& graph, const Linkage& linkage);

}  // namespace spacetime::symbolic
