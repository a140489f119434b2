// The documents of the example scenes: what the symbolic side makes can be used, what the optimizer makes can be read,
// and both are what the schemas say.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <variant>

#include "optimizer/run.h"
#include "protocol/check.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "symbolic/compile.h"
#include "tests/protocol/schema.h"

namespace spacetime {
namespace {

TEST(ExampleScenes, MakeDocumentsThatReadersAndSchemasAccept) {
  const Schema problems("problem.schema.json"), motions("motion.schema.json");
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(std::string(SPACETIME_SOURCE_DIR) + "/examples")) {
    if (file.path().extension() != ".scene") continue;
    SCOPED_TRACE(file.path().filename());
    ++scenes;
    std::stringstream text;
    text << std::ifstream(file.path()).rdbuf();
    const auto problem = symbolic::compile(text.str()).problem;
    ASSERT_TRUE(problem);
    const auto fault = validate(*problem);
    ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
    const auto document = write(*problem);
    EXPECT_EQ(read_problem(document), *problem);
    EXPECT_TRUE(problems.accepts(nlohmann::json::parse(document)));

    optimizer::RunOptions options;
    options.iterations = 2;
    options.frames_per_second = 10;
    const auto motion = optimizer::run(*problem, options);
    const auto wrong = validate(motion);
    ASSERT_FALSE(wrong) << wrong->path << ": " << wrong->message;
    const auto result = write(motion);
    EXPECT_EQ(read_motion(result), motion);
    EXPECT_TRUE(motions.accepts(nlohmann::json::parse(result)));
  }
  EXPECT_GT(scenes, 3);
}

// What the language can say, problems can hold.
TEST(Scenes, OfTheWholeLanguageMakeProblems) {
  const auto compiled = symbolic::compile(R"(
time [0, 2]
constant g = 9.81
constant n = 8
constant late = 1.5
trajectory bspline spans n
dof x = 0.5 in [-g, g]
dof y
parameter speed = 2 in [0, g]
parameter lift = 1
constrain start: (x, y) = 0 at 0
constrain low: -1 <= y - lift <= 1 over [0, late] every 0.25 when x' < speed and t > 0.1
constrain soft: x^2 >= speed weight g
constrain total: integral(x^2) <= speed
minimize energy: integral(x''^2 + y''^2)
minimize calm: at(x', late)^2 weight 2
keyframe late: x = 1
solve method sqp92 linear cg iterations 3 tolerance 1e-6 starts 2
constrain after: y = 1 at 2
window [0, 1] of x
window all
refine [0, 1] of y times 2
refine auto tolerance 1e-3
shake amplitude 0.1 seed 4 of x, y
filter strength 0.5 of y
damp g / 10
set g = 10
weight soft = 3
weight energy = 0.5
weight after = inf
disable calm
enable calm
replace low: y <= lift at 1
replace calm: at(x', 2)^2
scope low over [0, 1] count 5
bound y in [-2, g]
key 0.5: x = 1, y = 2
control y 3 = 0.25
adapt tolerance 1e-4 levels 3
lock level 2
delete after
iterate 2
reset
solve
)");
  ASSERT_TRUE(compiled.problem) << render(compiled.diagnostics.at(0), "scene", "");
  const auto& problem = *compiled.problem;
  const auto fault = validate(problem);
  ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
  const auto document = write(problem);
  EXPECT_EQ(read_problem(document), problem);
  EXPECT_TRUE(Schema("problem.schema.json").accepts(nlohmann::json::parse(document)));
  std::set<std::size_t> kinds;
  for (const auto& placed : problem.actions) kinds.insert(placed.action.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<Action>);
}

}  // namespace
}  // namespace spacetime
