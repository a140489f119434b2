// `spacetime-symbolic format` as a person or an editor runs it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/process/process.h"

namespace spacetime::test {
namespace {

constexpr const char* loose = "time [0,1]\ntrajectory bspline spans 4\ndof x # free\nminimize integral( x''^2 )\n";
constexpr const char* tidy = "time [0, 1]\ntrajectory bspline spans 4\ndof x  # free\nminimize integral(x''^2)\n";

Result format(const std::vector<std::string>& arguments, const std::string& input = "") {
  std::vector<std::string> all{"format"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return run("spacetime-symbolic", all, input);
}

std::string with(const std::string& name, const std::string& text) {
  const std::string file = scratch(name);
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string content(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(FormatCommand, WritesToStandardOutputUnlessTold) {
  EXPECT_EQ(format({}, loose).out, tidy);
  EXPECT_EQ(format({"-"}, loose).out, tidy);
  const std::string file = with("loose.scene", loose), output = scratch("tidy.scene");
  EXPECT_EQ(format({file}).out, tidy);
  EXPECT_EQ(format({file, "-o", output}).out, "");
  EXPECT_EQ(content(output), tidy);
  EXPECT_EQ(content(file), loose);
}

TEST(FormatCommand, InPlaceLeavesNothingElseBehind) {
  const std::string file = with("in_place.scene", loose);
  EXPECT_EQ(format({"--in-place", file}).code, 0);
  EXPECT_EQ(content(file), tidy);
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(file).parent_path()))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  const auto before = std::filesystem::last_write_time(file);
  EXPECT_EQ(format({"--in-place", file}).code, 0);
  EXPECT_EQ(std::filesystem::last_write_time(file), before);
  EXPECT_EQ(format({"--in-place", "-"}, loose).code, 1);
}

TEST(FormatCommand, CheckTellsAndWritesNothing) {
  const std::string file = with("check.scene", loose);
  const Result found = format({"--check", file});
  EXPECT_EQ(found.code, 1);
  EXPECT_EQ(found.out, "");
  EXPECT_NE(found.err.find("check.scene"), std::string::npos);
  EXPECT_EQ(content(file), loose);
  EXPECT_EQ(format({"--check"}, tidy).code, 0);
}

TEST(FormatCommand, MistakesRefuseIt) {
  for (const std::string wrong : {"minimize integral(y)\n", "minimize integral(x\n"}) {
    const std::string text = loose + wrong, file = with("wrong.scene", text);
    const Result refused = format({"--in-place", file});
    EXPECT_EQ(refused.code, 1);
    EXPECT_NE(refused.err.find("wrong.scene:5:"), std::string::npos) << refused.err;
    EXPECT_EQ(content(file), text);
    EXPECT_EQ(format({file}).out, "");
  }
}

}  // namespace
}  // namespace spacetime::test
