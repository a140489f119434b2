#include "symbolic/emit.h"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "symbolic/derivative.h"
#include "symbolic/lowering.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

bool is_leaf(const Graph& graph, Expr e) { return graph.node(e).kind != Graph::Kind::operation; }

std::size_t key(Signed value) { return std::size_t{value.node.id} * 2 + (value.minus ? 1 : 0); }
std::size_t key(Expr leaf) { return key(Signed{leaf}); }

// Writes operations in an order in which each is computed shortly before it is needed.
class Schedule {
 public:
  Schedule(Graph& graph, Lowering& lowering) : graph_(graph), lowering_(lowering) {}

  void compute(Expr root) {
    std::vector<std::pair<Signed, Operation>> stack;
    // Whether the value has to be made first.
    const auto visit = [&](Signed value) {
      if (is_leaf(graph_, value.node) && !value.minus) {
        leaves_.push_back(value.node);
        return false;
      }
      if (is_done(value)) return false;
      stack.emplace_back(value, lowering_.operation(value));
      return true;
    };
    visit(lowering_.value(root));
    while (!stack.empty()) {
      const auto [value, operation] = stack.back();
      bool ready = true;
      for (int k = 0; k < info(operation.op).arity && ready; ++k) ready = !visit(operation.operand[k]);
      if (!ready) continue;
      stack.pop_back();
      if (is_done(value)) continue;
      done_[key(value)] = true;
      rows_.emplace_back(value, operation);
    }
  }

  const std::vector<std::pair<Signed, Operation>>& rows() const { return rows_; }
  const std::vector<Expr>& leaves() const { return leaves_; }

 private:
  bool is_done(Signed value) {
    if (key(value) >= done_.size()) done_.resize(2 * graph_.size());
    return done_[key(value)];
  }

  Graph& graph_;
  Lowering& lowering_;
  std::vector<bool> done_;  // by key
  std::vector<std::pair<Signed, Operation>> rows_;
  std::vector<Expr> leaves_;
};

auto order_of(const Input& input) { return std::tie(input.kind, input.name, input.index, input.derivative); }

// The unknowns that the values depend on, in the order that programs list them.
std::vector<Expr> unknowns(const Graph& graph, std::span<const Expr> values) {
  const auto needed = reachable(graph, values);
  std::vector<Expr> result;
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (needed[id] && graph.node({id}).kind == Graph::Kind::input && is_unknown(graph.input_of({id}).kind)) {
      result.push_back({id});
    }
  }
  std::ranges::sort(result, [&](Expr x, Expr y) { return order_of(graph.input_of(x)) < order_of(graph.input_of(y)); });
  return result;
}

// Each once: inputs in the order that programs list them, then numbers by size.
std::vector<Expr> leaves_in_order(const Graph& graph, std::vector<Expr> leaves, std::span<const Expr> inputs) {
  leaves.insert(leaves.end(), inputs.begin(), inputs.end());
  std::ranges::sort(leaves);
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  std::ranges::sort(leaves, [&](Expr x, Expr y) {
    const auto a = graph.constant(x), b = graph.constant(y);
    if (a || b) return a && b ? *a < *b : b.has_value();
    return order_of(graph.input_of(x)) < order_of(graph.input_of(y));
  });
  return leaves;
}

// d2 (sum_i multiplier_i values[i]).
std::vector<Entry> contracted_hessian(Graph& graph, std::span<const Expr> values, std::span<const Expr> inputs) {
  const auto multiplier = [&](std::size_t i) {
    return graph.input({.kind = InputKind::multiplier, .name = {}, .index = static_cast<int>(i)});
  };
  if (values.size() == 1) return hessian(graph, values[0], inputs, multiplier(0));
  Expr sum;
  for (std::size_t i = 0; i < values.size(); ++i) sum = graph.add(sum, graph.multiply(multiplier(i), values[i]));
  return hessian(graph, sum, inputs);
}

}  // namespace

Program emit(Graph& graph, std::span<const Expr> values, Derivatives derivatives, double* differentiating) {
  const auto start = std::chrono::steady_clock::now();
  const auto inputs = unknowns(graph, values);
  std::vector<Entry> first, second;
  if (derivatives != Derivatives::none) first = jacobian(graph, values, inputs);
  if (derivatives == Derivatives::second) second = contracted_hessian(graph, values, inputs);
  if (differentiating) {
    *differentiating += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }

  std::vector<Expr> roots(values.begin(), values.end());
  for (const auto& entry : first) roots.push_back(entry.value);
  for (const auto& entry : second) roots.push_back(entry.value);
  Lowering lowering(graph, roots);
  Schedule schedule(graph, lowering);
  Program program;
  for (const auto value : values) schedule.compute(value);
  program.value_operations = static_cast<std::int32_t>(schedule.rows().size());
  for (const auto& entry : first) schedule.compute(entry.value);
  program.jacobian_operations = static_cast<std::int32_t>(schedule.rows().size());
  for (const auto& entry : second) schedule.compute(entry.value);

  // Numbering: inputs, numbers, operations.
  std::vector<std::int32_t> index(2 * graph.size());
  const auto leaves = leaves_in_order(graph, schedule.leaves(), inputs);
  for (const auto leaf : leaves) {
    const auto number = graph.constant(leaf);
    if (!number) {
      index[key(leaf)] = static_cast<std::int32_t>(program.inputs.size());
      program.inputs.push_back(graph.input_of(leaf));
      continue;
    }
    if (program.numbers.empty() || program.numbers.back() != *number) program.numbers.push_back(*number);
    index[key(leaf)] = program.value_count() - 1;
  }
  for (const auto& [value, operation] : schedule.rows()) {
    const int arity = info(operation.op).arity;
    const auto operand = [&](int k) { return k < arity ? index[key(operation.operand[k])] : 0; };
    index[key(value)] = program.value_count();
    program.op.push_back(operation.op);
    program.a.push_back(operand(0));
    program.b.push_back(operand(1));
    program.c.push_back(operand(2));
  }
  const auto index_of = [&](Expr root) { return index[key(lowering.value(root))]; };
  for (const auto value : values) program.values.push_back(index_of(value));
  for (const auto& entry : first) {
    program.jacobian.push_back({entry.row, index_of(inputs[entry.column]), index_of(entry.value)});
  }
  for (const auto& entry : second) {
    program.hessian.push_back({index_of(inputs[entry.row]), index_of(inputs[entry.column]), index_of(entry.value)});
  }
  return program;
}

Size size_of(const Graph& graph, std::span<const Expr> roots) {
  const auto needed = reachable(graph, roots);
  std::vector<double> tree(needed.size());
  Size size;
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    ++size.shared;
    const auto& n = graph.node({id});
    tree[id] = 1;
    if (n.kind != Graph::Kind::operation) continue;
    const Expr operands[] = {n.a, n.b, n.c};
    for (int k = 0; k < info(n.op).arity; ++k) tree[id] += tree[operands[k].id];
  }
  for (const auto root : roots) size.tree += tree[root.id];
  return size;
}

}  // namespace spacetime::symbolic
