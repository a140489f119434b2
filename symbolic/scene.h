// The syntax tree of a scene: plain values, each with its place in the text.  The whole language is here, including
// what later stages do not accept yet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/diagnostic.h"

namespace spacetime::symbolic {

using NodeId = std::uint32_t;  // index into Scene::nodes

// A node of an expression.  Nodes stand in post-order: operands before what uses them, and a whole expression is the
// unbroken run first..its own index, so that passes are loops and never recursions.
struct Node {
  enum class Kind : std::uint8_t {
    missing,  // where the parser gave up
    number,
    name,
    member,  // 1.5, shoulder, (operand).text
    prime,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    call,
    tuple,
    list,  // text(operands), (a, b), [a, b]
    less,
    less_equal,
    greater,
    greater_equal,
    logical_and,
    logical_or,
    logical_not,
  } kind = Kind::missing;
  Span span;  // all of it, as far as it stands on its first line
  Span mark;  // the operator or the name that makes it
  double number = 0;
  std::string text;  // name, member, call
  std::vector<NodeId> operands;
  NodeId first = 0;  // lowest index in this expression
};

struct Name {
  std::string text;  // a dotted one as it would be written: "arm.elbow"
  Span span;
};

struct Interval {  // [from, to]
  NodeId from = 0, to = 0;
  Span span;
};

// Declarations.
struct TimeDeclaration {
  Interval time;
};
struct ConstantDeclaration {
  Name name;
  NodeId value = 0;
};
struct ParameterDeclaration {
  Name name;
  NodeId start = 0;
  std::optional<Interval> bounds;
};
struct TrajectoryDeclaration {
  enum class Kind { spans, knots, wavelet } kind = Kind::spans;
  NodeId argument = 0;      // N, a list node, L
  std::vector<Name> names;  // after `for`; none: what is declared from here on
};
struct DofDeclaration {
  Name name;
  std::optional<NodeId> start;
  std::optional<Interval> bounds;
};
struct LetDeclaration {
  Name name;
  NodeId value = 0;
};
struct DefineDeclaration {
  Name name;
  std::vector<Name> parameters;
  NodeId value = 0;
};
struct EliminateDeclaration {
  Name dof;
  NodeId value = 0;
};

struct LinkItem {
  enum class Kind {
    revolute,
    prismatic,
    fixed,
    offset,
    a,
    alpha,
    d,
    theta,
    axis,
    origin,
    mass,
    com,
    inertia,
    rod,
    capsule,
    sphere,
    box
  } kind = Kind::fixed;
  Span span;                       // of its word
  Name dof;                        // revolute, prismatic
  std::optional<NodeId> value;     // a joint's start, or the item's argument
  std::optional<Interval> bounds;  // of a joint
};
struct LinkDeclaration {
  Name name;
  std::optional<Name> parent;
  std::vector<LinkItem> items;
  bool damaged = false;  // some items were lost to mistakes: what seems to be missing is not reported
};
struct PointDeclaration {
  Name name, link;
  NodeId position = 0;
};
struct GravityDeclaration {
  NodeId value = 0;
  Span span;
};
struct ForceDeclaration {
  Name point;
  NodeId value = 0;
};
struct CreatureDeclaration {
  Name name;
  std::vector<std::variant<GravityDeclaration, LinkDeclaration, PointDeclaration, ForceDeclaration>> items;
  bool damaged = false;  // some items were lost to mistakes
};

struct PathItem {
  bool through = false;
  NodeId points = 0;
  std::optional<NodeId> knots;
};
struct TravelItem {
  enum class Kind { keys, control, constant } kind = Kind::constant;
  std::optional<NodeId> points, knots, speed;
  bool relative = false;
};
struct OrientItem {
  std::optional<NodeId> keys, up;
};  // one of them
struct ScriptDeclaration {
  Name name;
  std::vector<std::variant<PathItem, TravelItem, OrientItem>> items;
  bool damaged = false;  // some items were lost to mistakes
};

struct ScopeClause {
  enum class Kind { at, every, count, knots } kind = Kind::at;
  Span span;
  std::vector<NodeId> times;  // at
  Interval interval;          // the others
  NodeId argument = 0;        // every, count
};
struct WeightClause {
  std::optional<NodeId> value;
  Span span;
};  // no value: inf
struct Relation {
  enum class Kind { equal, less_equal, greater_equal } kind = Kind::equal;
  NodeId left = 0, right = 0;
  std::optional<NodeId> third;  // left kind right kind third
  Span span;
};
struct ConstrainDeclaration {
  std::optional<Name> name;
  Relation relation;
  std::optional<ScopeClause> scope;
  std::optional<NodeId> when;
  std::optional<WeightClause> weight;
};
struct MinimizeDeclaration {
  std::optional<Name> name;
  NodeId value = 0;
  std::optional<WeightClause> weight;
};
struct Assignment {
  NodeId target = 0, value = 0;
};
struct KeyframeDeclaration {
  NodeId time = 0;
  std::vector<Assignment> keys;
};

// Actions.
struct SolveAction {
  std::optional<Name> method;
  bool conjugate_gradient = false;  // sqp92 linear cg
  std::optional<NodeId> iterations, tolerance, starts;
};
struct IterateAction {
  NodeId count = 0;
};
struct WindowAction {
  std::optional<Interval> time;
  std::vector<Name> names;
};  // no time: all
struct RefineAction {
  std::optional<Interval> time;
  std::vector<Name> names;
  std::optional<NodeId> times, tolerance;  // tolerance: refine auto
};
struct ShakeAction {
  NodeId amplitude = 0;
  std::optional<NodeId> seed;
  std::vector<Name> names;
};
struct FilterAction {
  NodeId strength = 0;
  std::vector<Name> names;
};
struct DampAction {
  NodeId limit = 0;
  std::vector<Name> names;
};
struct AdaptAction {
  NodeId tolerance = 0;
  std::optional<NodeId> levels;
};
struct LockAction {
  NodeId level = 0;
};
struct SetAction {
  Name constant;
  NodeId value = 0;
};
struct WeightAction {
  Name name;
  WeightClause weight;
};
struct ToggleAction {
  enum class Kind { enable, disable, remove } kind = Kind::enable;
  Name name;
};
struct ReplaceAction {
  Name name;
  std::variant<ConstrainDeclaration, MinimizeDeclaration> by;
};
struct ScopeAction {
  Name name;
  ScopeClause scope;
};
struct BoundAction {
  Name dof;
  Interval bounds;
};
struct KeyAction {
  NodeId time = 0;
  std::vector<Assignment> keys;
};
struct ControlAction {
  Name dof;
  NodeId index = 0, value = 0;
};
struct ResetAction {};

// A statement with mistakes in it: all that is known is what it would have declared.
struct Damaged {
  std::optional<Name> name;
  std::optional<Name> statement;  // a constraint's or an objective term's own name
};

struct Statement {
  Span span;                       // its first word
  std::string word;                // the same as text
  std::size_t begin = 0, end = 0;  // all of it, in bytes of the text
  std::variant<Damaged, TimeDeclaration, ConstantDeclaration, ParameterDeclaration, TrajectoryDeclaration,
               DofDeclaration, LetDeclaration, DefineDeclaration, EliminateDeclaration, CreatureDeclaration,
               ScriptDeclaration, ConstrainDeclaration, MinimizeDeclaration, KeyframeDeclaration, SolveAction,
               IterateAction, WindowAction, RefineAction, ShakeAction, FilterAction, DampAction, AdaptAction,
               LockAction, SetAction, WeightAction, ToggleAction, ReplaceAction, ScopeAction, BoundAction, KeyAction,
               ControlAction, ResetAction>
      what;
};

struct Scene {
  std::vector<Node> nodes;
  std::vector<Statement> statements;
};

}  // namespace spacetime::symbolic
