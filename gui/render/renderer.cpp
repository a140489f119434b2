#include "gui/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "gui/render/gl.h"
#include "gui/render/mesh.h"
#include "gui/render/palette.h"
#include "gui/render/shaders.h"
#include "gui/render/stroke.h"

namespace spacetime::gui {
namespace {

const glm::vec3 to_light = glm::normalize(glm::vec3{-0.45F, 1.0F, 0.55F});

// As the light sees them: a box about all that casts a shadow.
struct Light {
  glm::mat4 matrix{1};
  float across = 1;  // m
  Box shadow;        // what it can darken of the ground
};

constexpr float penumbra = 0.012F;  // of what the map spans

Light light_on(const Picture& picture) {
  Box box;
  for (const Solid& solid : picture.solids)
    if (solid.layer == 0) box.include(bounds(solid));
  if (box.empty()) return {};
  const float radius = 0.5F * glm::length(box.size()) + 1e-3F;
  // The ground may lie far below what throws a shadow on it.
  const float depth = 2 * radius + 2 * std::max(0.0F, box.centre().y - picture.ground_height);
  const glm::mat4 view = glm::lookAt(box.centre() + 2 * radius * to_light, box.centre(), {0, 1, 0});
  Box shadow;
  for (int k = 0; k < 8; ++k) {
    const glm::vec3 corner{k & 1 ? box.low.x : box.high.x, k & 2 ? box.low.y : box.high.y,
                           k & 4 ? box.low.z : box.high.z};
    shadow.include(corner - to_light * ((corner.y - picture.ground_height) / to_light.y));
  }
  shadow.low -= 4 * penumbra * radius;
  shadow.high += 4 * penumbra * radius;
  return {glm::ortho(-radius, radius, -radius, radius, 0.0F, 2 * radius + depth) * view, 2 * radius, shadow};
}

// The rotation whose z axis is `end`, in front of the pose.
glm::mat4 along(const glm::mat4& pose, const glm::vec3& end) {
  const float length = glm::length(end);
  if (length <= 0) return pose;
  const glm::vec3 z = end / length;
  const glm::vec3 x = glm::normalize(glm::cross(std::abs(z.x) < 0.9F ? glm::vec3{1, 0, 0} : glm::vec3{0, 1, 0}, z));
  return pose * glm::mat4(glm::vec4(x, 0), glm::vec4(glm::cross(z, x), 0), glm::vec4(z, 0), {0, 0, 0, 1});
}

}  // namespace

struct Renderer::Resources {
  Shader solid{{shaders::solid_vertex}, {shaders::shadow, shaders::solid_fragment}};
  Shader depth{{shaders::solid_vertex}, {shaders::depth_fragment}};
  Shader background{{shaders::background_vertex}, {shaders::background_fragment}};
  Shader ground{{shaders::ground_vertex}, {shaders::ground_fragment}};
  Shader shade{{shaders::ground_vertex}, {shaders::shadow, shaders::shade_fragment}};
  Shader stroke{{shaders::stroke_vertex}, {shaders::stroke_fragment}};
  Vertices capsule{3, 3, 1}, box{3, 3, 1}, strokes{3, 4, 4}, nothing{};
  ShadowMap fast{1024}, fine{2048};

  Resources() {
    capsule.put(std::span<const MeshVertex>(capsule_mesh()));
    box.put(std::span<const MeshVertex>(box_mesh()));
  }

  void draw(const Solid& s, const Shader& shader) const {
    if (s.shape == Solid::Shape::box) {
      shader.set("pose", s.pose);
      shader.set("scale", s.extent);
      shader.set("reach", 0.0F);
      box.draw();
      return;
    }
    const bool capsule_shaped = s.shape == Solid::Shape::capsule;
    shader.set("pose", capsule_shaped ? along(s.pose, s.extent) : s.pose);
    shader.set("scale", glm::vec3(s.radius));
    shader.set("reach", capsule_shaped ? glm::length(s.extent) : 0.0F);
    capsule.draw();
  }

