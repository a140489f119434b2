#include "symbolic/command_complete.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/files.h"
#include "protocol/writer.h"
#include "symbolic/complete.h"

namespace spacetime::symbolic {
namespace {

struct Options {
  std::string file;
  int line = 1, column = 1;
  bool json = false;
};

std::string document(const std::vector<Completion>& all) {
  Writer to;
  to.object(
      [&] {
        to.member("format", "spacetime-completions/1");
        to.key("completions");
        to.list_of(
            all,
            [&](const Completion& one) {
              to.object([&] {
                to.member("label", one.label);
                to.member("kind", name_of(one.kind));
                to.member("detail", one.detail);
                to.member("insert", one.insert);
              });
            },
            Set::in_lines);
      },
      Set::in_lines);
  return to.take();
}

std::string table(const std::vector<Completion>& all) {
  std::size_t label = 0, kind = 0;
  for (const Completion& one : all)
    label = std::max(label, one.label.size()), kind = std::max(kind, name_of(one.kind).size());
  std::string out;
  for (const Completion& one : all) {
    const std::string_view name = name_of(one.kind);
    out.append(one.label).append(label + 2 - one.label.size(), ' ');
    out.append(name).append(kind + 2 - name.size(), ' ').append(one.detail).append("\n");
  }
  return out;
}

}  // namespace

Command add_complete(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("complete", "What could be written at a place of a scene, finished or not");
  command->add_option("FILE", options->file, "The scene, or - for standard input")->required();
  command->add_option("LINE", options->line, "The cursor's line, from 1")->required();
  command->add_option("COLUMN", options->column, "The column of the character behind it, from 1")->required();
  command->add_flag("--json", options->json, "Write a JSON document in place of a table");
  return {command, [options] {
            if (options->line < 1 || options->column < 1)
              throw InputError("lines and columns are counted from 1: there is no line " +
                               std::to_string(options->line) + ", column " + std::to_string(options->column));
            const auto all = complete(read_text(options->file), options->line, options->column);
            write_text("-", options->json ? document(all) : table(all));
            return 0;
          }};
}

}  // namespace spacetime::symbolic
