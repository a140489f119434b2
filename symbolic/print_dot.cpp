#include <string_view>

#include "symbolic/functional.h"
#include "symbolic/print.h"
#include "symbolic/value.h"
#include "symbolic/written_number.h"

namespace spacetime::symbolic {
namespace {

std::string quoted_label(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string label(const Model& model, Expr e) {
  const Graph::Node& node = model.graph.node(e);
  switch (node.kind) {
    case Graph::Kind::number:
      return written(node.number);
    case Graph::Kind::pi:
      return node.number == 1 ? "pi" : written(node.number) + " pi";
    case Graph::Kind::operation:
      return std::string(info(node.op).name);
    case Graph::Kind::input:
      break;
  }
  const Input& input = model.graph.input_of(e);
  if (input.kind == InputKind::time) return "t";
  if (input.kind != InputKind::functional)
    return input.name + std::string(static_cast<std::size_t>(input.derivative), '\'');
  const auto kind = model.functionals[static_cast<std::size_t>(input.index)].kind;
  return kind == Functional::Kind::at ? "at" : "integral";
}

// What a node is made of; of a functional its integrand and times.
std::vector<Expr> operands(const Model& model, Expr e) {
  const Graph::Node& node = model.graph.node(e);
  if (node.kind == Graph::Kind::operation) {
    std::vector<Expr> out{node.a, node.b, node.c};
    out.resize(static_cast<std::size_t>(info(node.op).arity));
    return out;
  }
  if (node.kind != Graph::Kind::input || model.graph.input_of(e).kind != InputKind::functional) return {};
  const FunctionalUse& use = model.functionals[static_cast<std::size_t>(model.graph.input_of(e).index)];
  std::vector<Expr> out{use.integrand};
  if (use.from) out.push_back(*use.from);
  if (use.to) out.push_back(*use.to);
  return out;
}

}  // namespace

std::string print_dot(Model& model, std::span<const Expr> values, const std::string& title) {
  std::vector<Expr> roots(values.begin(), values.end());
  for (const int k : all_functionals_in(model, values)) {
    const FunctionalUse& use = model.functionals[static_cast<std::size_t>(k)];
    roots.push_back(use.integrand);
    if (use.from) roots.push_back(*use.from);
    if (use.to) roots.push_back(*use.to);
  }
  std::string out = "digraph " + quoted_label(title) + " {\n  ordering=out;\n";
  const auto needed = reachable(model.graph, roots);
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const std::string node = "n" + std::to_string(id);
    const bool leaf = operands(model, {id}).empty();
    out += "  " + node + " [label=" + quoted_label(label(model, {id})) + (leaf ? ", shape=box" : "") + "];\n";
    for (const Expr operand : operands(model, {id})) out += "  " + node + " -> n" + std::to_string(operand.id) + ";\n";
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string name = values.size() == 1 ? title : title + " " + std::to_string(i + 1);
    const std::string root = "r" + std::to_string(i);
    out += "  " + root + " [label=" + quoted_label(name) + ", shape=plaintext];\n";
    out += "  " + root + " -> n" + std::to_string(values[i].id) + ";\n";
  }
  return out + "}\n";
}

}  // namespace spacetime::symbolic
