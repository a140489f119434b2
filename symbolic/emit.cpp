#include "symbolic/emit.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>

#include "symbolic/derivative.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

std::array<Expr, 3> operands(const Graph::Node& n) { return {n.a, n.b, n.c}; }

bool is_leaf(const Graph::Node& n) { return n.kind != Graph::Kind::operation; }

// One operation of the program while its operands are still expressions.
struct Row {
  Op op = Op::add;
  std::array<Expr, 3> operand;
};

// What a node becomes: itself, or a product fused with the sum that alone uses it.
class Lowering {
 public:
  Lowering(Graph& graph, std::span<const Expr> roots) : graph_(graph), uses_(graph.size()) {
    const auto needed = reachable(graph, roots);
    for (const auto root : roots) uses_[root.id] += 2;  // an output is never fused away
    for (std::uint32_t id = 0; id < needed.size(); ++id) {
      const auto& n = graph.node({id});
      if (!needed[id] || is_leaf(n)) continue;
      for (int k = 0; k < info(n.op).arity; ++k) ++uses_[operands(n)[k].id];
    }
  }

  Row row(Expr e) {
    const auto n = graph_.node(e);
    if (n.op == Op::add) {
      for (const auto& [product, other] : {std::pair(n.b, n.a), std::pair(n.a, n.b)}) {
        if (!fuses(product)) continue;
        const auto& p = graph_.node(product);
        return {Op::multiply_add, {p.a, p.b, other}};
      }
    }
    if (n.op == Op::subtract && fuses(n.b)) {
      const auto p = graph_.node(n.b);
      if (graph_.constant(p.a)) return {Op::multiply_add, {graph_.negate(p.a), p.b, n.a}};
    }
    return {n.op, operands(n)};
  }

 private:
  bool fuses(Expr e) const { return graph_.is_operation(e, Op::multiply) && uses_[e.id] == 1; }

  Graph& graph_;
  std::vector<std::uint32_t> uses_;
};

// Writes operations in an order in which each is computed shortly before it is needed.
class Scheduler {
 public:
  Scheduler(Graph& graph, Lowering& lowering) : graph_(graph), lowering_(lowering), done_(graph.size()) {}

  void compute(Expr root) {
    std::vector<std::pair<Expr, Row>> stack;
    const auto visit = [&](Expr e) {
      if (is_leaf(graph_.node(e))) {
        leaves_.push_back(e);
      } else if (!done_[e.id]) {
        stack.emplace_back(e, lowering_.row(e));
        return true;
      }
      return false;
    };
    if (!visit(root)) return;
    while (!stack.empty()) {
      const auto [e, row] = stack.back();
      bool ready = true;
      for (int k = 0; k < info(row.op).arity && ready; ++k) ready = !visit(row.operand[k]);
      if (!ready) continue;
      stack.pop_back();
      if (done_[e.id]) continue;
      done_[e.id] = 1;
      rows_.emplace_back(e, row);
    }
  }

  const std::vector<std::pair<Expr, Row>>& rows() const { return rows_; }
  const std::vector<Expr>& leaves() const { return leaves_; }

 private:
  Graph& graph_;
  Lowering& lowering_;
  std::vector<std::uint8_t> done_;
  std::vector<std::pair<Expr, Row>> rows_;
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

// d2 (sum_i multiplier_i values[i]).
std::vector<Entry> contracted_hessian(Graph& graph, std::span<const Expr> values, std::span<const Expr> inputs) {
  const auto multiplier = [&](std::size_t i) {
    return graph.input({.kind = InputKind::multiplier, .name = {}, .index = static_cast<int>(i)});
  };
  if (values.size() == 1) {
    auto entries = hessian(graph, values[0], inputs);
    for (auto& entry : entries) entry.value = graph.multiply(multiplier(0), entry.value);
    return entries;
  }
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
  Scheduler scheduler(graph, lowering);
  Program program;
  for (const auto value : values) scheduler.compute(value);
  program.value_operations = static_cast<std::int32_t>(scheduler.rows().size());
  for (const auto& entry : first) scheduler.compute(entry.value);
  program.jacobian_operations = static_cast<std::int32_t>(scheduler.rows().size());
  for (const auto& entry : second) scheduler.compute(entry.value);

  // Numbering: inputs, numbers, operations.
  std::vector<Expr> used(scheduler.leaves());
  used.insert(used.end(), inputs.begin(), inputs.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Expr> used_inputs;
  std::map<double, std::int32_t> numbers;
  for (const auto e : used) {
    if (const auto value = graph.constant(e))
      numbers.emplace(*value, 0);
    else
      used_inputs.push_back(e);
  }
  std::ranges::sort(used_inputs,
                    [&](Expr x, Expr y) { return order_of(graph.input_of(x)) < order_of(graph.input_of(y)); });
  std::vector<std::int32_t> index(graph.size());
  for (const auto e : used_inputs) {
    index[e.id] = static_cast<std::int32_t>(program.inputs.size());
    program.inputs.push_back(graph.input_of(e));
  }
  for (auto& [value, at] : numbers) {
    at = static_cast<std::int32_t>(program.inputs.size() + program.numbers.size());
    program.numbers.push_back(value);
  }
  for (const auto e : used) {
    if (const auto value = graph.constant(e)) index[e.id] = numbers.at(*value);
  }
  for (const auto& [e, row] : scheduler.rows()) {
    const int arity = info(row.op).arity;
    index[e.id] = program.value_count();
    program.op.push_back(row.op);
    program.a.push_back(index[row.operand[0].id]);
    program.b.push_back(arity > 1 ? index[row.operand[1].id] : 0);
    program.c.push_back(arity > 2 ? index[row.operand[2].id] : 0);
  }
  for (const auto value : values) program.values.push_back(index[value.id]);
  for (const auto& entry : first) {
    program.jacobian.push_back({entry.row, index[inputs[entry.column].id], index[entry.value.id]});
  }
  for (const auto& entry : second) {
    program.hessian.push_back({index[inputs[entry.row].id], index[inputs[entry.column].id], index[entry.value.id]});
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
    if (is_leaf(n)) continue;
    for (int k = 0; k < info(n.op).arity; ++k) tree[id] += tree[operands(n)[k].id];
  }
  for (const auto root : roots) size.tree += tree[root.id];
  return size;
}

}  // namespace spacetime::symbolic
