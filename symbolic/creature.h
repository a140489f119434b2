// Creatures: linkages with names.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/diagnostic.h"
#include "common/problem.h"
#include "symbolic/mechanics.h"
#include "symbolic/scene.h"

namespace spacetime::symbolic {

struct Model;
struct Value;

struct Joint {
  std::string name;  // without the creature's
  int link = 0;
  int dof = 0;  // in Problem::dofs
  Coordinate coordinate;
};

struct Point {
  std::string name;
  int link = 0;
  Vector3 position;  // in the link's frame
};

// How a link is drawn: its shape, and where the other end of a capsule is, in the link's frame.
struct Drawing {
  Body::Shape shape = Body::Shape::none;
  std::vector<Expr> size;
};

struct Creature {
  std::string name;
  Linkage linkage;
  std::vector<std::string> links;  // names, in the linkage's order
  std::vector<Drawing> drawings;   // one a link
  std::vector<Joint> joints;
  std::vector<Point> points;
  std::map<std::string, Span, std::less<>> members;  // links, degrees of freedom and points
  bool damaged = false;      // mistakes in it may have cost members: unknown ones are not reported
  bool forces_open = false;  // its outside forces are being read, so its joint forces are not known yet

  // Made when first asked for.
  std::optional<std::vector<Frame>> frames;
  std::optional<std::vector<Expr>> forces;
};

// Enters a creature with its degrees of freedom.
void elaborate_creature(Model& model, const CreatureDeclaration& declaration, const Span& span);

// `name` of a creature, or of one of its degrees of freedom where joint >= 0.  The second: whether there is such a
// member or its lack has been reported; false means that `name` may yet be a component (of a degree of freedom).
std::pair<Value, bool> creature_member(Model& model, int creature, int joint, std::string_view name, const Span& span);

std::vector<std::string> member_names(const Creature& creature);

const std::vector<Frame>& frames_of(Model& model, Creature& creature);
const std::vector<Expr>& forces_of(Model& model, Creature& creature);
bool has_mass(Model& model, const Creature& creature);

}  // namespace spacetime::symbolic
