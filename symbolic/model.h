// A scene being given its meaning: names, expressions over one graph, and the problem as it grows.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/diagnostic.h"
#include "common/problem.h"
#include "symbolic/compiler.h"
#include "symbolic/creature.h"
#include "symbolic/emit.h"
#include "symbolic/facts.h"
#include "symbolic/fingerprint.h"
#include "symbolic/graph.h"
#include "symbolic/scene.h"

namespace spacetime::symbolic {

// What an expression means.
struct Value {
  enum class Kind {
    lost,       // something is wrong with it, and has been said
    numbers,    // one component: a scalar; more: a tuple
    condition,  // one component
    creature,   // a whole creature: only its members can be used
  } kind = Kind::lost;
  std::vector<Expr> components;
  int creature = -1;  // creature; or numbers that are ...
  int joint = -1;     // ... one of its degrees of freedom, of which `.force` can be asked
};

struct Symbol {
  enum class Kind { constant, parameter, dof, let, function, creature, lost } kind = Kind::lost;
  Span span;
  Value value;
  bool declared = true;  // false: used before any declaration, and reported
};

// A functional as it is written: the operands of an input that stands for it until a statement finds its place.
struct FunctionalUse {
  Functional::Kind kind = Functional::Kind::integral;
  Expr integrand;
  std::optional<Expr> from, to;
  auto operator<=>(const FunctionalUse&) const = default;
};

// A `trajectory` statement: the basis it asks for, made when the scene's time is known.
struct Trajectories {
  Span span;
  int spans = 0;              // uniform, or ...
  std::vector<double> knots;  // ... at these breakpoints
};

// An integral in the objective, to share a program with those over the same time.
struct PendingIntegral {
  std::optional<Expr> from, to;
  Expr integrand;
  std::size_t term = 0, piece = 0;
};

struct TimeCheck {  // to be made when the scene's time is known
  Span span;
  double time = 0;
  std::string what;
};

struct IntervalCheck {  // the same: whether a window meets the time
  Span span;
  double from = 0, to = 0;
};

struct CoefficientCheck {  // to be made when all bases are known
  Span span;
  std::string dof;
  int index = 0;
};

// A function of the scene's own: its body is given its meaning anew wherever it is called.
struct Defined {
  std::vector<std::string> arguments;
  NodeId body = 0;
  bool lost = false;  // its body is wrong, which has been reported
};

// A constraint or an objective term as actions speak of it.
struct Named {
  Span span;
  bool is_constraint = true;
  bool own_times = false;  // its times stand inside at( ) and integral( )
  bool lost = false;
  std::optional<Span> deleted;
  std::vector<Expr> residuals;  // of a constraint, as they are written
};

// What a constraint or an objective term says, as it is written: its residuals, or what is minimised.
struct Stated {
  std::string name;
  bool is_constraint = true;
  Constraint::Relation relation = Constraint::Relation::equal;
  std::vector<Expr> values;
};

// Where degrees of freedom are keyed, by name and time.
using Keyed = std::map<std::pair<std::string, double>, Span>;

struct Frozen {  // a constant whose value has been built in
  Span span;
  std::string what;
};

struct Model {
  Model(const Scene& of, Programs& known, std::vector<Diagnostic>& to) : scene(of), programs(known), diagnostics(to) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Scene& scene;
  Programs& programs;
  std::vector<Diagnostic>& diagnostics;
  Graph graph;
  Facts facts{graph};
  Fingerprints fingerprints{graph};
  Problem problem;

  std::map<std::string, Symbol, std::less<>> symbols;
  std::map<std::string, Span, std::less<>> later;               // every declaration of the scene, for advice
  std::map<std::string, Named, std::less<>> statement_names;    // of constraints and objective terms
  std::vector<std::pair<std::string, std::vector<Expr>>> lets;  // in order, and what has been eliminated
  std::vector<Creature> creatures;
  std::vector<Stated> stated;      // in order; what has been replaced as it is now
  int constraints = 0, terms = 0;  // declared so far, replacements left out

  std::vector<std::pair<std::string, Expr>> constants;  // what each follows from, in order
  std::set<std::string, std::less<>> set_constants;     // that an action has given a value of their own
  std::map<std::string, Frozen, std::less<>> frozen;
  std::map<Expr, Expr> parameter_starts;  // by input

  std::map<std::string, Defined, std::less<>> functions;
  const std::map<std::string, Value>* arguments = nullptr;  // of the function whose body is being read
  int calls = 0;                                            // how deep they are nested there
  double work = 0;                                          // operations done on expressions so far, about
  bool overworked = false;                                  // ... and that they are too many has been reported

  std::map<std::string, Span, std::less<>> to_eliminate;  // by statements that have not been reached
  std::map<std::string, Span, std::less<>> used;          // of those, where they were used first
  std::map<std::string, Span, std::less<>> eliminated;

  std::optional<Span> time;  // where the `time` statement is
  bool time_known = false;   // it has been understood
  std::vector<TimeCheck> time_checks;
  std::vector<IntervalCheck> interval_checks;
  std::vector<CoefficientCheck> coefficient_checks;
  std::vector<Trajectories> trajectories;
  int trajectory = -1;              // the one that new degrees of freedom take
  std::vector<int> dof_trajectory;  // by degree of freedom
  std::vector<Span> dof_span;
  std::vector<std::optional<Span>> dof_bounds;
  std::map<std::string, int, std::less<>> dof_index;

  std::vector<FunctionalUse> functionals;
  std::map<FunctionalUse, int> functional_index;
  std::vector<int> placed;  // by functional: its index in problem.functionals, or -1
  std::vector<PendingIntegral> integrals;
  Keyed keyed;

  std::optional<Span> first_action;
  bool refined = false;  // by an action: coefficients are as many as the motion says

  bool emits = true;  // programs; false where only expressions are asked for
  Statistics statistics;
};

void report(Model& model, const Span& span, std::string message, std::vector<Diagnostic::Note> notes = {});
inline Place place_of(const Span& span) { return {span.line, span.column}; }

// The program of these values, kept in the problem; its key there.  Nothing is emitted once there are mistakes, or for
// a model that does not emit.
std::string add_program(Model& model, std::span<const Expr> values, Derivatives derivatives);

}  // namespace spacetime::symbolic