  void draw_depths(std::span<const Solid* const> solids, const glm::mat4& matrix) const {
    depth.use();
    depth.set("matrix", matrix);
    for (const Solid* s : solids) draw(*s, depth);
  }
  void draw_strokes(const Strokes& triangles) {
    if (triangles.empty()) return;
    stroke.use();
    strokes.put(std::span<const StrokeVertex>(triangles));
    strokes.draw();
  }
};

namespace {

void set_light(const Shader& shader, const Light& light, Quality quality) {
  shader.set("light_matrix", light.matrix);
  shader.set("shadow_map", 0);
  shader.set("softness", penumbra);
  shader.set("shadow_samples", quality == Quality::fine ? 16 : 1);
}

}  // namespace

Renderer::Renderer() : resources_(std::make_unique<Resources>()) {}
Renderer::~Renderer() = default;

void Renderer::draw(const Picture& picture, const Camera& camera, int width, int height, Quality quality) {
  Resources& r = *resources_;
  const Palette& colours = palette(picture.theme);
  const glm::vec2 size{width, height};
  const glm::mat4 matrix = projection_matrix(camera, size) * view_matrix(camera);
  const Light light = light_on(picture);
  const ShadowMap& map = quality == Quality::fine ? r.fine : r.fast;

  int last = 0;
  for (const Solid& s : picture.solids) last = std::max(last, s.layer);
  std::vector<std::vector<const Solid*>> layers(static_cast<std::size_t>(last) + 1);
  for (const Solid& s : picture.solids) layers[static_cast<std::size_t>(std::max(s.layer, 0))].push_back(&s);

  GLint framebuffer = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);

  map.bind();
  glViewport(0, 0, map.edge(), map.edge());
  glClear(GL_DEPTH_BUFFER_BIT);
  r.draw_depths(layers[0], light.matrix);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer));
  glViewport(0, 0, width, height);
  glActiveTexture(GL_TEXTURE0);
  map.use();

  glDisable(GL_DEPTH_TEST);
  r.background.use();
  r.background.set("above", colours.above);
  r.background.set("below", colours.below);
  r.nothing.draw(3);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  if (picture.ground && eye(camera).y > picture.ground_height) {
    const float radius = 5 * camera.distance;
    r.ground.use();
    r.ground.set("matrix", matrix);
    const glm::vec3 centre{camera.target.x, picture.ground_height, camera.target.z};
    r.ground.set("centre", centre);
    r.ground.set("middle", centre);
    r.ground.set("half_size", glm::vec3(radius));
    r.ground.set("radius", radius);
    r.ground.set("colour", colours.ground);
    r.ground.set("grid", colours.grid);
    r.ground.set("spacing", std::pow(10.0F, std::floor(std::log10(camera.distance / 5))));
    r.nothing.draw(6);
    if (!light.shadow.empty()) {
      r.shade.use();
      r.shade.set("matrix", matrix);
      r.shade.set("centre", centre);
      r.shade.set("radius", radius);
      r.shade.set("middle", glm::vec3{light.shadow.centre().x, picture.ground_height, light.shadow.centre().z});
      r.shade.set("half_size", 0.5F * light.shadow.size());
      r.shade.set("shade", picture.theme == Theme::light ? 0.24F : 0.45F);
      set_light(r.shade, light, quality);
      r.nothing.draw(6);
    }
  }

  // Ghosts one after another, each a picture of its own over those before; the figure over all.  Its nearest surfaces
  // alone show, so that limbs that overlap are no darker there.
  glEnable(GL_DEPTH_TEST);
  for (std::size_t k = 1; k <= layers.size(); ++k) {
    const auto& layer = layers[k % layers.size()];
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (std::ranges::any_of(layer, [](const Solid* s) { return s->opacity < 1; })) {
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      r.draw_depths(layer, matrix);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    r.solid.use();
    r.solid.set("matrix", matrix);
    r.solid.set("to_light", to_light);
    r.solid.set("eye", eye(camera));
    r.solid.set("towards", camera.orthographic ? glm::normalize(eye(camera) - camera.target) : glm::vec3{0});
    r.solid.set("sky", picture.theme == Theme::light ? glm::vec3{0.74F, 0.76F, 0.79F} : glm::vec3{0.42F, 0.45F, 0.50F});
    r.solid.set("earth",
                picture.theme == Theme::light ? glm::vec3{0.46F, 0.45F, 0.43F} : glm::vec3{0.16F, 0.17F, 0.19F});
    r.solid.set("bias", 0.004F * light.across);
    set_light(r.solid, light, quality);
    for (const Solid* s : layer) {
      r.solid.set("colour", s->colour);
      r.solid.set("opacity", s->opacity);
      r.draw(*s, r.solid);
    }
  }

  glDepthMask(GL_FALSE);
  Strokes strokes;
  for (const Line& line : picture.lines) add(strokes, line, camera, size);
  r.draw_strokes(strokes);
  strokes.clear();
  for (const Torque& torque : picture.torques) add(strokes, torque, camera, size);
  for (const Arrow& arrow : picture.arrows) add(strokes, arrow, camera, size);
  for (const Mark& mark : picture.marks) add(strokes, mark, camera, size, picture.theme);
  glDisable(GL_DEPTH_TEST);
  r.draw_strokes(strokes);
  glDepthMask(GL_TRUE);
}

}  // namespace spacetime::gui
