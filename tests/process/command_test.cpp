// What spacetime-symbolic's commands say to a slip on the command line, and their exit codes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using Arguments = std::vector<std::string>;

constexpr const char* scene =
    "time [0, 1]\nconstant k = 2\ntrajectory bspline spans 4\ndof x\nlet y = k*x\nminimize effort: integral(x''^2)\n";

std::string file_with(const std::string& name, const std::string& text) {
  const std::string file = scratch(name);
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

Result symbolic(const Arguments& arguments, const std::string& input = "") {
  return run("spacetime-symbolic", arguments, input);
}

struct Slip {
  Arguments arguments;
  std::string said;  // on standard error
};

void expect_refused(const Slip& slip, const std::string& input = "") {
  const Result result = symbolic(slip.arguments, input);
  const std::string command = slip.arguments.empty() ? "" : slip.arguments.front();
  EXPECT_EQ(result.code, 1) << command;
  EXPECT_EQ(result.out, "") << command;
  EXPECT_NE(result.err.find(slip.said), std::string::npos) << command << ": " << result.err;
}

TEST(Commands, SayWhatIsMissingOrUnknown) {
  expect_refused({{}, "say what to do"});
  expect_refused({{"compose"}, "there is no command or option 'compose'"});
  for (const std::string command : {"compile", "print", "count", "complete"})
    expect_refused({{command}, "FILE is required"});
  for (const std::string command : {"compile", "print", "count", "format", "complete"})
    expect_refused({{command, "--colour"}, "--help"});
  expect_refused({{"complete", "-", "1"}, "COLUMN is required"}, scene);
  expect_refused({{"complete", "-", "0", "1"}, "there is no line 0, column 1"}, scene);
}

TEST(Commands, NameTheFileThatCannotBeReadOrWritten) {
  const std::string none = scratch("none.scene"), folder = std::filesystem::path(none).parent_path().string();
  for (const std::string command : {"compile", "print", "count", "format"}) {
    expect_refused({{command, none}, "cannot read '" + none + "'"});
    expect_refused({{command, folder}, "'" + folder + "': it is a directory"});
  }
  expect_refused({{"complete", none, "1", "1"}, "cannot read '" + none + "'"});
  const std::string file = file_with("fine.scene", scene);
  for (const std::string command : {"compile", "format"}) {
    expect_refused({{command, file, "-o", folder + "/no/where"}, "cannot write '" + folder + "/no/where'"});
    expect_refused({{command, file, "-o", folder}, "cannot write '" + folder + "'"});
  }
}

TEST(Commands, TellTheMistakesOfAScene) {
  const std::string file = file_with("wrong.scene", std::string(scene) + "let z = xx\n");
  for (const Arguments& arguments :
       {Arguments{"compile", file}, {"print", file}, {"print", file, "y"}, {"count", file}, {"format", file}})
    expect_refused({arguments, "wrong.scene:7:9: error: unknown name 'xx': did you mean 'x'?"});
  EXPECT_EQ(symbolic({"complete", file, "7", "9"}).code, 0);  // which is there for unfinished scenes
  const Result json = symbolic({"compile", file, "--json"});
  EXPECT_EQ(json.code, 1);
  EXPECT_EQ(json.out, "");
  EXPECT_EQ(nlohmann::json::parse(json.err).at("diagnostics").at(0).at("line"), 7);
}

TEST(Commands, SucceedWithoutAWordOnStandardError) {
  const std::string file = file_with("fine.scene", scene);
  for (const Arguments& arguments : {Arguments{"compile", file},
                                     {"print", file},
                                     {"print", file, "y", "--by", "k"},
                                     {"print", file, "effort", "--as", "latex"},
                                     {"print", file, "effort", "--as", "dot"},
                                     {"count", file, "--json"},
                                     {"format", file},
                                     {"complete", file, "5", "9", "--json"}}) {
    const Result result = symbolic(arguments);
    EXPECT_EQ(result.code, 0) << arguments.front();
    EXPECT_EQ(result.err, "") << arguments.front();
    EXPECT_NE(result.out, "") << arguments.front();
  }
  EXPECT_EQ(symbolic({"print", file, "y", "--by", "k"}).out, "let y_by_k = x\n");
}

TEST(Commands, PointIntoWhatWasAsked) {
  const std::string file = file_with("fine.scene", scene);
  for (const std::string command : {"print", "count"})
    for (const Slip& slip :
         std::vector<Slip>{{{"yy"}, "'yy':1:1: error: the scene has no 'yy': did you mean 'y'?"},
                           {{"y", "--by", "kk"}, "'kk':1:1: error: the scene has no 'kk': did you mean 'k'?"},
                           {{"y", "--by", "y"}, "a derivative is taken by"},
                           {{"--by", "x"}, "'--by' needs the name of what to differentiate"},
                           {{"x +"}, "'x +':1:4: error: expected a value, found the end of the text\nx +\n   ^"},
                           {{"(x"}, "'(x':1:3: error: expected ',' or ')', found the end of the text"},
                           {{" "}, "expected a value"},
                           {{"x)"}, "'x)':1:2: error: expected the end of the expression, found ')'"}}) {
      Arguments arguments{command, file};
      arguments.insert(arguments.end(), slip.arguments.begin(), slip.arguments.end());
      expect_refused({arguments, slip.said});
    }
  expect_refused({{"print", file, "y", "--as", "tex"}, "tex"});
}

}  // namespace
}  // namespace spacetime::test
