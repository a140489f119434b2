// The programs that run on the graphics card, GLSL 3.30.
#pragma once

namespace spacetime::gui::shaders {

// How much of the key light reaches a place: the share of samples on a disc about its spot in the shadow map that are
// not behind what the map saw.
inline constexpr const char* shadow = R"(
uniform sampler2DShadow shadow_map;
uniform mat4 light_matrix;
uniform float softness;  // radius of the disc in the map
uniform int shadow_samples;
const vec2 disc[16] = vec2[](vec2(-0.94, -0.34), vec2(0.94, -0.33), vec2(-0.09, -0.93), vec2(0.34, 0.29),
                             vec2(-0.81, 0.52), vec2(0.44, -0.76), vec2(-0.38, 0.28), vec2(0.79, 0.55),
                             vec2(-0.26, -0.42), vec2(0.19, 0.92), vec2(-0.52, -0.77), vec2(0.45, -0.13),
                             vec2(-0.32, 0.86), vec2(0.07, -0.06), vec2(-0.66, 0.02), vec2(0.16, -0.48));
float lit(vec3 place) {
  vec3 at = (light_matrix * vec4(place, 1.0)).xyz * 0.5 + 0.5;
  if (any(lessThan(at, vec3(0.0))) || at.x > 1.0 || at.y > 1.0) return 1.0;
  at.z = min(at.z, 1.0);
  if (shadow_samples == 1) return texture(shadow_map, at);
  float sum = 0.0;
  for (int k = 0; k < 16; ++k) sum += texture(shadow_map, vec3(at.xy + softness * disc[k], at.z));
  return sum / 16.0;
}
)";

inline constexpr const char* solid_vertex = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 normal;
layout(location = 2) in float far;
uniform mat4 pose, matrix;
uniform vec3 scale;
uniform float reach;
out vec3 place, n;
void main() {
  vec4 world = pose * vec4(at * scale + vec3(0.0, 0.0, reach * far), 1.0);
  place = world.xyz;
  n = mat3(pose) * normal;
  gl_Position = matrix * world;
}
)";

// A matte surface under one key light, a sky and what the ground throws back.
inline constexpr const char* solid_fragment = R"(
in vec3 place, n;
uniform vec3 colour, to_light, eye, sky, earth;
uniform vec3 towards;  // the eye, where the view is orthographic; else 0
uniform float opacity, bias;
out vec4 result;
float lit(vec3 place);
void main() {
  vec3 normal = normalize(n);
  vec3 view = towards == vec3(0.0) ? normalize(eye - place) : towards;
  float facing = dot(normal, to_light);
  float key = facing > 0.0 ? facing * lit(place + bias * normal) : 0.0;
  vec3 ambient = mix(earth, sky, 0.5 + 0.5 * normal.y);
  vec3 light = ambient + 0.62 * vec3(1.0, 0.98, 0.94) * key;
  float gloss = 0.10 * pow(max(dot(normal, normalize(to_light + view)), 0.0), 36.0) * min(key * 4.0, 1.0);
  float rim = 0.07 * pow(1.0 - max(dot(normal, view), 0.0), 3.0);
  vec3 linear = pow(colour, vec3(2.2)) * light + gloss + rim * sky;
  result = vec4(pow(linear, vec3(1.0 / 2.2)), opacity);
}
)";

inline constexpr const char* depth_fragment = "void main() {}\n";

inline constexpr const char* background_vertex = R"(
out float height;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = corner.y * 0.5 + 0.5;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";
inline constexpr const char* background_fragment = R"(
in float height;
uniform vec3 above, below;
out vec4 result;
void main() { result = vec4(mix(below, above, height), 1.0); }
)";

inline constexpr const char* ground_vertex = R"(
uniform mat4 matrix;
uniform vec3 middle, half_size;
out vec3 place;
void main() {
  int k = gl_VertexID < 3 ? gl_VertexID : gl_VertexID - 2;  // two triangles: 0 1 2, 1 2 3
  vec2 corner = vec2(k & 1, k >> 1) * 2.0 - 1.0;
  place = middle + half_size * vec3(corner.x, 0.0, corner.y);
  gl_Position = matrix * vec4(place, 1.0);
}
)";

// A disc that fades into the background, with lines every metre (or a tenth, or ten) that stay one pixel thin and fade
// where they would be dense.
inline constexpr const char* ground_fragment = R"(
in vec3 place;
uniform vec3 centre, colour, grid;
uniform float radius, spacing;
out vec4 result;
float lines(float step) {
  vec2 at = place.xz / step;
  vec2 pixel = fwidth(at);
  vec2 distance = abs(fract(at - 0.5) - 0.5) / max(pixel, vec2(1e-6));
  vec2 line = clamp(1.1 - distance, 0.0, 1.0) * clamp(1.6 - 7.0 * pixel, 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.12, 1.0, length(place.xz - centre.xz) / radius);
  float line = max(0.16 * lines(spacing), 0.42 * lines(10.0 * spacing));
  result = vec4(mix(colour, grid, line), fade);
}
)";

// The shadow on it, drawn over as much of it as can be in shadow: to ask the map for every pixel of the ground takes
// many times as long as all else where there is no graphics card.
inline constexpr const char* shade_fragment = R"(
in vec3 place;
uniform vec3 centre;
uniform float radius, shade;
out vec4 result;
float lit(vec3 place);
void main() {
  float fade = 1.0 - smoothstep(0.12, 1.0, length(place.xz - centre.xz) / radius);
  result = vec4(0.0, 0.0, 0.0, fade * shade * (1.0 - lit(place)));
}
)";

inline constexpr const char* stroke_vertex = R"(
layout(location = 0) in vec3 at;
layout(location = 1) in vec4 colour_in;
layout(location = 2) in vec4 edge_in;
out vec4 colour, edge;
void main() {
  colour = colour_in;
  edge = edge_in;
  gl_Position = vec4(at, 1.0);
}
)";
inline constexpr const char* stroke_fragment = R"(
in vec4 colour, edge;
out vec4 result;
float inside(float distance) { return clamp(0.5 - distance, 0.0, 1.0); }
void main() {
  int kind = int(edge.x + 0.5);
  float share = 1.0;
  if (kind == 0) {
    share = inside(abs(edge.y) - edge.z);
    if (edge.w >= 0.0) {
      float period = 6.0 * max(edge.z, 1.0);
      share *= inside(abs(mod(edge.w, period) - 0.5 * period) - 0.28 * period);
    }
  } else if (kind < 4) {
    float from = length(edge.yz), thick = max(1.0, 0.11 * edge.w);
    float ring = inside(abs(from - edge.w + thick) - thick);
    if (kind == 1) share = inside(from - edge.w);
    if (kind == 2) share = ring;
    if (kind == 3) {
      vec2 turned = 0.7071 * vec2(edge.y + edge.z, edge.y - edge.z);
      float bar = min(max(abs(turned.x) - thick, abs(turned.y) - 0.62 * edge.w),
                      max(abs(turned.y) - thick, abs(turned.x) - 0.62 * edge.w));
      share = max(ring, inside(bar));
    }
  }
  result = vec4(colour.rgb, colour.a * share);
}
)";

}  // namespace spacetime::gui::shaders
