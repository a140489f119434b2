#include "gui/command_render.h"

#include <memory>
#include <string>

#include "common/diagnostic.h"
#include "common/files.h"
#include "protocol/motion_json.h"

namespace spacetime::gui {
namespace {

struct Options {
  std::string motion, output;
};

int run(const Options& options) {
  const Motion motion = read_motion(read_text(options.motion));
  if (!motion.samples) {
    throw InputError("'" + options.motion + "' has no poses to draw: solve with '--samples 30'");
  }
  return 0;
}

}  // namespace

Command add_render(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Draws a motion into picture files, without a window");
  command->add_option("MOTION", options->motion, "The motion, a file or - for standard input")->required();
  command->add_option("-o,--output", options->output, "Where the pictures go")->required();
  return {command, [options] { return run(*options); }};
}

}  // namespace spacetime::gui
