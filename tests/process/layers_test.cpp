// The rule between the parts: common <- protocol <- {symbolic, optimizer, gui}, and never one another.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace spacetime::test {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> allowed = {
    {"common", {"common"}},
    {"protocol", {"common", "protocol"}},
    {"symbolic", {"common", "protocol", "symbolic"}},
    {"optimizer", {"common", "protocol", "optimizer"}},
    {"gui", {"common", "protocol", "gui"}},
};

TEST(Layers, EachPartIncludesOnlyWhatItMay) {
  int files = 0;
  for (const auto& [part, may] : allowed) {
    const fs::path folder = fs::path(SPACETIME_SOURCE_DIR) / part;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl") continue;
      ++files;
      // Within a daemon only its main, its commands and its server know documents and messages.
      const std::string stem = entry.path().stem().string();
      const bool edge =
          part == "protocol" || stem == "main" || stem.starts_with("server") || stem.starts_with("command");
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("#include \"")) continue;
        const std::string included = line.substr(10, line.find('/') - 10);
        EXPECT_TRUE(may.contains(included)) << entry.path() << ": " << line;
        if ((part == "symbolic" || part == "optimizer") && !edge) {
          EXPECT_NE(included, "protocol") << entry.path() << ": " << line;
        }
      }
    }
  }
  EXPECT_GT(files, 40);
}

}  // namespace
}  // namespace spacetime::test
