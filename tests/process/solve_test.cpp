// The pipe as a person runs it: documents on standard output, words on standard error, exit codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/files.h"
#include "protocol/motion_json.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

constexpr const char* contradiction = R"(time [0, 1]
trajectory bspline spans 8
dof x
constrain here:  x = 0 at 0.5
constrain there: x = 1 at 0.5
minimize integral(x''^2)
)";

// Never converges within the patience of a test: a curve pushed ever further for ever less.
constexpr const char* endless = R"(time [0, 1]
trajectory bspline spans 400
dof x = 1
dof y = 2
minimize integral(exp(-x) + exp(-y) + 1e-12*x''^2)
solve iterations 100000000 tolerance 1e-300
)";

TEST(Solve, DoubleIntegratorThroughThePipe) {
  const Result result = solve_scene(text_of("examples/double_integrator.scene"));
  ASSERT_EQ(result.code, 0) << result.err;
  const Motion motion = read_motion(result.out);
  EXPECT_EQ(motion.status, Status::converged);
  EXPECT_NEAR(motion.objective, 12, 1e-9);
  EXPECT_NE(result.err.find("iteration"), std::string::npos);
  EXPECT_NE(result.err.find("converged"), std::string::npos);
}

TEST(Solve, TheThrowTellsWhereTheHandWas) {
  const Result result = solve_scene(text_of("examples/throw.scene"), {"--show", "arm.hand@release"});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* word :
       {"minimise", "subject to", "iterations", "objective", "violation", "arm.hand at 1 s", "time"}) {
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " missing in\n" << result.err;
  }
  EXPECT_LE(read_motion(result.out).violation, 1e-8);
}

TEST(Solve, TheSameSceneGivesTheSameBytes) {
  const std::string scene = text_of("examples/throw.scene");
  const Result first = solve_scene(scene, {"-q", "--samples", "25"}),
               second = solve_scene(scene, {"-q", "--samples", "25"});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(without_seconds(first.out), without_seconds(second.out));
  EXPECT_EQ(first.err, "");
}

TEST(Solve, StoppingShortExitsWithTwoAndStillLeavesTheMotion) {
  const Result result = solve_scene(text_of("examples/throw.scene"), {"--iterations", "3"});
  EXPECT_EQ(result.code, 2) << result.err;
  const Motion motion = read_motion(result.out);
  EXPECT_EQ(motion.status, Status::stopped);
  EXPECT_EQ(motion.iterations, 3);
}

TEST(Solve, AContradictionExitsWithThreeAndIsNamed) {
  const Result result = solve_scene(contradiction);
  EXPECT_EQ(result.code, 3) << result.err;
  const Motion motion = read_motion(result.out);
  EXPECT_EQ(motion.status, Status::infeasible);
  EXPECT_NEAR(motion.violation, 0.5, 1e-6);  // the least-squares point
  EXPECT_TRUE(motion.message.find("here") != std::string::npos || motion.message.find("there") != std::string::npos);
}

TEST(Solve, CtrlCKeepsTheMotionReached) {
  const Result compiled = run("spacetime-symbolic", {"compile", "-"}, endless);
  ASSERT_EQ(compiled.code, 0) << compiled.err;
  const Result result = run("spacetime-optimizer", {"solve"}, compiled.out, "\n        5 ");
  EXPECT_EQ(result.code, 2) << result.err.substr(0, 2000);
  const Motion motion = read_motion(result.out);
  EXPECT_EQ(motion.status, Status::stopped);
  EXPECT_GE(motion.iterations, 5);
  EXPECT_NE(motion.message.find("Interrupted"), std::string::npos) << motion.message;
}

// The document without its times.
std::string timeless(const std::string& document) {
  Motion motion = read_motion(document);
  motion.seconds = {};
  for (IterationRecord& record : motion.record) record.seconds = 0;
  return write(motion);
}

TEST(Solve, IsResumedToTheSameBytes) {
  const std::string scene = text_of("examples/throw_regularised.scene"), part = scratch("part.motion.json");
  const std::vector<std::string> options{"-q", "--record", "--checkpoint"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), options.begin(), options.end());
    return solve_scene(scene, more);
  };
  const Result whole = with({});
  ASSERT_EQ(whole.code, 0) << whole.err;
  for (const char* iterations : {"0", "1", "7", "16"}) {
    EXPECT_EQ(with({"-o", part, "--iterations", iterations}).code, 2);
    EXPECT_EQ(timeless(with({"--start", part}).out), timeless(whole.out)) << iterations;
  }
}

TEST(Solve, IsResumedAfterAnInterrupt) {
  // It would go on for long, so that what is interrupted is never the end.
  const std::string problem = run("spacetime-symbolic", {"compile", "-"}, text_of("tests/wire/long_throw.scene")).out;
  const std::string part = scratch("interrupted.motion.json");
  const Result interrupted = run("spacetime-optimizer", {"solve", "--checkpoint", "--tolerance", "1e-300", "-o", part},
                                 problem, "\n        5 ");
  ASSERT_EQ(interrupted.code, 2) << interrupted.err;
  const int done = read_motion(read_text(part)).iterations;
  const std::string all = std::to_string(done + 5);
  const std::vector<std::string> rest{"solve", "-q", "--checkpoint", "--tolerance", "1e-300", "--iterations", all};
  auto resume = rest;
  resume.insert(resume.end(), {"--start", part});
  EXPECT_EQ(timeless(run("spacetime-optimizer", resume, problem).out),
            timeless(run("spacetime-optimizer", rest, problem).out));
}

