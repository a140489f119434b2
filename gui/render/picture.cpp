#include "gui/render/picture.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace spacetime::gui {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

// Distances along a ray of unit direction to a solid in its own axes; `nothing` where it is missed.
float hit_sphere(const Ray& ray, const glm::vec3& centre, float radius) {
  const glm::vec3 to = ray.origin - centre;
  const float b = glm::dot(to, ray.direction), c = glm::dot(to, to) - radius * radius;
  const float discriminant = b * b - c;
  if (discriminant < 0) return nothing;
  const float near = -b - std::sqrt(discriminant);
  return near > 0 ? near : nothing;
}

// |o + t d - its part along the axis|^2 = r^2, between the ends.
float hit_tube(const Ray& ray, const glm::vec3& end, float radius) {
  const float length = glm::length(end);
  if (length <= 0) return nothing;
  const glm::vec3 axis = end / length;
  const glm::vec3 d = ray.direction - axis * glm::dot(ray.direction, axis);
  const glm::vec3 o = ray.origin - axis * glm::dot(ray.origin, axis);
  const float a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - radius * radius;
  if (a < 1e-12F || b * b < a * c) return nothing;
  const float t = (-b - std::sqrt(b * b - a * c)) / a;
  const float along = glm::dot(ray.origin + t * ray.direction, axis);
  return t > 0 && along >= 0 && along <= length ? t : nothing;
}

float hit_box(const Ray& ray, const glm::vec3& edges) {
  float near = 0, far = nothing;
  for (int i = 0; i < 3; ++i) {
    const float one = (-0.5F * edges[i] - ray.origin[i]) / ray.direction[i];
    const float other = (0.5F * edges[i] - ray.origin[i]) / ray.direction[i];
    near = std::fmax(near, std::fmin(one, other));  // fmin and fmax pass over 0/0
    far = std::fmin(far, std::fmax(one, other));
  }
  return near <= far ? near : nothing;
}

float hit(const Solid& solid, const Ray& world) {
  const glm::mat4 inverse = glm::inverse(solid.pose);
  const Ray ray{glm::vec3(inverse * glm::vec4(world.origin, 1)), glm::vec3(inverse * glm::vec4(world.direction, 0))};
  switch (solid.shape) {
    case Solid::Shape::sphere:
      return hit_sphere(ray, {}, solid.radius);
    case Solid::Shape::box:
      return hit_box(ray, solid.extent);
    case Solid::Shape::capsule:
      break;
  }
  return std::fmin(hit_tube(ray, solid.extent, solid.radius),
                   std::fmin(hit_sphere(ray, {}, solid.radius), hit_sphere(ray, solid.extent, solid.radius)));
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, float share) {
  const auto between = [&](float x, float y) { return x + share * (y - x); };
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue)};
}

Colour colour_of(unsigned rgb) {
  const auto part = [&](int shift) { return static_cast<float>(rgb >> shift & 255U) / 255.0F; };
  return {part(16), part(8), part(0)};
}

void Box::include(const glm::vec3& point) { include({point, point}); }

void Box::include(const Box& box) {
  if (box.empty()) return;
  *this = empty() ? box : Box{glm::min(low, box.low), glm::max(high, box.high)};
}

Box bounds(const Solid& solid) {
  const glm::vec3 at(solid.pose[3]);
  if (solid.shape == Solid::Shape::box) {
    glm::vec3 half{0};
    for (int i = 0; i < 3; ++i) half += glm::abs(glm::vec3(solid.pose[i])) * 0.5F * solid.extent[i];
    return {at - half, at + half};
  }
  Box box{at, at};
  if (solid.shape == Solid::Shape::capsule) box.include(glm::vec3(solid.pose * glm::vec4(solid.extent, 1)));
  return {box.low - solid.radius, box.high + solid.radius};
}

int pick(const Picture& picture, const Ray& ray) {
  const Ray unit{ray.origin, glm::normalize(ray.direction)};
  float nearest = nothing;
  int id = -1;
  for (const Solid& solid : picture.solids) {
    if (solid.layer != 0) continue;
    const float distance = hit(solid, unit);
    if (distance < nearest) nearest = distance, id = solid.id;
  }
  return id;
}

float distance(const Solid& solid, const glm::vec3& world) {
  const glm::vec3 point(glm::inverse(solid.pose) * glm::vec4(world, 1));
  if (solid.shape == Solid::Shape::box) {
    const glm::vec3 off = glm::abs(point) - 0.5F * solid.extent;
    return glm::length(glm::max(off, 0.0F)) + std::fmin(std::fmax(off.x, std::fmax(off.y, off.z)), 0.0F);
  }
  const glm::vec3 end = solid.shape == Solid::Shape::capsule ? solid.extent : glm::vec3(0);
  const float square = glm::dot(end, end);
  const float along = square > 0 ? glm::clamp(glm::dot(point, end) / square, 0.0F, 1.0F) : 0.0F;
  return glm::length(point - along * end) - solid.radius;
}

}  // namespace spacetime::gui
