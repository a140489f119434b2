// A problem: everything the optimizer needs to know about a scene, in plain values.  The symbolic side writes it,
// protocol/problem_json turns it into a document and back.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/action.h"
#include "common/program.h"
#include "common/quantity.h"

namespace spacetime {

struct Constant {
  std::string name;
  Quantity value;  // may depend on constants declared before it
  Place place;
  std::optional<Place> frozen{};  // where `time`, `trajectory`, `count` or a joint uses it, so that it cannot be set
  bool operator==(const Constant&) const = default;
};

// The clamped cubic B-spline basis: knots with their multiplicity (first and last four times), n coefficients for
// n + 4 knots.
struct Basis {
  std::vector<double> knots;
  int size() const { return static_cast<int>(knots.size()) - 4; }
  bool operator==(const Basis&) const = default;
};

// One unknown number, chosen along with the motion.
struct Parameter {
  std::string name;
  Quantity start;
  Place place;
  std::optional<Quantity> lower{}, upper{};
  bool operator==(const Parameter&) const = default;
};

struct Dof {
  std::string name;
  Basis basis;
  Quantity start;
  Place place;
  std::optional<Quantity> lower{}, upper{};  // kept by the coefficients, so that they hold at every time
  bool operator==(const Dof&) const = default;
};

// One number made from expressions in time: an integral, or a value at one time.
struct Functional {
  enum class Kind { integral, at } kind = Kind::integral;
  std::string program;
  int output = 0;
  std::optional<Quantity> from, to;  // integral: its ends (the whole time where absent); at: `from` is the time
  bool operator==(const Functional&) const = default;
};

// `when`: an instance counts only while this output is not 0.
struct Condition {
  std::string program;
  int output = 0;
  bool operator==(const Condition&) const = default;
};

struct Constraint {
  enum class Relation {
    equal,    // each value is to be 0
    at_most,  // each value is to be at most 0; `>=` has its sides exchanged, a chain has the values of both halves
  };
  std::string name;     // given, or "constraint 3"
  std::string program;  // its values are the residual's components: left side minus right side
  Scope scope;
  std::optional<Quantity> weight;  // absent: hard.  Soft: adds weight/2 * r^2 for each instance and component
  Place place;
  Relation relation = Relation::equal;
  std::optional<Condition> condition{};
  int since = 0;             // takes effect before this action (an index into Problem::actions); 0: from the start
  bool replacement = false;  // takes effect through an action `replace` alone
  bool operator==(const Constraint&) const = default;
};

// An objective term is its weight times the sum of its pieces.  Integrals over the same time of terms sampled alike
// share one program; `output` tells which value is this term's.
struct Piece {
  enum class Kind {
    integral,  // of output over [from, to], or the whole time
    at,        // output at the time `from`
    once,      // output, a function of functionals, parameters and constants alone
  } kind = Kind::integral;
  std::string program;
  int output = 0;
  std::optional<Quantity> from, to;
  bool operator==(const Piece&) const = default;
};
struct Term {
  std::string name;  // given, or "objective 1"
  Quantity weight{1, {}, 0};
  std::vector<Piece> pieces;
  Place place;
  int since = 0;  // as a constraint's
  bool replacement = false;
  bool operator==(const Term&) const = default;
};

struct Keyframe {
  Quantity time;
  std::vector<Key> keys;
  Place place;
  int since = 0;  // as a constraint's: part of the sketch that `reset` returns to from there on
  bool operator==(const Keyframe&) const = default;
};

// A named expression that can be sampled and plotted: these outputs of this program.
struct Plot {
  std::string name;
  std::string program;
  std::vector<int> outputs;  // one for a scalar, one a component for a tuple
  bool operator==(const Plot&) const = default;
};

// A shape carried by a moving frame.  Outputs of the pose program: the 3x4 matrix [R | p] by rows, world from link.
struct Body {
  enum class Shape { capsule, sphere, box, none } shape = Shape::none;
  std::string name;
  std::vector<Quantity> size;  // capsule: radius, then the segment's other end x y z in the link's frame; sphere:
                               // radius; box: x y z edges
  std::string program;
  std::vector<int> outputs;  // twelve
  bool operator==(const Body&) const = default;
};

struct PlacedAction {
  Action action;
  Place place;
  bool operator==(const PlacedAction&) const = default;
};

struct Problem {
  double start = 0, end = 1;  // the animation's time span, seconds
  std::vector<Constant> constants;
  std::vector<Parameter> parameters;
  std::vector<Dof> dofs;
  std::map<std::string, Program> programs;  // by hash
  std::vector<Functional> functionals;      // each may use those before it
  std::vector<Constraint> constraints;
  std::vector<Term> objective;
  std::vector<Keyframe> keyframes;
  std::vector<Plot> plots;
  std::vector<Body> bodies;
  std::vector<PlacedAction> actions;
  bool operator==(const Problem&) const = default;
};

}  // namespace spacetime