TEST(Solve, RefusesACheckpointOfAnotherProblem) {
  const std::string scene = text_of("examples/double_integrator.scene"), file = scratch("one.motion.json");
  ASSERT_EQ(solve_scene(scene, {"-q", "--checkpoint", "-o", file}).code, 0);
  const Result other = solve_scene(scene + "\n# another text\nconstant other = 1\n", {"-q", "--start", file});
  EXPECT_EQ(other.code, 1);
  EXPECT_NE(other.err.find("/checkpoint/problem"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("--anew"), std::string::npos) << other.err;
  EXPECT_EQ(solve_scene(scene + "\nconstant other = 1\n", {"-q", "--anew", "--start", file}).code, 0);
}

TEST(Solve, StartsFromAMotion) {
  const std::string scene = text_of("examples/throw.scene"), file = scratch("start.motion.json");
  ASSERT_EQ(solve_scene(scene, {"-q", "-o", file}).code, 0);
  const Result again = solve_scene(scene, {"--start", file});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_LE(read_motion(again.out).iterations, 1);
}

TEST(Solve, BadInputExitsWithOneAndSaysWhere) {
  struct Case {
    std::vector<std::string> arguments;
    std::string input, expected;
  };
  const std::string problem =
      run("spacetime-symbolic", {"compile", "-"}, text_of("examples/double_integrator.scene")).out;
  const std::vector<Case> cases = {
      {{"solve", "nowhere.json"}, "", "nowhere.json"},
      {{"solve", "."}, "", "directory"},
      {{"solve"}, "", "problem document"},
      {{"solve"}, "{}", "format"},
      {{"solve"}, problem.substr(0, problem.size() / 2), "problem document"},
      {{"solve", "--start", "nowhere.json"}, problem, "nowhere.json"},
      {{"solve", "--show", "x"}, problem, "NAME@TIME"},
      {{"solve", "--show", "nothing@0"}, problem, "nothing"},
      {{"solve", "--tolerance", "-1"}, problem, "tolerance"},
      {{"slove"}, "", "slove"},
      {{}, "", "Usage"},
  };
  for (const Case& c : cases) {
    const Result result = run("spacetime-optimizer", c.arguments, c.input);
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_NE(result.err.find(c.expected), std::string::npos) << "expected " << c.expected << " in\n" << result.err;
    EXPECT_EQ(result.out, "");
  }
}

TEST(Solve, AFailureNeverTouchesTheFileInPlace) {
  const std::string file = scratch("kept.motion.json");
  std::ofstream(file) << "precious";
  const Result result = run("spacetime-optimizer", {"solve", "-o", file}, "{\"format\": 1}");
  EXPECT_EQ(result.code, 1);
  std::ifstream in(file);
  std::string text;
  in >> text;
  EXPECT_EQ(text, "precious");
  const Result nowhere = solve_scene(text_of("examples/double_integrator.scene"), {"-o", scratch("no/such/dir.json")});
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_NE(nowhere.err.find("cannot write"), std::string::npos) << nowhere.err;
}

TEST(Programs, HelpAndVersion) {
  for (const char* program : {"spacetime-symbolic", "spacetime-optimizer"}) {
    const Result help = run(program, {"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.out.find("Usage"), std::string::npos) << help.out;
    const Result version = run(program, {"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_NE(version.out.find(program), std::string::npos) << version.out;
  }
}

TEST(Compile, MistakesGoToStandardErrorWithTheirPlace) {
  const std::string file = scratch("wrong.scene");
  std::ofstream(file) << "time [0, 1]\ntrajectory bspline spans 4\ndof x\nconstrain y = 0 at 0\n";
  const Result result = run("spacetime-symbolic", {"compile", file});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find(file + ":4:11: error:"), std::string::npos) << result.err;
}

class Example : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(Example, Converges) {
  const Result compiled = run("spacetime-symbolic", {"compile", GetParam().string()});
  ASSERT_EQ(compiled.code, 0) << compiled.err;
  const Result result = run("spacetime-optimizer", {"solve"}, compiled.out);
  EXPECT_EQ(result.code, 0) << result.err;
  const Motion motion = read_motion(result.out);
  EXPECT_EQ(motion.status, Status::converged);
  EXPECT_LE(motion.violation, 1e-8);
}

std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(SPACETIME_SOURCE_DIR "/examples")) {
    if (entry.path().extension() == ".scene") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}
INSTANTIATE_TEST_SUITE_P(Examples, Example, testing::ValuesIn(scenes()),
                         [](const auto& param) { return param.param.stem().string(); });

}  // namespace
}  // namespace spacetime::test
