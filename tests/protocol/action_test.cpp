// Actions in documents: each with its members, and each of its rules broken once.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <utility>
#include <variant>

#include "protocol/check.h"
#include "protocol/problem_json.h"
#include "tests/protocol/refusal.h"

namespace spacetime {
namespace {

TEST(ActionDocuments, HoldEveryAction) {
  const auto problem = examples::busy_problem();
  const auto fault = validate(problem);
  ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
  const auto read = read_problem(write(problem));
  ASSERT_EQ(read.actions.size(), problem.actions.size());
  for (std::size_t i = 0; i < problem.actions.size(); ++i) {
    EXPECT_EQ(read.actions[i], problem.actions[i]) << i << ", " << name_of(problem.actions[i].action);
  }
  std::set<std::size_t> kinds;
  for (const auto& placed : problem.actions) kinds.insert(placed.action.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Action>);
}

// A drag sets a constant many times a second: what was settled when the problem came is not settled again each time.
TEST(ActionDocuments, OfAProblemThatHasBeenCheckedAreCheckedAlone) {
  auto problem = examples::busy_problem();
  auto& [name, program] = *problem.programs.begin();
  const SetConstant set{problem.constants.front().name, {2, {}, 0}};
  program.value_operations += 1;
  ASSERT_EQ(validate(problem)->path.substr(0, 10), "/programs/");
  EXPECT_FALSE(validate(set, problem));
  EXPECT_EQ(validate(SetConstant{"nobody", {2, {}, 0}}, problem)->path, "/constant");
}

TEST(ActionDocuments, HaveTheAgreedMembers) {
  const auto text = write(examples::busy_problem());
  const auto found = text.substr(text.find(" \"actions\""));
  EXPECT_EQ(found, expand(R"( "actions": [
  {"action": "solve", "iterations": 50, "tolerance": 1e-06, "method": "sqp92", "linear_cg": true, "starts": 3, "line": 10, "column": 1},
  {"action": "iterate", "iterations": 4, "line": 11, "column": 1},
  {"action": "window", "from": 0.25, "to": {"program": "TWICE", "output": 0}, "dofs": ["q"], "line": 12, "column": 1},
  {"action": "window", "line": 13, "column": 1},
  {"action": "refine", "from": 0, "to": 1, "dofs": ["q"], "times": 2, "line": 14, "column": 1},
  {"action": "refine", "tolerance": 0.001, "line": 15, "column": 1},
  {"action": "shake", "amplitude": 0.1, "seed": 7, "dofs": ["q", "p"], "line": 16, "column": 1},
  {"action": "filter", "strength": 0.5, "dofs": ["q"], "line": 17, "column": 1},
  {"action": "damp", "limit": {"program": "TWICE", "output": 0}, "dofs": ["p"], "line": 18, "column": 1},
  {"action": "adapt", "tolerance": 1e-04, "levels": 3, "line": 19, "column": 1},
  {"action": "lock", "level": 2, "line": 20, "column": 1},
  {"action": "set", "constant": "g", "value": {"program": "TWICE", "output": 0}, "line": 21, "column": 1},
  {"action": "weight", "name": "goal", "weight": 5, "line": 22, "column": 1},
  {"action": "weight", "name": "goal", "line": 23, "column": 1},
  {"action": "weight", "name": "energy", "weight": {"program": "TWICE", "output": 0}, "line": 24, "column": 1},
  {"action": "disable", "name": "goal", "line": 25, "column": 1},
  {"action": "enable", "name": "energy", "line": 26, "column": 1},
  {"action": "replace", "name": "goal", "with": 1, "line": 27, "column": 1},
  {"action": "replace", "name": "energy", "with": 1, "line": 28, "column": 1},
  {"action": "scope", "name": "goal", "scope": {"kind": "every", "from": 0, "to": 2, "step": {"program": "TWICE", "output": 0}}, "line": 29, "column": 1},
  {"action": "bound", "dof": "q", "lower": -1, "upper": {"program": "TWICE", "output": 0}, "line": 30, "column": 1},
  {"action": "key", "time": 1, "keys": [{"dof": "q", "value": 0.5}, {"dof": "p", "value": {"program": "TWICE", "output": 0}}], "line": 31, "column": 1},
  {"action": "control", "dof": "p", "index": 3, "value": -0.5, "line": 32, "column": 1},
  {"action": "delete", "name": "late", "line": 33, "column": 1},
  {"action": "reset", "line": 34, "column": 1},
  {"action": "solve"},
  {"action": "refine"},
  {"action": "shake", "amplitude": 0},
  {"action": "filter", "strength": 0},
  {"action": "damp", "limit": 1},
  {"action": "adapt", "tolerance": {"program": "TWICE", "output": 0}}
 ]
}
)"));
}

TEST(ActionsRefuse, WrongForms) {
  expect_refusals(
      write(examples::busy_problem()),
      {
          {"/actions/0/action", R"("dance")", nullptr, R"("key", "control" or "reset", found "dance")"},
          {"/actions/0/action", none, "/actions/0", R"(the member "action" is missing)"},
          {"/actions/0/iterations", "-3", nullptr, "expected an integer of at least 0, found -3"},
          {"/actions/0/tolerance", R"("small")", nullptr, R"(expected a number, found "small")"},
          {"/actions/0/method", R"("simplex")", nullptr, R"(expected "newton", "sqp92" or "bfgs", found "simplex")"},
          {"/actions/0/linear_cg", "1", nullptr, "expected true or false, found 1"},
          {"/actions/0/starts", "0", nullptr, "expected an integer from 1 to 10000, found 0"},
          {"/actions/0/starts", "10001", nullptr, "expected an integer from 1 to 10000, found 10001"},
          {"/actions/0/level", "1", nullptr, "unknown member"},
          {"/actions/1/iterations", none, "/actions/1", R"(the member "iterations" is missing)"},
          {"/actions/1/tolerance", "1", nullptr, "unknown member"},
          {"/actions/2/from", none, "/actions/2", R"(the member "from" is missing)"},
          {"/actions/2/to", none, "/actions/2", R"(the member "to" is missing)"},
          {"/actions/2/from", "null", nullptr, "found null"},
          {"/actions/2/dofs", "[]", nullptr, "expected at least one name, found a list of 0"},
          {"/actions/2/dofs", R"("q")", nullptr, R"(expected a list, found "q")"},
          {"/actions/2/dofs/0", "0", nullptr, "expected a string, found 0"},
          {"/actions/3/times", "1", nullptr, R"(known here: "action", "from", "to", "dofs", "line" or "column")"},
          {"/actions/4/to", none, "/actions/4", R"(the member "to" is missing)"},
          {"/actions/4/times", "0", nullptr, "expected an integer from 1 to 52, found 0"},
          {"/actions/4/times", "53", nullptr, "expected an integer from 1 to 52, found 53"},
          {"/actions/5/tolerance", "true", nullptr, "found true"},
          {"/actions/6/amplitude", none, "/actions/6", R"(the member "amplitude" is missing)"},
          {"/actions/6/seed", "-1", nullptr, "expected an integer of at least 0, found -1"},
          {"/actions/6/seed", "2147483648", nullptr, "expected an integer of at least 0"},
          {"/actions/7/strength", R"("strong")", nullptr, R"(found "strong")"},
          {"/actions/8/limit", none, "/actions/8", R"(the member "limit" is missing)"},
          {"/actions/9/tolerance", none, "/actions/9", R"(the member "tolerance" is missing)"},
          {"/actions/9/levels", "1.5", nullptr, "found 1.5"},
          {"/actions/10/level", "-1", nullptr, "expected an integer of at least 0, found -1"},
          {"/actions/11/value", none, "/actions/11", R"(the member "value" is missing)"},
          {"/actions/11/name", R"("g")", nullptr, R"(known here: "action", "constant", "value", "line" or "column")"},
          {"/actions/12/weight", R"("inf")", nullptr, R"(found "inf")"},
          {"/actions/13/name", none, "/actions/13", R"(the member "name" is missing)"},
          {"/actions/15/weight", "1", nullptr, R"(known here: "action", "name", "line" or "column")"},
          {"/actions/17/with", none, "/actions/17", R"(the member "with" is missing)"},
          {"/actions/17/with", R"("goal")", nullptr, R"(found "goal")"},
          {"/actions/19/scope", none, "/actions/19", R"(the member "scope" is missing)"},
          {"/actions/19/scope/step", none, "/actions/19/scope", R"(the member "step" is missing)"},
          {"/actions/19/scope/count", "3", nullptr, "unknown member"},
          {"/actions/20/lower", none, "/actions/20", R"(the member "lower" is missing)"},
          {"/actions/21/keys", "{}", nullptr, "expected a list, found an object"},
          {"/actions/21/keys/0/time", "1", nullptr, R"(known here: "dof" or "value")"},
          {"/actions/22/index", "-1", nullptr, "expected an integer of at least 0, found -1"},
          {"/actions/24/name", R"("q")", nullptr, R"(known here: "action", "line" or "column")"},
          {"/actions/24/line", "0", nullptr, "expected an integer of at least 1, found 0"},
      },
      [](const std::string& text) { return read_problem(text); });
}

TEST(ActionsRefuse, WhatMeansNothing) {
  const auto* const no_dof = R"(there is no degree of freedom "r")";
  const auto* const no_statement = R"(there is no constraint or term of the objective "nobody")";
  expect_refusals(
      write(examples::busy_problem()),
      {
          {"/actions/0/tolerance", "0", nullptr, "must be positive"},
          {"/actions/0/method", R"("newton")", "/actions/0/linear_cg", R"(belongs to the method "sqp92" alone)"},
          {"/actions/2/from", "2.5", nullptr, "this window does not meet the problem's time"},
          {"/actions/2/to", "-0.5", nullptr, "is before its start"},
          {"/actions/2/to", R"({"program": "GOAL", "output": 0})", "/actions/2/to/program", "constants alone"},
          {"/actions/2/dofs/0", R"("r")", nullptr, no_dof},
          {"/actions/4/from", "1.25", "/actions/4/to", "is before its start"},
          {"/actions/4/dofs/0", R"("goal")", nullptr, R"(there is no degree of freedom "goal")"},
          {"/actions/4/tolerance", "1", "/actions/4/from", "it chooses the spans"},
          {"/actions/5/tolerance", "0", nullptr, "must be positive"},
          {"/actions/6/amplitude", "-0.5", nullptr, "must not be negative"},
          {"/actions/6/dofs/1", R"("r")", nullptr, no_dof},
          {"/actions/7/strength", "-0.5", nullptr, "must not be negative"},
          {"/actions/7/dofs/0", R"("r")", nullptr, no_dof},
          {"/actions/8/limit", "0", nullptr, "must be positive"},
          {"/actions/8/dofs/0", R"("")", nullptr, "there is no degree of freedom"},
          {"/actions/9/tolerance", "-1", nullptr, "must be positive"},
          {"/actions/11/constant", R"("G")", nullptr, R"(there is no constant "G")"},
          {"/actions/11/constant", R"("q")", nullptr, R"(there is no constant "q")"},
          {"/actions/11/constant", R"("spans")", nullptr,
           R"("spans" cannot be set: line 5 uses it where only a new problem can change it)"},
          {"/actions/11/constant", R"("count")", nullptr, R"("count" cannot be set: the problem uses it)"},
          {"/actions/11/value/output", "1", nullptr, "there is no 1"},
          {"/actions/12/weight", "-1", nullptr, "must not be negative"},
          {"/actions/12/name", R"("nobody")", nullptr, no_statement},
          {"/actions/13/name", R"("energy")", "/actions/13", "only a constraint can be made hard"},
          {"/actions/14/weight", none, "/actions/14", "only a constraint can be made hard"},
          {"/actions/14/weight/output", "2", nullptr, "there is no 2"},
          {"/actions/15/name", R"("nobody")", nullptr, no_statement},
          {"/actions/16/name", R"("g")", nullptr, R"(there is no constraint or term of the objective "g")"},
          {"/actions/23/name", R"("nobody")", nullptr, no_statement},
          {"/constraints/2/since", "24", "/actions/23/name", R"("late" takes effect only after this action)"},
          {"/objective/0/since", "15", "/actions/14/name", R"("energy" takes effect only after this action)"},
          {"/actions/17/name", R"("nobody")", nullptr, no_statement},
          {"/actions/17/name", R"("late")", "/actions/17/with", R"(constraint 1 is no replacement of "late")"},
          {"/actions/17/with", "0", nullptr, R"(constraint 0 is no replacement of "goal")"},
          {"/actions/17/with", "3", nullptr, "there is no constraint 3"},
          {"/actions/18/with", "2", nullptr, "there is no term of the objective 2"},
          {"/actions/18/with", "0", nullptr, R"(term of the objective 0 is no replacement of "energy")"},
          {"/actions/19/name", R"("energy")", nullptr, R"("energy" is a term of the objective, which has no scope)"},
          {"/actions/19/scope/to", "2.5", nullptr, "is outside the problem's time"},
          {"/actions/19/scope/step", "0", nullptr, "must be positive"},
          {"/actions/19/scope/step", "1e-9", "/actions/19/scope", "more than 4000000 residuals"},
          {"/actions/19/scope", R"({"kind": "once"})", "/actions/19/scope/kind", "evaluated once"},
          {"/actions/20/dof", R"("r")", nullptr, no_dof},
          {"/actions/20/upper", "-2", nullptr, "is below the lower bound"},
          {"/actions/21/time", "2.5", nullptr, "is outside the problem's time"},
          {"/actions/21/keys/1/dof", R"("r")", nullptr, no_dof},
          {"/actions/21/keys/1/dof", R"("q")", nullptr, "has a key at this time already"},
          {"/actions/21/keys/1/value/output", "1", nullptr, "there is no 1"},
          {"/actions/22/dof", R"("r")", nullptr, no_dof},
          {"/actions/22/value", R"({"program": "none", "output": 0})", "/actions/22/value/program", "no program"},
      },
      [](const std::string& text) { return read_problem(text); });
}

std::string fault_of(const Problem& problem) {
  const auto fault = validate(problem);
  return fault ? fault->path : "nothing";
}

TEST(ActionsRefuse, WhatNoDocumentCanHold) {
  const auto fault_after = [](std::size_t which, Action action) {
    auto problem = examples::busy_problem();
    problem.actions[which].action = std::move(action);
    return fault_of(problem);
  };
  const Quantity nan{std::numeric_limits<double>::quiet_NaN(), {}, 0}, one{1, {}, 0};
  Solve solve;
  EXPECT_EQ(fault_after(0, solve), "nothing");
  solve.tolerance = nan.number;
  EXPECT_EQ(fault_after(0, solve), "/actions/0/tolerance");
  solve = {};
  solve.iterations = -1;
  EXPECT_EQ(fault_after(0, solve), "/actions/0/iterations");
  solve = {};
  solve.starts = 0;
  EXPECT_EQ(fault_after(0, solve), "/actions/0/starts");
  EXPECT_EQ(fault_after(1, Iterate{-1}), "/actions/1/iterations");
  EXPECT_EQ(fault_after(1, Window{Interval{nan, one}, {}}), "/actions/1/from");
  EXPECT_EQ(fault_after(1, Refine{{}, {}, 0, {}}), "/actions/1/times");
  EXPECT_EQ(fault_after(1, Refine{{}, {}, 53, {}}), "/actions/1/times");
  EXPECT_EQ(fault_after(1, Shake{nan, {}, {}}), "/actions/1/amplitude");
  EXPECT_EQ(fault_after(1, Shake{one, -1, {}}), "/actions/1/seed");
  EXPECT_EQ(fault_after(1, Smooth{nan, {}}), "/actions/1/strength");
  EXPECT_EQ(fault_after(1, Damp{nan, {}}), "/actions/1/limit");
  EXPECT_EQ(fault_after(1, Adapt{one, -1}), "/actions/1/levels");
  EXPECT_EQ(fault_after(1, Lock{-1}), "/actions/1/level");
  EXPECT_EQ(fault_after(1, SetWeight{"goal", nan}), "/actions/1/weight");
  EXPECT_EQ(fault_after(1, Replace{"goal", -1}), "/actions/1/with");
  EXPECT_EQ(fault_after(1, Control{"q", -1, one}), "/actions/1/index");
}

TEST(ActionsRefuse, CoefficientsThatAreNotThere) {
  auto problem = examples::busy_problem();
  problem.constraints[2].since = 0;
  problem.actions = {{Control{"p", 4, {}}, {}}};
  EXPECT_EQ(fault_of(problem), "/actions/0/index");
  problem.actions.insert(problem.actions.begin(), {Refine{}, {}});
  EXPECT_EQ(fault_of(problem), "nothing") << "after a refinement only the optimizer knows how many there are";
}

// A new scope is that of the program that stands under the name by then.
TEST(ActionsRefuse, ScopesOfWhatWasReplaced) {
  auto problem = examples::busy_problem();
  Program constant;
  constant.numbers = {1};
  constant.values = {0};
  problem.constraints[1].program = examples::add(problem, constant);
  Scope once;
  once.kind = Scope::Kind::once;
  problem.constraints[2].since = 0;
  problem.actions = {{Replace{"goal", 1}, {}}, {Rescope{"goal", once}, {}}};
  EXPECT_EQ(fault_of(problem), "nothing");
  std::swap(problem.actions[0], problem.actions[1]);
  EXPECT_EQ(fault_of(problem), "/actions/0/scope/kind");
}

TEST(ActionsRefuse, EndlessWorkInANewScope) {
  auto problem = examples::busy_problem();
  std::mt19937 random(3);
  problem.constraints[2].program = examples::add(problem, examples::random_program(random, {}, 100'000));
  problem.constraints[2].since = 0;
  Scope scope;
  scope.kind = Scope::Kind::count;
  scope.to.number = 1;
  scope.count = 900'000;
  problem.actions = {{Rescope{"late", scope}, {}}};
  EXPECT_EQ(fault_of(problem), "nothing");
  scope.count = 1'100'000;
  problem.actions = {{Rescope{"late", scope}, {}}};
  EXPECT_EQ(fault_of(problem), "/actions/0/scope");
}

}  // namespace
}  // namespace spacetime
