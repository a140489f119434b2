// The two meshes that all solids are made of.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace spacetime::gui {

// A vertex of a solid: at * scale, and `far` lengths along z.
struct MeshVertex {
  glm::vec3 at;  // on the unit sphere, or the unit cube's corner
  glm::vec3 normal;
  float far;  // 1 on the half of a capsule at its other end
};
using Mesh = std::vector<MeshVertex>;  // three a triangle, anticlockwise seen from outside

// A sphere whose upper half (z > 0) is the far one: drawn out along z it is a capsule.
Mesh capsule_mesh();
Mesh box_mesh();

}  // namespace spacetime::gui
