#include "symbolic/command_print.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "common/files.h"
#include "protocol/writer.h"
#include "symbolic/query.h"

namespace spacetime::symbolic {
namespace {

struct Options {
  std::string file, what, by, as = "text";
  bool json = false;
};

// Of the terminal the output goes to.
std::size_t columns() {
  winsize size{};
  if (isatty(STDOUT_FILENO) != 1 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return usual_width;
  return size.ws_col;
}

// Nothing where the scene has mistakes, which are printed.
std::unique_ptr<Understood> read_scene(const std::string& file) {
  const std::string text = read_text(file);
  auto out = understand(text);
  print(out->diagnostics, shown(file), text);
  return out->diagnostics.empty() ? std::move(out) : nullptr;
}

void print_refusal(const Answer& answer) { print(answer.diagnostics, "'" + answer.asked + "'", answer.asked); }

// Rows of cells, columns aligned; the first to the left, `right` of the others to the right.
void print_table(const std::vector<std::vector<std::string>>& rows, std::size_t first_right) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      line += (i > 0 ? "  " : "") + (i >= first_right ? space + row[i] : row[i] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    std::cout << line << '\n';
  }
}

std::string text_of_count(double count) {
  char text[32];
  std::snprintf(text, sizeof text, count < 1e6 ? "%.0f" : "%.3g", count);
  return text;
}

int list(Understood& scene) {
  std::vector<std::vector<std::string>> rows{{"name", "what it is", "components", "nodes"}};
  for (const Printable& printable : printable(scene))
    rows.push_back({printable.name, printable.what, std::to_string(printable.values.size()),
                    std::to_string(size_of(scene.model.graph, printable.values).shared)});
  print_table(rows, 2);
  return 0;
}

void refuse_derivative_of_nothing(const Options& options) {
  if (options.what.empty() && !options.by.empty())
    throw InputError("'--by' needs the name of what to differentiate before it");
}

int run_print(const Options& options) {
  refuse_derivative_of_nothing(options);
  const auto scene = read_scene(options.file);
  if (!scene) return 1;
  if (options.what.empty()) {
    return list(*scene);
  }
  const Answer answer = query(*scene, options.what, options.by);
  if (!answer) return print_refusal(answer), 1;
  const PrintedNames names = names_for(*scene, answer);
  if (options.as == "dot")
    std::cout << print_dot(scene->model, answer.values, options.what);
  else if (options.as == "latex")
    std::cout << print_latex(read(scene->model, answer.values), answer.name, names.part == "s" ? "s" : "\\sigma");
  else
    std::cout << print_text(read(scene->model, answer.values), names, columns());
  return 0;
}

void print_sizes(Understood& scene, const std::vector<Printable>& all) {
  std::vector<std::vector<std::string>> rows{
      {"name", "tree nodes", "shared", "operations: values", "with Jacobian", "with Hessian"}};
  for (const Printable& printable : all) {
    const Sizes sizes = sizes_of(scene, printable.values);
    rows.push_back({printable.name, text_of_count(sizes.nodes.tree), std::to_string(sizes.nodes.shared),
                    std::to_string(sizes.values), std::to_string(sizes.jacobian), std::to_string(sizes.hessian)});
  }
  print_table(rows, 1);
}

// {"format": "spacetime-sizes/1", "file": "throw.scene",
//  "expressions": [{"name": "arm.force", "tree_nodes": 469, "shared_nodes": 80,
//                   "operations": {"values": 49, "jacobian": 107, "hessian": 193}}]}
std::string json_of_sizes(Understood& scene, const std::vector<Printable>& all, const std::string& file) {
  Writer to;
  const auto one = [&](const Printable& printable) {
    const Sizes sizes = sizes_of(scene, printable.values);
    to.object([&] {
      to.member("name", printable.name);
      to.member("tree_nodes", sizes.nodes.tree);
      to.member("shared_nodes", static_cast<int>(sizes.nodes.shared));
      to.key("operations");
      to.object([&] {
        to.member("values", static_cast<int>(sizes.values));
        to.member("jacobian", static_cast<int>(sizes.jacobian));
        to.member("hessian", static_cast<int>(sizes.hessian));
      });
    });
  };
  to.object(
      [&] {
        to.member("format", "spacetime-sizes/1");
        to.member("file", file);
        to.key("expressions");
        to.list_of(all, one, Set::in_lines);
      },
      Set::in_lines);
  return to.take();
}

int run_count(const Options& options) {
  refuse_derivative_of_nothing(options);
  const auto scene = read_scene(options.file);
  if (!scene) return 1;
  std::vector<Printable> all;
  if (options.what.empty()) {
    all = printable(*scene);
  } else {
    Answer answer = query(*scene, options.what, options.by);
    if (!answer) return print_refusal(answer), 1;
    all.push_back({options.what, answer.what, std::move(answer.values)});
  }
  if (options.json)
    std::cout << json_of_sizes(*scene, all, shown(options.file));
  else
    print_sizes(*scene, all);
  return 0;
}

}  // namespace

Command add_print(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("print", "Print an expression of a scene, factored for reading");
  command->add_option("FILE", options->file, "The scene, or - for standard input")->required();
  command->add_option("NAME", options->what,
                      "A name of the scene, such as arm.force, or any expression; without it: what can be printed");
  command->add_option("--by", options->by,
                      "Print the derivative by this degree of freedom (or \"arm.elbow'\"), constant or parameter");
  command->add_option("--as", options->as, "text (of the scene language, the default), latex or dot (for Graphviz)")
      ->check(CLI::IsMember({"text", "latex", "dot"}));
  command->footer(
      "Examples:\n"
      "  spacetime-symbolic print throw.scene                             what can be printed\n"
      "  spacetime-symbolic print throw.scene arm.force --by arm.elbow    a derivative\n"
      "  spacetime-symbolic print throw.scene \"arm.hand.x'\"              any expression\n"
      "  spacetime-symbolic print throw.scene energy --as latex           an objective's integrand");
  return {command, [options] { return run_print(*options); }};
}

Command add_count(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("count", "Count the nodes and operations of a scene's expressions");
  command->add_option("FILE", options->file, "The scene, or - for standard input")->required();
  command->add_option("NAME", options->what, "As for print; without it: everything");
  command->add_option("--by", options->by, "Count the derivative, as for print");
  command->add_flag("--json", options->json, "Write the figures as a JSON document");
  return {command, [options] { return run_count(*options); }};
}

}  // namespace spacetime::symbolic
