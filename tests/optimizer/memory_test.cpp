// Memory that runs out at every single allocation of an act: what is refused has changed nothing.
#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <ostream>

#include "optimizer/session.h"
#include "tests/optimizer/failing_new.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

const std::string scene = R"(time [0, 1]
trajectory bspline spans 10
constant target = 1
dof x in [-5, 5]
dof y
constrain start: (x, x', y) = 0 at 0
constrain finish: x = target at 1
constrain low: y >= x*x - 1 over [0, 1] every 0.25
constrain travel: integral(y^2) + integral(x^2) = 0.5
minimize effort: integral(x''^2 + y''^2)
)";

const std::string without_limits = R"(time [0, 1]
trajectory bspline spans 10
dof x
dof y
constrain start: (x, x', y) = 0 at 0
constrain finish: x = 1 at 1
constrain travel: integral(y^2) + integral(x^2) = 0.5
minimize effort: integral(x''^2 + y''^2)
)";

// Everything but the time that was taken.
std::pair<std::vector<Trajectory>, std::string> standing_of(Session& session) {
  const Motion motion = session.motion();
  return {motion.dofs, motion.message};
}

struct Case {
  const char* name;
  std::function<void(Session&)> act;
  bool windowed = false;
};
void PrintTo(const Case& one, std::ostream* to) { *to << one.name; }

class OutOfMemory : public testing::TestWithParam<Case> {};

TEST_P(OutOfMemory, ARefusedActChangesNothing) {
  Session session(problem_of(scene));
  if (GetParam().windowed) session.perform(Window{Interval{{0.1, {}, 0}, {0.9, {}, 0}}, {}});
  session.perform(Iterate{3});
  const Motion moment = session.moment();
  {
    Session one_more(problem_of(scene));  // whatever is made once and kept is made before memory runs out
    one_more.set_motion(moment);
    GetParam().act(one_more);
  }
  const auto before = standing_of(session);
  const auto problem = session.problem();
  long most = 0;
  for (bool done = false; !done; ++most) {
    ASSERT_LT(most, 100'000);
    try {
      const test::Allocations limited(most);
      GetParam().act(session);
      done = true;
    } catch (const std::bad_alloc&) {
      ASSERT_EQ(session.problem(), problem) << most;
      ASSERT_EQ(standing_of(session), before) << most;
    }
  }
  EXPECT_GT(most, 20);  // it has allocated, so there was something to refuse

  // It comes to what it comes to where memory never ran out.
  Session other(problem_of(scene));
  other.set_motion(moment);
  other.motion();
  GetParam().act(other);
  EXPECT_EQ(standing_of(session), standing_of(other));
}

// An action that iterates keeps what it has reached, and whoever asks again goes on from there.
class OutOfMemoryAmongIterations : public testing::TestWithParam<Solve> {};

TEST_P(OutOfMemoryAmongIterations, WhatIsReachedIsGoneOnFrom) {
  // The papers' methods know no inequalities.
  const bool newton = GetParam().method == Solve::Method::newton;
  const Problem problem = problem_of(newton ? scene : without_limits);
  Session session(problem), other(problem);
  Watch watch;
  watch.threads = 1;
  watch.progress = [](const IterationRecord&) {};
  int refused = 0;
  for (long most = 0; most < 3000; most += 1 + most / 64) {
    try {
      const test::Allocations limited(most);
      session.perform(GetParam(), watch);
    } catch (const std::bad_alloc&) {
      ++refused;
    }
    if (most % 5 != 0) continue;
    EXPECT_EQ(session.motion().dofs.size(), 2U);
  }
  EXPECT_GT(refused, 20);
  ASSERT_EQ(session.problem(), problem);
  session.perform(Solve{});
  other.perform(Solve{});
  ASSERT_EQ(session.outcome().status, Status::converged) << session.outcome().message;
  EXPECT_NEAR(session.record().objective, other.record().objective, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Methods, OutOfMemoryAmongIterations,
                         testing::Values(Solve{.iterations = 1}, Solve{.iterations = 1, .starts = 3},
                                         Solve{.iterations = 1, .method = Solve::Method::sqp92},
                                         Solve{.iterations = 1, .method = Solve::Method::bfgs}));

const Motion& on_other_knots() {
  static const Motion motion = [] {
    Motion made = Session(problem_of(with_spans(scene, 12))).moment();
    made.checkpoint.reset();
    return made;
  }();
  return motion;
}

const Motion& in_another_window() {
  static const Motion motion = [] {
    Session session(problem_of(scene));
    session.perform(Window{Interval{{0.2, {}, 0}, {0.8, {}, 0}}, {}});
    session.perform(Iterate{2});
    return session.moment();
  }();
  return motion;
}

const Problem& with_more() {
  static const Problem problem = problem_of(scene + "constrain more: x = 0.3 at 0.5\n");
  return problem;
}

INSTANTIATE_TEST_SUITE_P(Acts, OutOfMemory,
                         testing::Values(Case{"refine", [](Session& s) { s.perform(Refine{}); }},
                                         Case{"refine_in_a_window", [](Session& s) { s.perform(Refine{}); }, true},
                                         Case{"refine_auto",
                                              [](Session& s) {
                                                s.perform(Refine{{}, {}, 1, Quantity{1e-3, {}, 0}});
                                              }},
                                         Case{"set",
                                              [](Session& s) {
                                                s.perform(SetConstant{"target", {2, {}, 0}});
                                              }},
                                         Case{"weight",
                                              [](Session& s) {
                                                s.perform(SetWeight{"effort", Quantity{2, {}, 0}});
                                              }},
                                         Case{"window",
                                              [](Session& s) {
                                                s.perform(Window{Interval{{0.2, {}, 0}, {0.7, {}, 0}}, {}});
                                              }},
                                         Case{"shake_in_a_window",
                                              [](Session& s) {
                                                s.perform(Shake{{0.1, {}, 0}, 3, {}});
                                              },
                                              true},
                                         Case{"reset", [](Session& s) { s.perform(Reset{}); }},
                                         Case{"update", [](Session& s) { s.update(with_more()); }},
                                         Case{"motion_on_other_knots",
                                              [](Session& s) { s.set_motion(on_other_knots()); }},
                                         Case{"checkpoint", [](Session& s) { s.set_motion(in_another_window()); }}),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace spacetime::optimizer
