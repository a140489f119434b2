#include "gui/render/mesh.h"

#include <array>
#include <cmath>
#include <numbers>

namespace spacetime::gui {

Mesh capsule_mesh() {
  constexpr int around = 32, rings = 8;  // a half has so many rings; the middle band is between the two equators
  struct Ring {
    float radius, height, far;
  };
  std::array<Ring, 2 * (rings + 1)> profile{};
  for (int k = 0; k <= rings; ++k) {
    const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(k) / rings;  // from the pole
    profile[k] = {std::sin(angle), -std::cos(angle), 0};
    profile[2 * rings + 1 - k] = {std::sin(angle), std::cos(angle), 1};
  }
  const auto vertex = [&](std::size_t ring, int k) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k % around) / around;
    const auto [radius, height, far] = profile[ring];
    const glm::vec3 at{radius * std::cos(angle), radius * std::sin(angle), height};
    return MeshVertex{at, at, far};
  };
  Mesh mesh;
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (int k = 0; k < around; ++k) {
      const auto a = vertex(ring, k), b = vertex(ring, k + 1), c = vertex(ring + 1, k + 1), d = vertex(ring + 1, k);
      for (const auto& corner : {a, b, c, a, c, d}) mesh.push_back(corner);
    }
  }
  return mesh;
}

Mesh box_mesh() {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-0.5F, 0.5F}) {
      const auto corner = [&](float u, float v) {
        glm::vec3 at{0}, normal{0};
        at[axis] = side;
        at[(axis + 1) % 3] = side > 0 ? u : v;
        at[(axis + 2) % 3] = side > 0 ? v : u;
        normal[axis] = 2 * side;
        return MeshVertex{at, normal, 0};
      };
      const auto a = corner(-0.5F, -0.5F), b = corner(0.5F, -0.5F), c = corner(0.5F, 0.5F), d = corner(-0.5F, 0.5F);
      for (const auto& vertex : {a, b, c, a, c, d}) mesh.push_back(vertex);
    }
  }
  return mesh;
}

}  // namespace spacetime::gui
