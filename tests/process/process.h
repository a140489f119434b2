// Runs our programs as a person or a script would.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace spacetime::test {

struct Result {
  int code = -1;  // exit code, or 128 + signal
  std::string out, err;
};

// Starts bin/<program> with the arguments, feeds it `input`, and waits.  With `interrupt_after`, sends SIGINT once that
// text has appeared on its standard error.  A program that runs longer than a minute is killed.
Result run(const std::string& program, const std::vector<std::string>& arguments, const std::string& input = "",
           const std::string& interrupt_after = "");

// spacetime-symbolic compile | spacetime-optimizer solve ARGUMENTS...
Result solve_scene(const std::string& scene_text, const std::vector<std::string>& arguments = {});

std::string text_of(const std::string& path);            // relative to the source tree
std::string scratch(const std::string& name);            // a path in a fresh directory of this test process
std::string without_seconds(const std::string& motion);  // the document with its times set to 0

}  // namespace spacetime::test
