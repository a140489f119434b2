// The question as it stands now: the scene's statements after the edits of the log, for tables and timelines.  The
// optimizer keeps its own account of this; here it is worked out again from the problem alone, so that what is shown
// never waits for an answer.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "gui/key_marks.h"
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
  bool rescoped = false;  // since it was written
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
  std::vector<KeyMark> keys;
};

// "arm" of "arm.elbow" and of "arm.elbow.force"; names without a dot stand for themselves.
std::string creature_of(const std::string& name);

bool is_among(const std::vector<std::string>& names, const std::string& name);

// Of the present entry.
Question question_of(const State& state);

// A number that may follow from constants; nothing where it is no finite number with these.
std::optional<double> value_of(const Quantity& quantity, const Problem& problem,
                               const std::map<std::string, double>& constants);

// How a statement's scope is written from `over` on, with its ends where they are given in place of its own:
// "over [0, release] every 0.1".  A scope that was restated since has numbers only.
std::string scope_text(const Equation& equation, const Problem& problem, const std::map<std::string, double>& constants,
                       std::optional<double> from, std::optional<double> to);

// The times at which a statement with this scope is sampled; on the knots those of the finest of the motion's degrees
// of freedom.  Empty for statements without time, and where a constant has made the scope impossible: the optimizer
// says so where it was set.
std::vector<double> times_of(const Scope& scope, const Problem& problem, const std::map<std::string, double>& constants,
                             const std::vector<Trajectory>& dofs);

}  // namespace spacetime::gui
