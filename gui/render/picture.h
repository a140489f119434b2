// What is to be seen at one moment, as plain values: no OpenGL, no scene.  Lengths in metres unless they say pixels;
// y is up.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace spacetime::gui {

// sRGB, each from 0 to 1.
struct Colour {
  float red = 0, green = 0, blue = 0;
  bool operator==(const Colour&) const = default;
};
Colour mix(const Colour& a, const Colour& b, float share_of_b);

// 0xrrggbb.
Colour colour_of(unsigned rgb);

enum class Theme { light, dark };

struct Solid {
  enum class Shape { capsule, sphere, box } shape = Shape::sphere;
  float radius = 0.05F;  // of capsule and sphere
  glm::vec3 extent{0};   // capsule: the segment's other end, in the pose's axes; box: its edges
  glm::mat4 pose{1};     // world from the solid's own axes: a rotation and a place
  Colour colour{};
  float opacity = 1;
  int id = -1;    // for picking (figures.h says what it means)
  int layer = 0;  // 0: the figure.  Ghosts are drawn beneath it one after another, from 1 on
};

// Through all points, drawn beneath solids that hide it.
struct Line {
  std::vector<glm::vec3> points{};
  Colour colour{};
  float width = 2;  // pixels
  float opacity = 1;
  bool dashed = false;
};

// A force: always on top.
struct Arrow {
  glm::vec3 from{0}, to{0};
  Colour colour{};
  float width = 3;  // pixels
};

// A torque: an arc about an axis that ends in a head, on top like an arrow.
struct Torque {
  glm::vec3 centre{0}, axis{0, 0, 1};  // axis of any length but 0
  float angle = 0;                     // radians, right-handed about the axis; the arc is at most a turn
  float radius = 0.1F;
  Colour colour{};
  float width = 3;  // pixels
};

// Where a constraint asks for something: on top of all, the same size at any distance.
struct Mark {
  enum class Kind {
    met,       // a disc
    violated,  // a cross in a ring
    soft,      // a ring
    disabled,  // a faint ring
  } kind = Kind::met;
  glm::vec3 place{0};
  float size = 14;  // pixels across
};

struct Picture {
  std::vector<Solid> solids{};
  std::vector<Line> lines{};
  std::vector<Arrow> arrows{};
  std::vector<Torque> torques{};
  std::vector<Mark> marks{};
  bool ground = true;       // with its grid and the solids' shadow
  float ground_height = 0;  // m
  Theme theme = Theme::light;
};

// A box along the axes; empty where low > high.
struct Box {
  glm::vec3 low{1}, high{-1};
  bool empty() const { return low.x > high.x; }
  glm::vec3 centre() const { return 0.5F * (low + high); }
  glm::vec3 size() const { return high - low; }
  void include(const glm::vec3& point);
  void include(const Box& box);
};

Box bounds(const Solid& solid);

// The nearest solid of the figure (ghosts are not hit) along a ray, by its id; -1 for none, or one without an id.
struct Ray {
  glm::vec3 origin, direction;
};
int pick(const Picture& picture, const Ray& ray);

// Of a point from a solid's surface, m; negative inside.
float distance(const Solid& solid, const glm::vec3& point);

}  // namespace spacetime::gui
