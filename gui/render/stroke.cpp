#include "gui/render/stroke.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

#include "gui/render/palette.h"

namespace spacetime::gui {
namespace {

constexpr float feather = 1;  // pixels beyond the width, for the smooth edge

// A point of the picture: pixels, and depth in [-1, 1].
using Seen = glm::vec3;

glm::vec3 device(const Seen& p, const glm::vec2& size) { return {2 * p.x / size.x - 1, 1 - 2 * p.y / size.y, p.z}; }

// The runs of a polyline that are before the eye.
std::vector<std::vector<Seen>> seen(const std::vector<glm::vec3>& points, const Camera& camera, const glm::vec2& size) {
  const glm::mat4 matrix = projection_matrix(camera, size) * view_matrix(camera);
  const auto pixel = [&](const glm::vec4& clip) {
    return Seen{(0.5F + 0.5F * clip.x / clip.w) * size.x, (0.5F - 0.5F * clip.y / clip.w) * size.y, clip.z / clip.w};
  };
  std::vector<std::vector<Seen>> runs;
  const auto add = [&](const Seen& p) {
    auto& run = runs.back();
    if (run.empty() || glm::length(glm::vec2(p) - glm::vec2(run.back())) > 0.05F) run.push_back(p);
  };
  glm::vec4 last{};
  bool inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec4 clip = matrix * glm::vec4(points[i], 1);
    const float above = clip.z + clip.w, above_last = last.z + last.w;  // of the near plane
    if (i > 0 && inside != (above > 0)) {
      const glm::vec4 crossing = glm::mix(last, clip, above_last / (above_last - above));
      if (!inside) runs.emplace_back();
      add(pixel(crossing));
    } else if (i == 0 && above > 0) {
      runs.emplace_back();
    }
    inside = above > 0;
    if (inside) add(pixel(clip));
    last = clip;
  }
  return runs;
}

glm::vec4 rgba(const Colour& colour, float opacity) { return {colour.red, colour.green, colour.blue, opacity}; }

glm::vec2 across(const Seen& from, const Seen& to) {
  const glm::vec2 along = glm::normalize(glm::vec2(to) - glm::vec2(from));
  return {-along.y, along.x};
}

// One strip, mitred where it turns.
void add_run(Strokes& strokes, const std::vector<Seen>& run, float width, const glm::vec4& colour, bool dashed,
             const glm::vec2& size) {
  if (run.size() < 2) return;
  const float half = 0.5F * std::max(width, 1.0F), reach = half + feather;
  float along = 0;
  std::array<StrokeVertex, 2> before{};
  for (std::size_t i = 0; i < run.size(); ++i) {
    const glm::vec2 in = i > 0 ? across(run[i - 1], run[i]) : across(run[0], run[1]);
    const glm::vec2 out = i + 1 < run.size() ? across(run[i], run[i + 1]) : in;
    const glm::vec2 sum = in + out;
    const glm::vec2 normal = glm::length(sum) > 1e-3F ? glm::normalize(sum) : in;
    const glm::vec2 offset = normal * (reach / std::max(glm::dot(normal, in), 0.5F));
    if (i > 0) along += glm::length(glm::vec2(run[i]) - glm::vec2(run[i - 1]));
    const auto side = [&](float sign) {
      return StrokeVertex{device(run[i] + sign * glm::vec3(offset, 0), size),
                          colour,
                          {static_cast<float>(Edge::line), sign * reach, half, dashed ? along : -1}};
    };
    const std::array<StrokeVertex, 2> now{side(-1), side(1)};
    if (i > 0) {
      for (const auto& vertex : {before[0], before[1], now[1], before[0], now[1], now[0]}) strokes.push_back(vertex);
    }
    before = now;
  }
}

// A run that ends in a head; the line stops where the head begins.
void add_headed(Strokes& strokes, std::vector<Seen> run, float width, const Colour& colour, const glm::vec2& size) {
  if (run.size() < 2) return;
  const Seen tip = run.back();
  const float length = std::max(4.2F * width, 9.0F);
  Seen base = run.front();
  while (run.size() > 1) {  // back along the run by the head's length
    run.pop_back();
    const Seen& last = run.back();
    const float distance = glm::length(glm::vec2(tip) - glm::vec2(last));
    if (distance >= length) {
      base = glm::mix(tip, last, length / distance);
      run.push_back(base);
      break;
    }
  }
  const glm::vec2 to = glm::vec2(tip) - glm::vec2(base);
  if (glm::length(to) < 0.5F) return;
  add_run(strokes, run, width, rgba(colour, 1), false, size);
  const glm::vec2 along = glm::normalize(to), wide = 0.42F * length * glm::vec2{-along.y, along.x};
  for (const Seen& corner : {tip, base + Seen(wide, 0), base - Seen(wide, 0)}) {
    strokes.push_back({device(corner, size), rgba(colour, 1), {static_cast<float>(Edge::plain), 0, 0, 0}});
  }
  const std::vector<Seen> outline{base, base + Seen(wide, 0), tip, base - Seen(wide, 0), base};
  add_run(strokes, outline, 1, rgba(colour, 1), false, size);  // smooth edges
}

}  // namespace

