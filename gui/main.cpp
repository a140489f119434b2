// spacetime-gui: looks at motions.
#include <CLI/CLI.hpp>
#include <iostream>

#include "common/diagnostic.h"
#include "gui/command_render.h"

int main(int argc, char** argv) {
  CLI::App app{"Shows motions: in a window, or as pictures in files.", "spacetime-gui"};
  app.set_version_flag("--version", "spacetime-gui " SPACETIME_VERSION);
  app.require_subcommand(0, 1);
  const spacetime::gui::Command commands[]{spacetime::gui::add_render(app)};
  try {
    app.parse(argc, argv);
    for (const auto& command : commands)
      if (command.app->parsed()) return command.run();
    std::cerr << app.help();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const spacetime::InputError& error) {
    std::cerr << "spacetime-gui: error: " << error.what() << '\n';
  }
  return 1;
}
