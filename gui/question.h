// The question as it stands now: the scene's statements after the edits of the log, for tables and timelines.  The
// optimizer keeps its own account of this; here it is worked out again from the problem alone, so that what is shown
// never waits for an answer.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "gui/state.h"

namespace spacetime::gui {

struct Equation {
  std::string name;
  std::string text;  // the statement as written
  bool objective = false;
  bool named = true;  // by the scene: only then can it be edited
  bool enabled = true;
  std::optional<double> weight;  // absent: hard
  Scope scope;
  int line = 0;
  Constraint::Relation relation = Constraint::Relation::equal;
  std::string program;
  bool conditional = false;
};

struct Freedom {
  std::string name;
  bool in_window = true;
  std::optional<double> lower, upper;
  std::optional<double> damping;  // the most a coefficient may change in an iteration
};

struct Question {
  std::vector<Equation> equations;  // constraints, then objective terms; deleted and not yet declared ones left out
  std::vector<Freedom> dofs;
  std::optional<std::pair<double, double>> window;  // absent: all of the time
  std::map<std::string, double> constants;
};

Question question_of(const Scene& scene);

// A number that may follow from constants.
double value_of(const Quantity& quantity, const Problem& problem, const std::map<std::string, double>& constants);

// The times at which a statement with this scope is sampled.  For scopes on the knots `basis` is the finest one of the
// motion.  Empty for statements without time.
std::vector<double> times_of(const Scope& scope, const Problem& problem, const std::map<std::string, double>& constants,
                             const Basis& basis);

}  // namespace spacetime::gui
