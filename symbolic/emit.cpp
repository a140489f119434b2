#include "symbolic/emit.h"

#include <algorithm>
#include <chrono>
#include <tuple>

#include "symbolic/derivative.h"
#include "symbolic/lowering.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

std::size_t key(Signed value) { return std::size_t{value.node.id} * 2 + (value.minus ? 1 : 0); }
std::size_t key(Expr leaf) { return key(Signed{leaf}); }

// How much of the program needs an operation.
enum Phase : std::uint8_t { for_values, for_jacobian, for_hessian, for_nothing };

struct Planned {
  Signed value;
  Operation operation;
  Phase phase = for_nothing;
};

// What has to be computed: phase by phase, and in each in the order in which the graph was built.  That is a better
// order than one in which every result is used as soon as it is there, which keeps more values alive and makes each
// operation wait for the one before.
class Plan {
 public:
  Plan(Graph& graph, Lowering& lowering) : graph_(graph), lowering_(lowering), phase_(2 * graph.size(), for_nothing) {}

  void want(Expr root, Phase phase) { want(lowering_.value(root), phase); }

  std::vector<Planned> operations() {
    std::vector<Planned> result;
    const auto plan = [&](Signed value) {
      const auto phase = phase_[key(value)];
      if (phase == for_nothing) return;
      const auto operation = lowering_.operation(value);
      for (int k = 0; k < info(operation.op).arity; ++k) want(operation.operand[k], phase);
      result.push_back({value, operation, phase});
    };
    for (std::size_t id = phase_.size() / 2; id-- > 0;) {
      const Signed plain{{static_cast<std::uint32_t>(id)}, false}, negated{plain.node, true};
      const bool plain_first = lowering_.is_made_by_negation(plain);  // then it wants the other
      plan(plain_first ? plain : negated);
      plan(plain_first ? negated : plain);
    }
    std::ranges::reverse(result);
    std::ranges::stable_sort(result, {}, &Planned::phase);
    return result;
  }

  const std::vector<Expr>& leaves() const { return leaves_; }

 private:
  bool is_leaf(Signed value) const { return !value.minus && graph_.node(value.node).kind != Graph::Kind::operation; }
  void want(Signed value, Phase phase) {
    if (is_leaf(value)) {
      leaves_.push_back(value.node);
    } else {
      phase_[key(value)] = std::min(phase_[key(value)], phase);
    }
  }

  Graph& graph_;
  Lowering& lowering_;
  std::vector<Phase> phase_;  // by key
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
  Plan plan(graph, lowering);
  for (const auto value : values) plan.want(value, for_values);
  for (const auto& entry : first) plan.want(entry.value, for_jacobian);
  for (const auto& entry : second) plan.want(entry.value, for_hessian);
  const auto operations = plan.operations();

  Program program;
  const auto end_of = [&](Phase phase) {
    return static_cast<std::int32_t>(std::ranges::upper_bound(operations, phase, {}, &Planned::phase) -
                                     operations.begin());
  };
  program.value_operations = end_of(for_values);
  program.jacobian_operations = end_of(for_jacobian);

  // Numbering: inputs, numbers, operations.
  std::vector<std::int32_t> index(2 * graph.size());
  const auto leaves = leaves_in_order(graph, plan.leaves(), inputs);
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
  for (const auto& planned : operations) {
    const auto& operation = planned.operation;
    const int arity = info(operation.op).arity;
    const auto operand = [&](int k) { return k < arity ? index[key(operation.operand[k])] : 0; };
    index[key(planned.value)] = program.value_count();
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
