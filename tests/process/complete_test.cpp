// `spacetime-symbolic complete` as an editor runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/process/process.h"

namespace spacetime::test {
namespace {

constexpr const char* unfinished = "constant gain = 2\ndof x\nlet y = ga + (\n";

TEST(CompleteCommand, PrintsATable) {
  const Result result = run("spacetime-symbolic", {"complete", "-", "3", "11"}, unfinished);
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.out, "gain  constant  constant gain = 2\n");
}

TEST(CompleteCommand, WritesADocument) {
  const Result result = run("spacetime-symbolic", {"complete", "-", "3", "11", "--json"}, unfinished);
  const auto document = nlohmann::json::parse(result.out);
  EXPECT_EQ(document.at("format"), "spacetime-completions/1");
  ASSERT_EQ(document.at("completions").size(), 1U);
  const nlohmann::json expected{
      {"label", "gain"}, {"kind", "constant"}, {"detail", "constant gain = 2"}, {"insert", "gain"}};
  EXPECT_EQ(document.at("completions").at(0), expected);
}

TEST(CompleteCommand, RefusesPlacesThatAreNone) {
  EXPECT_EQ(run("spacetime-symbolic", {"complete", "-", "0", "1"}, unfinished).code, 1);
  EXPECT_EQ(run("spacetime-symbolic", {"complete", "-", "1"}, unfinished).code, 1);
}

}  // namespace
}  // namespace spacetime::test
