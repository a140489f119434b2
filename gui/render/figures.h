// The figures of a scene along its motions: bodies where their poses put them, points where numbers do.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/evaluate.h"
#include "common/motion.h"
#include "common/problem.h"
#include "gui/render/picture.h"

namespace spacetime::gui {

// What can be drawn of a scene: made once, used for all its motions.
//
// Drawn are the problem's bodies.  Degrees of freedom of no creature that are named as coordinates are (x, y and z; or
// with a common beginning, as in catX and catY; or with a common number, as in x1 and y1) are drawn as a bead at that
// place; all others, where there would be nothing else to draw, as beads that slide along x, one behind the other.
class Figures {
 public:
  explicit Figures(const Problem& problem);
  explicit Figures(const Motion& motion);  // what the motion carries: no named expressions but those it has sampled

  bool empty() const { return parts_.empty(); }
  std::size_t size() const { return parts_.size(); }                    // of what is drawn; a solid's id is below it
  const std::string& name(int id) const { return parts_.at(id).name; }  // "arm.fore", or a bead's
  Colour colour(int id, Theme theme) const;

  // The poses of all parts, one row a time (s, within the motion's span).
  std::vector<std::vector<glm::mat4>> poses(const Motion& motion, std::span<const double> times) const;

  std::vector<Solid> solids(const Motion& motion, double time, Theme theme) const;
  // The figure at some times, each a layer of its own above those before (picture.h), paler the earlier it is, from
  // `faintest` to 1.
  std::vector<Solid> ghosts(const Motion& motion, std::span<const double> times, Theme theme,
                            float faintest = 0.15F) const;

  // Whose ways can be drawn: parts, creatures (of which the last part counts), and named expressions of two or three
  // components, but for creatures' forces.
  std::vector<std::string> points() const;
  // The way of one of them; throws InputError for a name that is none.
  std::vector<glm::vec3> way(const Motion& motion, const std::string& point, std::span<const double> times) const;
  Colour colour_of_point(const std::string& point, Theme theme) const;

  // All places that the figures take during the motion.
  Box bounds(const Motion& motion) const;

 private:
  struct Part {
    std::string name;
    int series = 0;                     // of colours: its creature's
    int rank = 0;                       // among its creature's
    const Body* body = nullptr;         // or a bead
    std::array<std::string, 3> dofs{};  // of a bead: x, y, z; empty where it stays
    float behind = 0;                   // m, of a bead
  };
  void add_bodies();
  void add_beads(const std::vector<std::string>& dofs);
  int series_of(const std::string& name);
  const Evaluator& evaluator(const std::string& program) const { return evaluators_.at(program); }
  Solid solid(const Motion& motion, std::size_t part, const glm::mat4& pose, Theme theme) const;
  double number(const Motion& motion, const Quantity& quantity) const;

  std::vector<Body> bodies_;
  std::vector<Plot> plots_;  // of two or three components
  std::map<std::string, Program> programs_;
  std::map<std::string, Evaluator> evaluators_;
  std::map<std::string, int> series_;  // by creature, in the order met
  std::vector<Part> parts_;
};

// Where the ground is: at 0, or beneath what goes lower.
float ground_height(const Box& bounds);

// Whether all that moves stays in a plane that is seen from the front.
bool planar(const Box& bounds);

}  // namespace spacetime::gui
