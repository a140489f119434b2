// The documents of the example scenes: what the symbolic side makes can be used, what the optimizer makes can be read,
// and both are what the schemas say.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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

}  // namespace
}  // namespace spacetime
