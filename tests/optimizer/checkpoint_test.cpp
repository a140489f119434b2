// A run that is interrupted and resumed from its checkpoint leaves the motion of one that never was, bit for bit.
#include "common/checkpoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "optimizer/session.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

constexpr std::uint32_t seed = 20260521;

Motion without_seconds(Motion motion) {
  motion.seconds = {};
  for (IterationRecord& record : motion.record) record.seconds = 0;
  return motion;
}

std::string from_file(const std::string& name) { return file_text("examples/" + name + ".scene"); }

RunOptions with_checkpoint() {
  RunOptions options;
  options.checkpoint = options.record = true;
  return options;
}

// Interrupted before the step after `most` iterations.
Motion interrupted(const Problem& problem, RunOptions options, int most) {
  int steps = 0;
  options.interrupted = [&] { return steps++ == most; };
  return run(problem, options);
}

// Interrupts at `times` random moments, each time once more before the resumed run may end.
void expect_resumable(const std::string& scene, int times, const RunOptions& options = with_checkpoint()) {
  const Problem problem = problem_of(scene);
  const Motion whole = without_seconds(run(problem, options));
  ASSERT_TRUE(whole.checkpoint);
  ASSERT_GT(whole.iterations, 1) << whole.message;
  std::mt19937 random(seed);
  for (int i = 0; i < times; ++i) {
    const int first = static_cast<int>(random() % static_cast<unsigned>(whole.iterations));
    const int second = static_cast<int>(random() % static_cast<unsigned>(whole.iterations - first));
    SCOPED_TRACE("seed " + std::to_string(seed) + ": after " + std::to_string(first) + " and " +
                 std::to_string(second) + " iterations");
    RunOptions more = options;
    more.start = interrupted(problem, options, first);
    EXPECT_NE(more.start->message.find("Interrupted"), std::string::npos) << more.start->message;
    more.start = interrupted(problem, more, second);
    ASSERT_EQ(without_seconds(run(problem, more)), whole);
  }
}

const std::string double_integrator = R"(time [0, 1]
trajectory bspline spans 16
dof x
dof y = 1
constant top = 0.15
constrain start: (x, x', y) = 0      at 0
constrain goal:  (x, x') = (1, 0) at 1
constrain low:   y <= top over [0.2, 1]
constrain quick: x' <= 1.4 over [0, 1] every 0.05 when x > 0.5
constrain near:  sin(x*y) = 0.3 at 0.5, 0.75 weight 30
minimize effort: integral(x''^2 + y''^2) + integral(x*y)^2
)";

TEST(Checkpoint, OfTheThrow) { expect_resumable(with_spans(from_file("throw_regularised"), 24), 8); }
TEST(Checkpoint, OfInequalities) { expect_resumable(with_spans(from_file("throw"), 16), 8); }
TEST(Checkpoint, OfTheAcrobat) {
  RunOptions options = with_checkpoint();
  options.iterations = 30;
  expect_resumable(with_spans(from_file("acrobat_flip"), 16), 3, options);
}
TEST(Checkpoint, OfBoundsOfCoefficients) { expect_resumable(from_file("bryson_denham_bounds"), 8); }
TEST(Checkpoint, OfConditionsAndFunctionals) { expect_resumable(double_integrator, 8); }

TEST(Checkpoint, OfWindowsAndEdits) {
  expect_resumable(double_integrator + R"(
iterate 3
damp 0.2 of y
window [0.1, 0.8] of x, y
iterate 4
set top = 0.12
shake amplitude 0.05
iterate 5
disable near
window all
refine [0, 0.3] of x
weight effort = 2
shake amplitude 0.01
solve
constrain late: y = 0.05 at 0.9
solve
)",
                   12);
}

TEST(Checkpoint, OfTrajectoriesOfDifferentRefinement) {
  expect_resumable(with_spans(from_file("throw_regularised"), 8) + R"(
iterate 4
refine [0.5, 1.5] of arm.ELBOW
iterate 4
refine auto tolerance 1e-2
solve
)",
                   8);
}

TEST(Checkpoint, OfRestoration) {
  // Out of reach: the violation alone is reduced, until nothing helps.
  expect_resumable(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x = 2\nconstrain never: x^2 + x'^2 = -1 at 0.5\n"
      "minimize integral(x''^2)\n",
      8);
}

TEST(Checkpoint, OfTheMethodOf1992) {
  expect_resumable(with_spans(from_file("throw_regularised"), 16) + "\niterate 3\nsolve method sqp92\n", 8);
}

TEST(Checkpoint, OfTheMethodOf1994) {
  expect_resumable(
      with_spans(from_file("throw_regularised"), 8) + "\nsolve method bfgs iterations 60\nsolve iterations 8\n", 8);
}

TEST(Checkpoint, OfARunFromAMotionReturnsThere) {
  const std::string scene = double_integrator + "iterate 4\nreset\niterate 3\n";
  RunOptions options = with_checkpoint();
  options.start = run(problem_of(double_integrator), {});
  expect_resumable(scene, 4, options);
}

