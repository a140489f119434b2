// spacetime-symbolic: scene text in, a problem or diagnostics out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/files.h"
#include "protocol/diagnostics_json.h"
#include "protocol/problem_json.h"
#include "protocol/serve_command.h"
#include "symbolic/command.h"
#include "symbolic/command_complete.h"
#include "symbolic/command_format.h"
#include "symbolic/command_print.h"
#include "symbolic/compile.h"
#include "symbolic/server.h"

namespace {

using spacetime::symbolic::print, spacetime::symbolic::shown;

void print(const spacetime::symbolic::Statistics& s) {
  const auto& ms = s.milliseconds;
  std::fprintf(stderr,
               "tree nodes %.0f, shared %zu, operations %zu, programs %zu\n"
               "ms: parse %.2f, build %.2f, differentiate %.2f, emit %.2f, total %.2f\n",
               s.tree_nodes, s.shared_nodes, s.operations, s.programs, ms.parse, ms.build, ms.differentiate, ms.emit,
               ms.total);
}

struct Options {
  std::string file = "-", output = "-";
  bool json = false, statistics = false;
};

int compile(const Options& options) {
  const std::string text = spacetime::read_text(options.file);
  const auto result = spacetime::symbolic::compile(text);
  if (options.json)
    std::cerr << spacetime::write_diagnostics(result.diagnostics, shown(options.file));
  else
    print(result.diagnostics, shown(options.file), text);
  if (options.statistics) print(result.statistics);
  if (!result.problem) return 1;
  spacetime::write_text(options.output, spacetime::write(*result.problem));
  return 0;
}

spacetime::symbolic::Command add_serve(CLI::App& app) {
  const auto options = std::make_shared<spacetime::protocol::ServerOptions>();
  return {spacetime::protocol::add_serve_command(app, *options), [options] {
            spacetime::protocol::serve(spacetime::symbolic::service(), *options);
            return 0;
          }};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Turns scenes of motion into problems that spacetime-optimizer solves."};
  app.set_version_flag("--version", "spacetime-symbolic " SPACETIME_VERSION);
  app.require_subcommand(0, 1);
  Options options;
  CLI::App* command =
      app.add_subcommand("compile", "Compile a scene: the problem to standard output, mistakes to standard error");
  command->add_option("FILE", options.file, "The scene, or - for standard input")->required();
  command->add_option("-o,--output", options.output, "Write the problem to this file");
  command->add_flag("--json", options.json,
                    "Write the mistakes as a JSON document (an empty list where there are none)");
  command->add_flag("--statistics", options.statistics, "Print sizes and times to standard error");
  using spacetime::symbolic::Command;
  const Command others[]{spacetime::symbolic::add_print(app), spacetime::symbolic::add_count(app),
                         spacetime::symbolic::add_format(app), spacetime::symbolic::add_complete(app), add_serve(app)};
  app.allow_extras();
  try {
    app.parse(argc, argv);
    const std::vector<std::string> rest = app.remaining();
    if (command->parsed() && rest.empty()) return compile(options);
    for (const Command& other : others)
      if (other.app->parsed() && rest.empty()) return other.run();
    if (rest.empty()) throw spacetime::InputError("say what to do: 'spacetime-symbolic compile FILE', or --help");
    throw spacetime::InputError("there is no command or option '" + rest.front() +
                                "': write 'spacetime-symbolic compile FILE', or --help");
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "spacetime-symbolic: " << error.what() << '\n';
    return 1;
  }
}
