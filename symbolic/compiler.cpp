#include "symbolic/compiler.h"

#include <cstring>

#include "common/program.h"

namespace spacetime::symbolic {
namespace {

template <class T>
void append(std::string& out, const T& value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

// Everything that determines the program, byte by byte: what is equal here is the same program, without a chance of
// two different ones being taken for each other.
std::string content(const Graph& graph, std::span<const Expr> values, Derivatives derivatives) {
  std::string out;
  out.reserve(24 * graph.size());
  append(out, derivatives);
  append(out, graph.size());
  for (std::uint32_t id = 0; id < graph.size(); ++id) {
    const Graph::Node& node = graph.node({id});
    append(out, node.kind);
    if (node.kind == Graph::Kind::operation) {
      append(out, node.op);
      for (const Expr operand : {node.a, node.b, node.c}) append(out, operand.id);
    } else if (node.kind == Graph::Kind::input) {
      const Input& input = graph.input_of({id});
      append(out, input.kind);
      append(out, input.index);
      append(out, input.derivative);
      append(out, input.name.size());
      out += input.name;
    } else {
      append(out, node.number);
    }
  }
  for (const Expr value : values) append(out, value.id);
  return out;
}

// Sizes of a program, derivatives included, as if it had not been lowered: a product and a sum rounded once count as
// two.
void count(Programs::Emitted& emitted) {
  const Program& program = emitted.program;
  const auto first = static_cast<std::size_t>(program.first_operation());
  std::vector<double> tree(static_cast<std::size_t>(program.value_count()), 1.0);
  const auto tree_of = [&](std::int32_t value) { return tree[static_cast<std::size_t>(value)]; };
  for (std::size_t i = 0; i < program.op.size(); ++i) {
    const int arity = info(program.op[i]).arity;
    double& size = tree[first + i];
    if (arity > 0) size += tree_of(program.a[i]);
    if (arity > 1) size += tree_of(program.b[i]);
    if (arity > 2) size += tree_of(program.c[i]);
    if (program.op[i] == Op::multiply_add) ++size, ++emitted.shared_nodes;
  }
  emitted.shared_nodes += tree.size();
  for (const auto value : program.values) emitted.tree_nodes += tree_of(value);
  for (const auto& entry : program.jacobian) emitted.tree_nodes += tree_of(entry.value);
  for (const auto& entry : program.hessian) emitted.tree_nodes += tree_of(entry.value);
}

}  // namespace

const Programs::Emitted& Programs::of(Graph& graph, std::span<const Expr> values, Derivatives derivatives,
                                      double& differentiating) {
  std::unique_ptr<Emitted>& known = programs_[content(graph, values, derivatives)];
  if (!known) {
    known = std::make_unique<Emitted>();
    known->program = emit(graph, values, derivatives, &differentiating);
    known->key = hash(known->program);
    count(*known);
    ++derived_;
  }
  known->used = text_;
  return *known;
}

void Programs::end_text() {
  std::erase_if(programs_, [&](const auto& entry) { return entry.second->used < text_ - 2; });
  ++text_;
}

}  // namespace spacetime::symbolic
