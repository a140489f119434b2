// A scene being given its meaning: names, expressions over one graph, and the problem as it grows.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/diagnostic.h"
#include "common/problem.h"
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
  enum class Kind { constant, dof, let, creature, lost } kind = Kind::lost;
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

struct Model {
  Model(const Scene& of, std::vector<Diagnostic>& to) : scene(of), diagnostics(to) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  const Scene& scene;
  std::vector<Diagnostic>& diagnostics;
  Graph graph;
  Facts facts{graph};
  Fingerprints fingerprints{graph};
  Problem problem;

  std::map<std::string, Symbol, std::less<>> symbols;
  std::map<std::string, Span, std::less<>> later;            // every declaration of the scene, for advice
  std::map<std::string, Span, std::less<>> statement_names;  // of constraints and objective terms
  std::vector<std::string> lets;                             // in order
  std::vector<Creature> creatures;

  std::optional<Span> time;  // where the `time` statement is
  bool time_known = false;   // it has been understood
  std::vector<TimeCheck> time_checks;
  std::vector<Trajectories> trajectories;
  int trajectory = -1;              // the one that new degrees of freedom take
  std::vector<int> dof_trajectory;  // by degree of freedom
  std::vector<Span> dof_span;
  std::map<std::string, int, std::less<>> dof_index;

  std::vector<FunctionalUse> functionals;
  std::map<FunctionalUse, int> functional_index;
  std::vector<int> placed;  // by functional: its index in problem.functionals, or -1
  std::vector<PendingIntegral> integrals;
  std::map<std::pair<std::string, double>, Span> keyed;

  std::optional<Span> first_action;
  bool misplaced = false;  // a declaration after the first action has been reported

  double differentiate_milliseconds = 0, emit_milliseconds = 0;
};

void report(Model& model, const Span& span, std::string message, std::vector<Diagnostic::Note> notes = {});
inline Place place_of(const Span& span) { return {span.line, span.column}; }

// The program of these values, kept in the problem; its key there.  Nothing is emitted once there are mistakes.
std::string add_program(Model& model, std::span<const Expr> values, Derivatives derivatives);

}  // namespace spacetime::symbolic
