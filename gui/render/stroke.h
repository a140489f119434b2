// Lines, arrows and marks as triangles in the plane of the picture, with what their smooth edges need.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gui/render/camera.h"
#include "gui/render/picture.h"

namespace spacetime::gui {

// How the shader finds a pixel's share of a stroke.
enum class Edge { line, disc, ring, cross, plain };

struct StrokeVertex {
  glm::vec3 at;      // normalised device coordinates
  glm::vec4 colour;  // with opacity
  glm::vec4 edge;    // the kind of Edge; line: pixels across, half the width, pixels along (-1: not dashed);
                     // disc, ring, cross: pixels from the centre, radius
};
using Strokes = std::vector<StrokeVertex>;  // three a triangle

void add(Strokes& strokes, const Line& line, const Camera& camera, const glm::vec2& size);
void add(Strokes& strokes, const Arrow& arrow, const Camera& camera, const glm::vec2& size);
void add(Strokes& strokes, const Torque& torque, const Camera& camera, const glm::vec2& size);
void add(Strokes& strokes, const Mark& mark, const Camera& camera, const glm::vec2& size, Theme theme);

}  // namespace spacetime::gui
