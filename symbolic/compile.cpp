#include "symbolic/compile.h"

#include <algorithm>
#include <chrono>

#include "symbolic/compiler.h"
#include "symbolic/model.h"
#include "symbolic/parser.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

constexpr std::size_t most_diagnostics = 200;  // more than anyone reads at once

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Scene parse_scene(std::string_view text, std::vector<Diagnostic>& diagnostics) {
  if (text.size() > largest_scene) {
    diagnostics.push_back({{1, 1, 1}, "the scene is larger than 16 MiB: split it", {}});
    return {};
  }
  Scene scene = parse(text, diagnostics);
  if (scene.statements.empty() && diagnostics.empty())
    diagnostics.push_back({{1, 1, 1}, "the scene is empty: begin it with a line such as 'time [0, 2]'", {}});
  return scene;
}

void put_in_order(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.span.line, a.span.column) < std::pair(b.span.line, b.span.column);
  });
  if (diagnostics.size() <= most_diagnostics) return;
  const std::size_t left = diagnostics.size() - most_diagnostics;
  diagnostics.resize(most_diagnostics);
  diagnostics.back().notes.push_back(
      {diagnostics.back().span, std::to_string(left) + " more mistakes follow and are left out"});
}

void report(Model& model, const Span& span, std::string message, std::vector<Diagnostic::Note> notes) {
  model.diagnostics.push_back({span, std::move(message), std::move(notes)});
}

std::string add_program(Model& model, std::span<const Expr> values, Derivatives derivatives) {
  if (!model.emits || !model.diagnostics.empty()) return {};
  const auto start = Clock::now();
  double differentiating = 0;
  Graph own;
  const std::vector<Expr> copied = copy(model.graph, model.fingerprints, values, own);
  const Programs::Emitted& emitted = model.programs.of(own, copied, derivatives, differentiating);
  if (model.problem.programs.try_emplace(emitted.key, emitted.program).second) {
    model.statistics.tree_nodes += emitted.tree_nodes;
    model.statistics.shared_nodes += emitted.shared_nodes;
    model.statistics.operations += emitted.program.op.size();
    ++model.statistics.programs;
  }
  model.statistics.milliseconds.differentiate += differentiating;
  model.statistics.milliseconds.emit += milliseconds_since(start) - differentiating;
  return emitted.key;
}

Compilation compile(std::string_view text) { return Compiler().compile(text); }

Compilation Compiler::compile(std::string_view text) {
  Compilation out;
  const auto start = Clock::now();
  const std::size_t derived = programs_.derived();
  const Scene scene = parse_scene(text, out.diagnostics);
  const double parsing = milliseconds_since(start);
  if (scene.statements.empty()) return out;
  out.outline = outline(scene);
  Model model(scene, programs_, out.diagnostics);
  elaborate_scene(model);
  put_in_order(out.diagnostics);
  out.statistics = model.statistics;
  out.statistics.derived = programs_.derived() - derived;
  auto& milliseconds = out.statistics.milliseconds;
  milliseconds.parse = parsing;
  milliseconds.total = milliseconds_since(start);
  milliseconds.build = milliseconds.total - milliseconds.parse - milliseconds.differentiate - milliseconds.emit;
  if (!out.diagnostics.empty()) return out;
  programs_.end_text();
  out.problem = std::move(model.problem);
  return out;
}

}  // namespace spacetime::symbolic
