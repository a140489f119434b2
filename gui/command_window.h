// spacetime-gui [FILE]: the window.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace spacetime::gui {

// Adds the options of the window to the program itself; what runs it.
std::function<int()> add_window(CLI::App& app);

}  // namespace spacetime::gui