void add(Strokes& strokes, const Line& line, const Camera& camera, const glm::vec2& size) {
  for (const auto& run : seen(line.points, camera, size)) {
    add_run(strokes, run, line.width, rgba(line.colour, line.opacity), line.dashed, size);
  }
}

void add(Strokes& strokes, const Arrow& arrow, const Camera& camera, const glm::vec2& size) {
  for (const auto& run : seen({arrow.from, arrow.to}, camera, size)) {
    add_headed(strokes, run, arrow.width, arrow.colour, size);
  }
}

void add(Strokes& strokes, const Torque& torque, const Camera& camera, const glm::vec2& size) {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  const float angle = std::clamp(torque.angle, -0.95F * turn, 0.95F * turn);
  const glm::vec3 axis = glm::normalize(torque.axis);
  const glm::vec3 other = std::abs(axis.y) < 0.9F ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
  const glm::vec3 u = glm::normalize(glm::cross(other, axis)), v = glm::cross(axis, u);
  const int pieces = 4 + static_cast<int>(std::abs(angle) * 10);
  std::vector<glm::vec3> points;
  for (int k = 0; k <= pieces; ++k) {
    const float phi = angle * static_cast<float>(k) / static_cast<float>(pieces);
    points.push_back(torque.centre + torque.radius * (std::cos(phi) * u + std::sin(phi) * v));
  }
  for (const auto& run : seen(points, camera, size)) add_headed(strokes, run, torque.width, torque.colour, size);
}

void add(Strokes& strokes, const Mark& mark, const Camera& camera, const glm::vec2& size, Theme theme) {
  const auto at = seen({mark.place, mark.place}, camera, size);
  if (at.empty()) return;
  const Palette& colours = palette(theme);
  const auto [edge, colour, opacity] = [&]() -> std::tuple<Edge, Colour, float> {
    switch (mark.kind) {
      case Mark::Kind::met:
        return {Edge::disc, colours.met, 0.9F};
      case Mark::Kind::violated:
        return {Edge::cross, colours.violated, 1.0F};
      case Mark::Kind::soft:
        return {Edge::ring, colours.soft, 1.0F};
      case Mark::Kind::disabled:
        break;
    }
    return {Edge::ring, colours.disabled, 0.6F};
  }();
  const float radius = 0.5F * mark.size, reach = radius + feather;
  const auto corner = [&](float x, float y) {
    return StrokeVertex{device(at[0][0] + Seen{x * reach, y * reach, 0}, size),
                        rgba(colour, opacity),
                        {static_cast<float>(edge), x * reach, y * reach, radius}};
  };
  const auto a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
  for (const auto& vertex : {a, b, c, a, c, d}) strokes.push_back(vertex);
}

}  // namespace spacetime::gui
