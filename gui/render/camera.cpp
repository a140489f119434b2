#include "gui/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/diagnostic.h"

namespace spacetime::gui {
namespace {

constexpr float quarter = std::numbers::pi_v<float> / 2;

// Right, up, and back towards the eye.
struct Axes {
  glm::vec3 right, up, back;
};
Axes axes(const Camera& camera) {
  const float cy = std::cos(camera.yaw), sy = std::sin(camera.yaw);
  const float cp = std::cos(camera.pitch), sp = std::sin(camera.pitch);
  return {{cy, 0, -sy}, {-sy * sp, cp, -cy * sp}, {sy * cp, sp, cy * cp}};
}

// Metres a pixel at the target's depth.
float scale(const Camera& camera, const glm::vec2& size) {
  return 2 * camera.distance * std::tan(camera.fov / 2) / size.y;
}

}  // namespace

Camera looking(View view, Camera camera) {
  switch (view) {
    case View::front:
      camera.yaw = 0, camera.pitch = 0;
      break;
    case View::side:
      camera.yaw = quarter, camera.pitch = 0;
      break;
    case View::top:
      camera.yaw = 0, camera.pitch = quarter;
      break;
    case View::free:
      camera.yaw = 0.5F, camera.pitch = 0.35F;
      break;
  }
  return camera;
}

Camera orbit(Camera camera, float yaw, float pitch) {
  camera.yaw = std::remainder(camera.yaw + yaw, 4 * quarter);
  camera.pitch = std::clamp(camera.pitch + pitch, -quarter, quarter);
  return camera;
}

Camera pan(Camera camera, const glm::vec2& pixels, const glm::vec2& size) {
  const auto [right, up, back] = axes(camera);
  camera.target += scale(camera, size) * (pixels.y * up - pixels.x * right);
  return camera;
}

Camera zoom(Camera camera, float factor, const glm::vec2& pixel, const glm::vec2& size) {
  const float distance = std::clamp(camera.distance / factor, 1e-3F, 1e5F);
  const float kept = distance / camera.distance;
  camera = pan(camera, (1 - kept) * (0.5F * size - pixel), size);
  camera.distance = distance;
  return camera;
}

// With q a corner seen from the target, x <= (d - z) tan is what asks for the distance d = z + x/tan.  Near corners
// reach further out than far ones, so that the box's centre is not the picture's: the target is moved to the middle of
// what is seen, which changes the distance, and so on.
Camera frame(Camera camera, const Box& box, const glm::vec2& size, float margin) {
  constexpr int rounds = 12;  // each leaves about a third of what is off
  if (box.empty()) return camera;
  const auto [right, up, back] = axes(camera);
  camera.target = box.centre();
  const float vertical = std::tan(camera.fov / 2) * (1 - 2 * margin), horizontal = vertical * size.x / size.y;
  std::array<glm::vec3, 8> corners;
  for (int k = 0; k < 8; ++k) {
    corners[static_cast<std::size_t>(k)] = {k & 1 ? box.low.x : box.high.x, k & 2 ? box.low.y : box.high.y,
                                            k & 4 ? box.low.z : box.high.z};
  }
  for (int round = 0; round <= rounds; ++round) {
    camera.distance = 1e-2F;
    for (const glm::vec3& corner : corners) {
      const glm::vec3 q = corner - camera.target;
      const float needed = std::max(std::abs(glm::dot(q, right)) / horizontal, std::abs(glm::dot(q, up)) / vertical);
      camera.distance = std::max(camera.distance, camera.orthographic ? needed : needed + glm::dot(q, back));
    }
    if (round == rounds) break;
    glm::vec2 low(1e9F), high(-1e9F);
    for (const glm::vec3& corner : corners) {
      const glm::vec3 q = corner - camera.target;
      const float depth = camera.distance - (camera.orthographic ? 0 : glm::dot(q, back));
      const glm::vec2 seen = glm::vec2(glm::dot(q, right), glm::dot(q, up)) * (camera.distance / depth);
      low = glm::min(low, seen);
      high = glm::max(high, seen);
    }
    const glm::vec2 middle = 0.5F * (low + high);
    camera.target += middle.x * right + middle.y * up;
  }
  return camera;
}

glm::vec3 eye(const Camera& camera) { return camera.target + camera.distance * axes(camera).back; }

glm::mat4 view_matrix(const Camera& camera) { return glm::lookAt(eye(camera), camera.target, axes(camera).up); }

glm::mat4 projection_matrix(const Camera& camera, const glm::vec2& size) {
  const float aspect = size.x / size.y;
  if (camera.orthographic) {
    const float half = camera.distance * std::tan(camera.fov / 2);
    return glm::ortho(-half * aspect, half * aspect, -half, half, -20 * camera.distance, 40 * camera.distance);
  }
  return glm::perspective(camera.fov, aspect, 0.02F * camera.distance, 60 * camera.distance);
}

std::optional<glm::vec2> project(const Camera& camera, const glm::vec2& size, const glm::vec3& point) {
  const glm::vec4 clip = projection_matrix(camera, size) * view_matrix(camera) * glm::vec4(point, 1);
  if (clip.w <= 0) return std::nullopt;
  return glm::vec2{(0.5F + 0.5F * clip.x / clip.w) * size.x, (0.5F - 0.5F * clip.y / clip.w) * size.y};
}

Ray ray_through(const Camera& camera, const glm::vec2& size, const glm::vec2& pixel) {
  const auto [right, up, back] = axes(camera);
  const glm::vec2 off = scale(camera, size) * (pixel - 0.5F * size);
  const glm::vec3 at = camera.target + off.x * right - off.y * up;
  if (camera.orthographic) return {at + 20 * camera.distance * back, -back};
  return {eye(camera), glm::normalize(at - eye(camera))};
}

std::string camera_text(const Camera& camera) {
  constexpr float degrees = 90 / quarter;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g%s", camera.target.x, camera.target.y,
                camera.target.z, camera.yaw * degrees, camera.pitch * degrees, camera.distance,
                camera.orthographic ? ",orthographic" : "");
  return text.data();
}

Camera read_camera(const std::string& text) {
  Camera camera;
  int read = 0;
  const int numbers = std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f%n", &camera.target.x, &camera.target.y,
                                  &camera.target.z, &camera.yaw, &camera.pitch, &camera.distance, &read);
  const std::string rest = numbers == 6 ? text.substr(static_cast<std::size_t>(read)) : "?";
  camera.orthographic = rest == ",orthographic";
  const bool finite = std::isfinite(glm::dot(camera.target, camera.target)) && std::isfinite(camera.yaw) &&
                      std::isfinite(camera.distance);
  if ((!rest.empty() && !camera.orthographic) || !finite || !(camera.distance > 0) || !(std::abs(camera.pitch) <= 90))
    throw InputError("'" + text + "' is no camera: write it X,Y,Z,YAW,PITCH,DISTANCE, in metres and degrees");
  camera.yaw *= quarter / 90;
  camera.pitch *= quarter / 90;
  return camera;
}

}  // namespace spacetime::gui
