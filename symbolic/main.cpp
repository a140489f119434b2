// spacetime-symbolic: scene text in, a problem or diagnostics out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>

#include "protocol/problem_json.h"
#include "symbolic/compile.h"

namespace {

using spacetime::InputError;

std::string read(const std::string& file) {
  if (file == "-") return {std::istreambuf_iterator<char>(std::cin), {}};
  if (std::filesystem::is_directory(file)) throw InputError("cannot read '" + file + "': it is a directory");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError("cannot read '" + file + "': " + std::generic_category().message(errno));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw InputError("cannot read '" + file + "' to its end");
  return text;
}

// Beside the file first, so that a reader never sees half a document.
void write(const std::string& file, const std::string& document) {
  if (file.empty()) {
    std::cout << document << std::flush;
    if (!std::cout) throw InputError("cannot write to standard output");
    return;
  }
  const std::string beside = file + ".part";
  std::ofstream out(beside, std::ios::binary);
  out << document << std::flush;
  if (!out) throw InputError("cannot write '" + beside + "'");
  out.close();
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) throw InputError("cannot rename '" + beside + "' to '" + file + "': " + error.message());
}

void print(const spacetime::symbolic::Statistics& s) {
  const auto& ms = s.milliseconds;
  std::fprintf(stderr,
               "tree nodes %.0f, shared %zu, operations %zu, programs %zu\n"
               "ms: parse %.2f, build %.2f, differentiate %.2f, emit %.2f, total %.2f\n",
               s.tree_nodes, s.shared_nodes, s.operations, s.programs, ms.parse, ms.build, ms.differentiate, ms.emit,
               ms.total);
}

int compile(const std::string& file, const std::string& output, bool statistics) {
  const std::string text = read(file);
  const auto result = spacetime::symbolic::compile(text);
  // Columns do not count a byte-order mark.
  const std::string_view shown = std::string_view(text).substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  for (const auto& diagnostic : result.diagnostics)
    std::cerr << render(diagnostic, file == "-" ? "<standard input>" : file, shown);
  if (statistics) print(result.statistics);
  if (!result.problem) return 1;
  write(output, spacetime::write(*result.problem));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Turns scenes of motion into problems that spacetime-optimizer solves."};
  app.set_version_flag("--version", "spacetime-symbolic " SPACETIME_VERSION);
  app.require_subcommand(1);
  std::string file, output;
  bool statistics = false;
  CLI::App* command =
      app.add_subcommand("compile", "Compile a scene: the problem to standard output, mistakes to standard error");
  command->add_option("FILE", file, "The scene, or - for standard input")->required();
  command->add_option("-o,--output", output, "Write the problem to this file");
  command->add_flag("--statistics", statistics, "Print sizes and times to standard error");
  try {
    app.parse(argc, argv);
    return compile(file, output, statistics);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "spacetime-symbolic: " << error.what() << '\n';
    return 1;
  }
}
