#include "symbolic/compile.h"

#include <algorithm>
#include <chrono>

#include "symbolic/model.h"
#include "symbolic/parser.h"
#include "symbolic/statement.h"

namespace spacetime::symbolic {
namespace {

constexpr std::size_t largest_scene = 16u << 20;  // bytes: far above anything written by hand or recorded
constexpr std::size_t most_diagnostics = 200;     // more than anyone reads at once

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Sizes of everything emitted, derivatives included, as if the programs had not been lowered: a product and a sum
// rounded once count as two.
void count(const Program& program, Statistics& statistics) {
  const auto first = static_cast<std::size_t>(program.first_operation());
  std::vector<double> tree(static_cast<std::size_t>(program.value_count()), 1.0);
  for (std::size_t i = 0; i < program.op.size(); ++i) {
    const int arity = info(program.op[i]).arity;
    double& size = tree[first + i];
    if (arity > 0) size += tree[static_cast<std::size_t>(program.a[i])];
    if (arity > 1) size += tree[static_cast<std::size_t>(program.b[i])];
    if (arity > 2) size += tree[static_cast<std::size_t>(program.c[i])];
    if (program.op[i] == Op::multiply_add) {
      ++size;
      ++statistics.shared_nodes;
    }
  }
  statistics.shared_nodes += tree.size();
  statistics.operations += program.op.size();
  for (const auto value : program.values) statistics.tree_nodes += tree[static_cast<std::size_t>(value)];
  for (const auto& entry : program.jacobian) statistics.tree_nodes += tree[static_cast<std::size_t>(entry.value)];
  for (const auto& entry : program.hessian) statistics.tree_nodes += tree[static_cast<std::size_t>(entry.value)];
}

void finish(std::vector<Diagnostic>& diagnostics) {
  std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.span.line, a.span.column) < std::pair(b.span.line, b.span.column);
  });
  if (diagnostics.size() <= most_diagnostics) return;
  const std::size_t left = diagnostics.size() - most_diagnostics;
  diagnostics.resize(most_diagnostics);
  diagnostics.back().notes.push_back(
      {diagnostics.back().span, std::to_string(left) + " more mistakes follow and are left out"});
}

}  // namespace

void report(Model& model, const Span& span, std::string message, std::vector<Diagnostic::Note> notes) {
  model.diagnostics.push_back({span, std::move(message), std::move(notes)});
}

std::string add_program(Model& model, std::span<const Expr> values, Derivatives derivatives) {
  if (!model.diagnostics.empty()) return {};
  const auto start = Clock::now();
  double differentiating = 0;
  Graph own;
  Program program = emit(own, copy(model.graph, model.fingerprints, values, own), derivatives, &differentiating);
  std::string key = hash(program);
  model.problem.programs.try_emplace(key, std::move(program));
  model.differentiate_milliseconds += differentiating;
  model.emit_milliseconds += milliseconds_since(start) - differentiating;
  return key;
}

Compilation compile(std::string_view text) {
  Compilation out;
  const auto start = Clock::now();
  if (text.size() > largest_scene) {
    out.diagnostics.push_back({{1, 1, 1}, "the scene is larger than 16 MiB: split it", {}});
    return out;
  }
  const Scene scene = parse(text, out.diagnostics);
  auto& milliseconds = out.statistics.milliseconds;
  milliseconds.parse = milliseconds_since(start);
  if (scene.statements.empty()) {
    if (out.diagnostics.empty())
      out.diagnostics.push_back({{1, 1, 1}, "the scene is empty: begin it with a line such as 'time [0, 2]'", {}});
    return out;
  }
  Model model(scene, out.diagnostics);
  elaborate_scene(model);
  finish(out.diagnostics);
  milliseconds.total = milliseconds_since(start);
  milliseconds.differentiate = model.differentiate_milliseconds;
  milliseconds.emit = model.emit_milliseconds;
  milliseconds.build = milliseconds.total - milliseconds.parse - milliseconds.differentiate - milliseconds.emit;
  if (!out.diagnostics.empty()) return out;
  for (const auto& [key, program] : model.problem.programs) count(program, out.statistics);
  out.statistics.programs = model.problem.programs.size();
  out.problem = std::move(model.problem);
  return out;
}

}  // namespace spacetime::symbolic
