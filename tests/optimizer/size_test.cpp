// Problems that are too large once their constants have values and their knots are known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "optimizer/session.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

// Whoever edits a constant can make what no document's numbers tell of.
void expect_refused_step(const Problem& problem, double step, const std::string& word) {
  Session session(problem);
  try {
    session.perform(SetConstant{"step", {step, {}, 0}});
    ADD_FAILURE() << "not refused: " << word;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
  EXPECT_EQ(session.problem(), problem);
}

TEST(Size, ResidualsAreCountedWithTheConstantsValues) {
  const Problem problem = problem_of(
      "time [0, 1]\nconstant step = 0.1\ntrajectory bspline spans 4\ndof x\n"
      "constrain (x, x', x) = (0, 0, 0) over [0, 1] every step\n");
  expect_refused_step(problem, 5e-7, "residuals");
}

TEST(Size, ResidualsAreCountedOnTheKnotsThereAre) {
  std::string many = "x";
  for (int k = 1; k <= 40; ++k) many += fmt::format(", x + {}", k);
  const Problem problem =
      problem_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\nconstrain (" + many + ", x') = 0 over [0, 1]\n");
  Session session(problem);
  Motion motion = session.moment();
  motion.checkpoint.reset();
  motion.dofs[0].basis = uniform_basis(0, 1, 100'000);
  motion.dofs[0].coefficients.assign(static_cast<std::size_t>(motion.dofs[0].basis.size()), 0.0);
  EXPECT_THROW(session.set_motion(motion), InputError);
  EXPECT_EQ(session.problem(), problem);
}

TEST(Size, OperationsOfOneEvaluationAreCounted) {
  std::string sum = "0";
  for (int k = 1; k <= 9000; ++k) sum += fmt::format(" + sin({}*x)", k);
  const Problem problem = problem_of("time [0, 1]\nconstant step = 0.1\ntrajectory bspline spans 4\ndof x\nconstrain " +
                                     sum + " = 0 over [0, 1] every step\n");
  expect_refused_step(problem, 4e-7, "operations");
}

TEST(Size, KnotsThatARefinementChoseCountInAnUpdate) {
  const Problem problem =
      problem_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\nconstrain x = 0 at 0\nminimize integral(x''^2)\n");
  Session session(problem);
  session.perform(Refine{{}, {}, 3, {}});
  const int unknowns = session.problem().dofs[0].basis.size();
  EXPECT_GT(unknowns, 30);
  EXPECT_THROW(session.update(problem, unknowns - 1), InputError);
  EXPECT_NO_THROW(session.update(problem, unknowns));
}

}  // namespace
}  // namespace spacetime::optimizer
