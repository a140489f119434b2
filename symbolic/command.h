// What the program's commands have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/diagnostic.h"

namespace spacetime::symbolic {

// A command whose options have been declared, and what to do once they have been read; that gives the exit code.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

// A scene's name in messages.
std::string shown(const std::string& file);

// To standard error, in colour for people who look at a terminal and have not asked for plain text (no-color.org).
void print(const std::vector<Diagnostic>& diagnostics, const std::string& file, std::string_view text);

}  // namespace spacetime::symbolic
