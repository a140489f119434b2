// spacetime-gui: the window in which motions are made, and pictures of them without one.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "common/diagnostic.h"
#include "gui/command_render.h"
#include "gui/command_window.h"

int main(int argc, char** argv) {
  CLI::App app{
      "Designs motions in a window: see them, run the optimiser, steer it, undo.\n"
      "With `render`: pictures of a motion in files, without a window.",
      "spacetime-gui"};
  app.set_version_flag("--version", "spacetime-gui " SPACETIME_VERSION);
  app.require_subcommand(0, 1);
  const spacetime::gui::Command commands[]{spacetime::gui::add_render(app)};
  const auto window = spacetime::gui::add_window(app);
  try {
    app.parse(argc, argv);
    for (const auto& command : commands)
      if (command.app->parsed()) return command.run();
    return window();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const spacetime::InputError& error) {
    std::cerr << "spacetime-gui: error: " << error.what() << '\n';
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << "spacetime-gui: error: " << error.what() << '\n';
  }
  return 1;
}
