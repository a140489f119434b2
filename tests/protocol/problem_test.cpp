// What is written reads back as it was.
#include "protocol/problem_json.h"

#include <gtest/gtest.h>

#include "protocol/check.h"
#include "tests/protocol/examples.h"

namespace spacetime {
namespace {

TEST(ProblemDocument, HoldsEverythingAProblemHolds) {
  const auto problem = examples::rich_problem();
  EXPECT_EQ(read_problem(write(problem)), problem);
}

TEST(ProblemDocument, HoldsTheEmptyProblem) { EXPECT_EQ(read_problem(write(Problem{})), Problem{}); }

TEST(ProblemDocument, HoldsRandomProblems) {
  std::size_t programs = 0, constraints = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto problem = examples::random_problem(seed);
    const auto fault = validate(problem);
    ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
    const auto text = write(problem);
    const auto read = read_problem(text);
    ASSERT_EQ(read, problem);
    ASSERT_EQ(write(read), text);  // tells -0.0 from 0.0, which == does not
    programs += problem.programs.size();
    constraints += problem.constraints.size();
  }
  EXPECT_GT(programs, 1000u);
  EXPECT_GT(constraints, 300u);
}

TEST(ProblemDocument, BeginsWithItsFormat) {
  EXPECT_TRUE(write(Problem{}).starts_with("{\n \"format\": \"spacetime-problem/1\",\n \"time\": [0, 1],\n"));
}

TEST(ProblemDocument, LeavesOutWhatIsAbsent) {
  auto problem = examples::rich_problem();
  problem.constraints.resize(1);
  problem.constraints[0].place = {};
  const auto text = write(problem);
  const auto start = text.find("\"constraints\"");
  const auto end = text.find("\"objective\"");
  const auto statement = text.substr(start, end - start);
  for (const auto* absent : {"weight", "line", "column", "from", "step", "count", "null"}) {
    EXPECT_EQ(statement.find(absent), statement.npos) << statement;
  }
}

TEST(ProblemDocument, StandsOnOneLineInAMessage) {
  Writer to(false);
  write(to, examples::rich_problem());
  const auto text = to.take();
  EXPECT_EQ(text.find('\n'), text.npos);
  EXPECT_EQ(read_problem(text), examples::rich_problem());
}

TEST(ProblemDocument, IsReadInAnyOrderOfMembers) {
  const auto problem = examples::rich_problem();
  const nlohmann::json sorted = nlohmann::json::parse(write(problem));
  EXPECT_EQ(read_problem(sorted.dump()), problem);
}

}  // namespace
}  // namespace spacetime