TEST(Checkpoint, OfManyStartsIsTheirBeginning) {
  const Problem problem = problem_of(double_integrator + "iterate 2\nsolve starts 4\niterate 2\n");
  RunOptions options = with_checkpoint();
  options.threads = 2;
  const Motion whole = without_seconds(run(problem, options));
  for (const int after : {1, 2, 3}) {
    RunOptions more = options;
    more.start = interrupted(problem, options, after);
    EXPECT_LE(more.start->iterations, 2);
    EXPECT_EQ(without_seconds(run(problem, more)), whole) << after;
  }
}

TEST(Checkpoint, OfARunThatWasAllowedFewerIterations) {
  const Problem problem = problem_of(double_integrator);
  const Motion whole = without_seconds(run(problem, with_checkpoint()));
  for (int most = 0; most <= whole.iterations; ++most) {
    RunOptions few = with_checkpoint(), more = few;
    few.iterations = most;
    more.start = run(problem, few);
    EXPECT_EQ(without_seconds(run(problem, more)), whole) << most;
  }
}

// Every moment of a session can be come back to, whatever has been done since.
TEST(Checkpoint, UndoesAnything) {
  const Problem problem = problem_of(double_integrator);
  Session session(problem), again(problem);
  const std::vector<Action> actions{Iterate{2},
                                    Window{Interval{{0.1, {}, 0}, {0.9, {}, 0}}, {"x"}},
                                    Iterate{2},
                                    SetConstant{"top", {0.12, {}, 0}},
                                    SetConstant{"top", {0.13, {}, 0}},
                                    Iterate{1},
                                    Disable{"quick"},
                                    Refine{std::nullopt, {"y"}, 1, std::nullopt},
                                    Iterate{2},
                                    Window{},
                                    Solve{}};
  std::vector<Motion> moments, ends;
  for (const Action& action : actions) {
    moments.push_back(session.moment());
    session.perform(action);
    ends.push_back(without_seconds(session.motion()));
  }
  std::mt19937 random(seed);
  for (int i = 0; i < 30; ++i) {
    const std::size_t k = random() % actions.size();
    Session& here = i % 2 == 0 ? session : again;
    here.set_motion(moments[k]);
    here.perform(actions[k]);
    EXPECT_EQ(without_seconds(here.motion()), ends[k]) << "seed " << seed << ", action " << k;
  }
  EXPECT_EQ(moments[5].checkpoint->edits.size(), 1U);  // a value that is dragged is kept once
}

TEST(Checkpoint, IsRefusedWhereSizesDiffer) {
  const Problem problem = problem_of(double_integrator);
  Session session(problem);
  session.perform(Window{Interval{{0.1, {}, 0}, {0.9, {}, 0}}, {}});
  session.perform(Iterate{2});
  const Motion moment = session.moment();
  const std::string before = session.motion().message;
  const auto expect = [&](const std::string& path, const std::function<void(Motion&)>& change) {
    Motion changed = moment;
    change(changed);
    try {
      session.set_motion(changed);
      ADD_FAILURE() << path;
    } catch (const CheckpointError& error) {
      EXPECT_EQ(error.path(), path) << error.what();
    }
  };
  expect("/dofs", [](Motion& m) { m.dofs.pop_back(); });
  expect("/dofs/1/coefficients", [](Motion& m) { m.dofs[1].coefficients.pop_back(); });
  expect("/checkpoint/functionals", [](Motion& m) { m.checkpoint->functionals.push_back(1); });
  expect("/checkpoint", [](Motion& m) { m.checkpoint->outside.reset(); });
  expect("/checkpoint/outside/functionals", [](Motion& m) { m.checkpoint->outside->functionals.clear(); });
  expect("/checkpoint/newton/slacks", [](Motion& m) { m.checkpoint->newton.slacks.pop_back(); });
  expect("/checkpoint/newton/slacks", [](Motion& m) {
    m.checkpoint->window = {};
    m.checkpoint->outside.reset();
  });
  expect("/checkpoint/outside", [](Motion& m) { m.checkpoint->window = {}; });
  expect("/checkpoint/newton/switches", [](Motion& m) { m.checkpoint->newton.switches.clear(); });
  expect("/checkpoint/edits/0", [](Motion& m) { m.checkpoint->edits = {Reset{}}; });
  EXPECT_EQ(session.motion().message, before);
  session.set_motion(moment);
}

TEST(Checkpoint, OfASessionIsNoneOfARun) {
  const Problem problem = problem_of(double_integrator);
  RunOptions options;
  options.start = Session(problem).moment();
  EXPECT_THROW(run(problem, options), CheckpointError);
}

// A checkpoint that cannot be is refused before anything is iterated for it.
TEST(Checkpoint, OfManyUnknownsOfBfgsIsRefusedAtOnce) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 2000\ndof x\nminimize integral(x''^2 + x)\n"
      "solve method bfgs iterations 1\n");
  RunOptions options;
  options.checkpoint = true;
  int lines = 0;
  options.progress = [&](const IterationRecord&) { ++lines; };
  try {
    run(problem, options);
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("at most 2000 unknowns; there are 2003"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(lines, 1);  // the start
}

}  // namespace
}  // namespace spacetime::optimizer
