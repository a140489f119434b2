// Actions: what a scene, or a message, asks the optimizer to do.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/quantity.h"

namespace spacetime {

// Degrees of freedom an action is limited to, by name; all where empty.
using DofNames = std::vector<std::string>;

// Iterate to convergence.
struct Solve {
  enum class Method { newton, sqp92, bfgs };
  std::optional<int> iterations;  // at most; the optimizer's own limit where absent
  double tolerance = 1e-8;        // largest violation in its own units; relative gradient of the Lagrangian
  Method method = Method::newton;
  bool linear_cg = false;  // sqp92 with the paper's least-squares conjugate gradients
  int starts = 1;          // from so many shaken starts, keeping the best
  bool operator==(const Solve&) const = default;
};

// Exactly this many iterations, or fewer where the tolerance is reached; 0 judges the motion without moving it.
struct Iterate {
  int iterations = 1;
  bool operator==(const Iterate&) const = default;
};

// Which part of spacetime is free: all of it where `interval` is absent.
struct Interval {
  Quantity from, to;
  bool operator==(const Interval&) const = default;
};
struct Window {
  std::optional<Interval> interval;
  DofNames dofs;
  bool operator==(const Window&) const = default;
};

// Halve knot spans: those that overlap the interval (all where absent), or where the residual is above a tolerance.
struct Refine {
  std::optional<Interval> interval;
  DofNames dofs;
  int times = 1;
  std::optional<Quantity> automatic;  // the tolerance of `refine auto`
  bool operator==(const Refine&) const = default;
};

struct Shake {
  Quantity amplitude;
  std::optional<int> seed;
  DofNames dofs;
  bool operator==(const Shake&) const = default;
};
struct Smooth {  // the language's `filter`
  Quantity strength;
  DofNames dofs;
  bool operator==(const Smooth&) const = default;
};
struct Damp {
  Quantity limit;
  DofNames dofs;
  bool operator==(const Damp&) const = default;
};
struct Adapt {
  Quantity tolerance;
  std::optional<int> levels;
  bool operator==(const Adapt&) const = default;
};
struct Lock {
  int level = 0;
  bool operator==(const Lock&) const = default;
};
struct SetConstant {
  std::string constant;
  Quantity value;
  bool operator==(const SetConstant&) const = default;
};
struct SetWeight {  // of a constraint or an objective term; absent: `inf`, a hard constraint
  std::string name;
  std::optional<Quantity> weight;
  bool operator==(const SetWeight&) const = default;
};
struct Enable {
  std::string name;
  bool operator==(const Enable&) const = default;
};
struct Disable {
  std::string name;
  bool operator==(const Disable&) const = default;
};
struct Delete {
  std::string name;
  bool operator==(const Delete&) const = default;
};
// The statement `with` (in Problem::constraints or Problem::objective, marked as a replacement) takes the place of
// `name`.
struct Replace {
  std::string name;
  int with = 0;
  bool operator==(const Replace&) const = default;
};
struct Rescope {  // the language's `scope`
  std::string name;
  Scope scope;
  bool operator==(const Rescope&) const = default;
};
struct Bound {
  std::string dof;
  Quantity lower, upper;
  bool operator==(const Bound&) const = default;
};
struct Key {
  std::string dof;
  Quantity value;
  bool operator==(const Key&) const = default;
};
struct PullKeys {  // the language's `key`
  Quantity time;
  std::vector<Key> keys;
  bool operator==(const PullKeys&) const = default;
};
struct Control {
  std::string dof;
  int index = 0;  // of the coefficient, from 0
  Quantity value;
  bool operator==(const Control&) const = default;
};
struct Reset {
  bool operator==(const Reset&) const = default;
};

using Action = std::variant<Solve, Iterate, Window, Refine, Shake, Smooth, Damp, Adapt, Lock, SetConstant, SetWeight,
                            Enable, Disable, Delete, Replace, Rescope, Bound, PullKeys, Control, Reset>;

// The language's words for actions, in the order of Action's alternatives.
std::span<const std::string_view> action_names();
std::string_view name_of(const Action& action);

}  // namespace spacetime
