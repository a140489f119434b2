#include "symbolic/command_format.h"

#include <iostream>
#include <memory>

#include "common/files.h"
#include "symbolic/compile.h"
#include "symbolic/format.h"

namespace spacetime::symbolic {
namespace {

struct Options {
  std::string file = "-", output = "-";
  bool in_place = false, check = false;
};

int run_format(const Options& options) {
  if (options.in_place && options.file == "-")
    throw InputError("'format --in-place' needs a file: standard input is formatted to standard output");
  const std::string text = read_text(options.file);
  const auto diagnostics = compile(text).diagnostics;
  print(diagnostics, shown(options.file), text);
  if (!diagnostics.empty()) return 1;
  const std::string formatted = format(text).text.value();
  if (options.check) {
    if (formatted == text) return 0;
    std::cerr << shown(options.file) << ": is not formatted: 'spacetime-symbolic format --in-place' does it\n";
    return 1;
  }
  if (options.in_place && formatted == text) return 0;
  write_text(options.in_place ? options.file : options.output, formatted);
  return 0;
}

}  // namespace

Command add_format(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "format", "Write a scene in its canonical layout; one with mistakes is refused and nothing is written");
  command->add_option("FILE", options->file, "The scene, or - for standard input (the default)");
  auto* output = command->add_option("-o,--output", options->output, "Write it to this file");
  auto* in_place = command->add_flag("-i,--in-place", options->in_place, "Write it in place of the scene");
  auto* check = command->add_flag("--check", options->check, "Write nothing: exit with 1 where it would change");
  in_place->excludes(output)->excludes(check);
  check->excludes(output);
  return {command, [options] { return run_format(*options); }};
}

}  // namespace spacetime::symbolic
