// Edits between iterations: a constant that is set gives the problem of the edited text, bit for bit.
#include "optimizer/edit.h"

#include <gtest/gtest.h>

#include "common/diagnostic.h"
#include "optimizer/run.h"
#include "optimizer/session.h"
#include "optimizer/transcription.h"
#include "symbolic/compile.h"

namespace spacetime::optimizer {
namespace {

// Constants of every kind of use: in an expression, a mass, a length, gravity, a scope's ends and step, a time, an
// instance, a weight of a term and of a constraint, a key, a start, a bound, conditions of time and of the motion,
// another constant.
const std::string scene = R"(time [0, 2]
constant g = 9.81
constant mass = 1.5
constant length = 0.7
constant release = 1.25
constant twice = 2*release - 1
constant step = 0.25
constant w = 2
constant soft = 30
constant pose = 0.4
constant target = 0.3
constant low = -2
constant late = 0.5
trajectory bspline spans 8
dof x = pose in [low, 3]
creature arm {
  gravity (0, -g, 0)
  link upper { revolute shoulder; a length; mass mass; rod }
}
constrain rest: (arm.q, arm.q') = 0 at 0
constrain path: x = target*t over [0, release] every step
constrain near: arm.upper.y = target at twice weight soft
constrain floor: low <= arm.upper.y over [0, release] every step when t > late
constrain side: arm.upper.x >= low over [0, 2] when x > target
minimize effort: integral(dot(arm.force, arm.force), 0, release) weight w
minimize calm: integral(x''^2 + arm.shoulder''^2)
keyframe release: arm.shoulder = pose
)";

Problem compiled(const std::string& text) {
  auto result = symbolic::compile(text);
  for (const Diagnostic& diagnostic : result.diagnostics) ADD_FAILURE() << render(diagnostic, "scene", text);
  return std::move(result.problem).value();
}

std::string with_constant(const std::string& name, const std::string& value) {
  const auto from = scene.find("constant " + name + " = "), to = scene.find('\n', from);
  return scene.substr(0, from) + "constant " + name + " = " + value + scene.substr(to);
}

struct Case {
  const char* name;
  const char* text;
  double value;
};

class SetConstants : public testing::TestWithParam<Case> {};

TEST_P(SetConstants, GiveTheProblemOfTheEditedText) {
  const auto& [name, text, value] = GetParam();
  Edited edited{compiled(scene), {}};
  apply(edited, SetConstant{name, {value, {}, 0}});
  const Problem set = in_effect(edited, 0), written = compiled(with_constant(name, text));
  EXPECT_EQ(set, written);

  // And what is tabulated from it, to the bit.
  const Transcription a = transcribe(set), b = transcribe(written);
  EXPECT_EQ(a.constants, b.constants);
  ASSERT_EQ(a.batches.size(), b.batches.size());
  for (std::size_t k = 0; k < a.batches.size(); ++k) {
    EXPECT_EQ(a.batches[k].times, b.batches[k].times);
    EXPECT_EQ(a.batches[k].weights, b.batches[k].weights);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SetConstants,
                         testing::Values(Case{"g", "1.62", 1.62}, Case{"mass", "2.25", 2.25},
                                         Case{"length", "0.9", 0.9}, Case{"release", "1.5", 1.5},
                                         Case{"step", "0.125", 0.125}, Case{"w", "5", 5}, Case{"soft", "1e3", 1e3},
                                         Case{"pose", "-0.2", -0.2}, Case{"target", "0.1", 0.1},
                                         Case{"low", "-1.5", -1.5}, Case{"late", "0.75", 0.75}),
                         [](const auto& param) { return param.param.name; });

TEST(SetConstants, FollowEachOtherUnlessSetThemselves) {
  Edited edited{compiled(scene), {}};
  apply(edited, SetConstant{"release", {1.1, {}, 0}});
  EXPECT_EQ(evaluate_constants(edited.problem).at("twice"), 2 * 1.1 - 1);
  apply(edited, SetConstant{"twice", {1.7, {}, 0}});
  apply(edited, SetConstant{"release", {1.4, {}, 0}});
  EXPECT_EQ(evaluate_constants(edited.problem).at("twice"), 1.7);
}

TEST(SetConstants, RefuseWhatIsFrozenOrUnknownOrSpoilsTheProblem) {
  Edited edited{compiled(scene), {}};
  edited.problem.constants[0].frozen = Place{7, 3};
  const auto message = [&](const SetConstant& set) {
    try {
      apply(edited, set);
      (void)transcribe(in_effect(edited, 0));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({"g", {1, {}, 0}}).find("line 7"), std::string::npos);
  EXPECT_NE(message({"nothing", {1, {}, 0}}).find("nothing"), std::string::npos);
  EXPECT_NE(message({"release", {7, {}, 0}}).find("outside"), std::string::npos);
}

TEST(Edits, ChangeWhatTheyName) {
  Edited edited{compiled(scene), {}};
  apply(edited, Disable{"path"});
  EXPECT_EQ(in_effect(edited, 0).constraints.size(), 4U);
  apply(edited, Enable{"path"});
  EXPECT_EQ(in_effect(edited, 0).constraints.size(), 5U);
  apply(edited, Delete{"calm"});
  EXPECT_EQ(in_effect(edited, 0).objective.size(), 1U);
  EXPECT_THROW(apply(edited, Enable{"calm"}), InputError);
  apply(edited, SetWeight{"near", std::nullopt});
  EXPECT_FALSE(edited.problem.constraints[2].weight);
  apply(edited, SetWeight{"effort", Quantity{7, {}, 0}});
  EXPECT_EQ(edited.problem.objective[0].weight.number, 7);
  EXPECT_THROW(apply(edited, SetWeight{"effort", std::nullopt}), InputError);
  apply(edited, Bound{"x", {-1, {}, 0}, {1, {}, 0}});
  EXPECT_EQ(edited.problem.dofs[0].upper->number, 1);
  EXPECT_THROW(apply(edited, Bound{"y", {-1, {}, 0}, {1, {}, 0}}), InputError);
  Scope scope;
  scope.kind = Scope::Kind::times;
  scope.times = {{0.5, {}, 0}};
  apply(edited, Rescope{"path", scope});
  EXPECT_EQ(edited.problem.constraints[1].scope, scope);
}

// The run goes on from where it stands: the basket moves, and few iterations bring the throw there.
TEST(Edits, AMovedTargetIsReachedFromTheConvergedMotion) {
  Problem problem = compiled(R"(time [0, 1]
constant goal = 1
trajectory bspline spans 16
dof x
constrain start: (x, x') = 0 at 0
constrain end: x = goal at 1
minimize integral(x''^2 + exp(x))
)");
  problem.actions = {{Solve{}, {1, 1}}, {SetConstant{"goal", {1.2, {}, 0}}, {2, 1}}, {Solve{}, {3, 1}}};
  const Motion motion = run(problem, {});
  EXPECT_EQ(motion.status, Status::converged) << motion.message;
  EXPECT_NEAR(motion.dofs[0].coefficients.back(), 1.2, 1e-8);
  EXPECT_EQ(motion.constants.back().second, 1.2);
}

TEST(Edits, WhatIsDeclaredAfterTheLastActionIsJudged) {
  const Problem problem = compiled(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain x = 1 at 1\n"
      "minimize integral(x''^2)\nsolve\nconstrain late: x = 5 at 0.5\n");
  const Motion motion = run(problem, {});
  EXPECT_EQ(motion.status, Status::stopped) << motion.message;
  ASSERT_EQ(motion.violations.size(), 2U);
  EXPECT_EQ(motion.violations[1].name, "late");
  EXPECT_GT(motion.violation, 1);
}

// A solved motion stays so where an edit asks nothing new of it, and is no more than stopped where it does.
TEST(Edits, TheStatusIsWhatIsTrueOfTheMotionAsItStands) {
  const std::string question =
      "time [0, 1]\nconstant goal = 1\ntrajectory bspline spans 16\ndof x\ndof y in [-2, 2]\n"
      "constrain start: (x, x') = 0 at 0\nconstrain end: x = goal at 1\nconstrain high: y >= 0.3 over [0, 1]\n"
      "constrain idle: y <= 1.9 over [0, 1]\nminimize integral(x''^2 + exp(x) + y^2)\nminimize more: integral(y^2)\n";
  const auto after = [&](const std::string& edits) { return run(compiled(question + "solve\n" + edits), {}); };
  const Motion solved = after("");
  ASSERT_EQ(solved.status, Status::converged) << solved.message;
  for (const char* harmless :
       {"bound x in [-5, 5]\n", "bound y in [-1, 3]\n", "bound x in [-5, 5]\nbound x in [-4, 9]\n", "disable idle\n",
        "set goal = 1\n", "damp 0.1\n", "window [0.1, 0.8]\n"}) {
    const Motion motion = after(harmless);
    EXPECT_EQ(motion.status, Status::converged) << harmless << motion.message;
    EXPECT_EQ(motion.dofs[0].coefficients, solved.dofs[0].coefficients);
    EXPECT_EQ(motion.dofs[1].coefficients, solved.dofs[1].coefficients);
    EXPECT_EQ(motion.iterations, solved.iterations);
    EXPECT_EQ(after(harmless + std::string("solve\n")).iterations, solved.iterations) << harmless;
  }
  for (const char* edit : {"scope end at 0.9\n", "bound y in [0.4, 2]\n", "disable high\n", "set goal = 1.5\n",
                           "shake amplitude 0.1\n", "weight more = 3\nbound x in [-5, 5]\nset goal = 1.01\n"}) {
    const Motion motion = after(edit);
    EXPECT_EQ(motion.status, Status::stopped) << edit << motion.message;
    EXPECT_TRUE(motion.message.starts_with("Edited since iteration ")) << edit << motion.message;
    EXPECT_EQ(after(edit + std::string("solve\n")).status, Status::converged) << edit;
  }
  // What is off by less than the tolerance is not told of.
  const Motion weighed = after("weight more = 3\n");
  EXPECT_EQ(weighed.status, Status::stopped);
  EXPECT_LE(weighed.violation, 1e-8);
  EXPECT_NE(weighed.message.find("; every hard constraint holds"), std::string::npos) << weighed.message;
  const Motion sketch = run(compiled(question + "shake amplitude 0.1\n"), {});
  EXPECT_TRUE(sketch.message.starts_with("Nothing has been iterated yet")) << sketch.message;
}

TEST(Edits, NothingToFindIsRefused) { EXPECT_THROW(run(compiled("time [0, 1]\n"), {}), InputError); }

TEST(Edits, ARefusedActionKeepsTheMotionReached) {
  Problem problem =
      compiled("time [0, 1]\ntrajectory bspline spans 4\ndof x\nconstrain x = 1 at 1\nminimize integral(x''^2)\n");
  problem.actions = {{Solve{}, {6, 1}}, {Adapt{}, {7, 1}}};
  const Motion motion = run(problem, {});
  EXPECT_EQ(motion.status, Status::stopped);
  EXPECT_NE(motion.message.find("line 7"), std::string::npos) << motion.message;
  EXPECT_NE(motion.message.find("adapt"), std::string::npos) << motion.message;
  EXPECT_NEAR(motion.dofs[0].coefficients.back(), 1, 1e-8);
}

// Where statements stand in the text is no matter of the motion: what its limits cost is known to a text with a line
// more, as to an edit that changes nothing.
TEST(Edit, ALineAboveIsNoEdit) {
  const std::string text =
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain (x, x') = (0, 1) at 0\n"
      "constrain (x, x') = (0, -1) at 1\nconstrain x <= 1/9 over [0, 1] every 0.05\nminimize effort: integral(x''^2)\n";
  Session updated(compiled(text)), edited(compiled(text));
  updated.perform(Solve{});
  edited.perform(Solve{});
  ASSERT_EQ(updated.outcome().status, Status::converged) << updated.outcome().message;
  const int iterations = updated.iterations();
  updated.update(compiled("# what it is for\n" + text));
  edited.perform(SetWeight{"effort", Quantity{1, {}, 0}});
  updated.perform(Solve{});
  edited.perform(Solve{});
  EXPECT_EQ(updated.iterations(), edited.iterations());
  EXPECT_LE(updated.iterations(), iterations + 2);
  EXPECT_EQ(updated.trajectories(), edited.trajectories());
}

}  // namespace
}  // namespace spacetime::optimizer
