// spacetime-gui render: pictures of a motion, without a window.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace spacetime::gui {

struct Command {
  CLI::App* app;
  std::function<int()> run;  // the exit code; throws InputError
};

Command add_render(CLI::App& app);

}  // namespace spacetime::gui
