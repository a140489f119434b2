#include "symbolic/derivative.h"

#include <algorithm>
#include <array>
#include <utility>

#include "symbolic/elimination.h"
#include "symbolic/guarded.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

// The local derivatives of one operation by its operands: first d[i], second dd[i][j] for j <= i (zero: not there).
struct Local {
  std::array<Weight, 3> d;
  Expr aa, ab, bb;
};

// All rules.  `v` is the node itself, so that what it has computed is used again.
//   op        d/da            d/db           d2/da2             d2/dadb       d2/db2
Local local_derivatives(Graph& g, Guards& guards, Expr v, bool second) {
  const auto n = g.node(v);
  const Expr a = n.a, b = n.b, one = g.number(1), two = g.number(2);
  const auto multiply = [&](Expr x, Expr y) { return g.multiply(x, y); };
  const auto square = [&](Expr x) { return g.multiply(x, x); };
  const auto minus = [&](Expr x) { return g.negate(x); };
  const auto chosen = [&](Expr condition, Expr e) { return guards.guarded(condition, true, e); };
  const auto otherwise = [&](Expr condition, Expr e) { return guards.guarded(condition, false, e); };
  const auto function = [&](Op op) { return g.operation(op, a); };
  Local l;
  switch (n.op) {
    case Op::add:
      l.d = {Weight{one}, Weight{one}};
      break;
    case Op::subtract:
      l.d = {Weight{one}, Weight{minus(one)}};
      break;
    case Op::multiply:
      l.d = {Weight{b}, Weight{a}};
      l.ab = one;
      break;
    case Op::divide: {
      const Expr r = g.divide(one, b);
      l.d = {Weight{r}, Weight{minus(multiply(v, r))}};
      if (second) l.ab = minus(square(r)), l.bb = multiply(two, multiply(v, square(r)));
      break;
    }
    case Op::negate:
      l.d = {Weight{minus(one)}};
      break;
    case Op::absolute:
      l.d = {chosen(a, function(Op::sign))};
      break;
    case Op::square_root: {
      const Expr p = g.divide(g.number(0.5), v);
      l.d = {Weight{p}};
      if (second) l.aa = minus(g.divide(square(p), v));
      break;
    }
    case Op::minimum: {
      const Expr other = g.operation(Op::less, b, a);  // a tie follows a
      l.d = {otherwise(other, one), chosen(other, one)};
      break;
    }
    case Op::maximum: {
      const Expr other = g.operation(Op::less, a, b);
      l.d = {otherwise(other, one), chosen(other, one)};
      break;
    }
    case Op::sine:
      l.d = {Weight{g.cosine(a)}};
      l.aa = minus(v);
      break;
    case Op::cosine:
      l.d = {Weight{minus(g.sine(a))}};
      l.aa = minus(v);
      break;
    case Op::tangent: {
      const Expr p = g.add(square(v), one);
      l.d = {Weight{p}};
      if (second) l.aa = multiply(two, multiply(v, p));
      break;
    }
    case Op::arc_sine:
    case Op::arc_cosine: {
      const Expr p = g.divide(one, g.square_root(g.subtract(one, square(a))));
      const bool sine = n.op == Op::arc_sine;
      l.d = {Weight{sine ? p : minus(p)}};
      if (second) l.aa = multiply(sine ? a : minus(a), multiply(p, square(p)));
      break;
    }
    case Op::arc_tangent: {
      const Expr p = g.divide(one, g.add(square(a), one));
      l.d = {Weight{p}};
      if (second) l.aa = multiply(g.number(-2), multiply(a, square(p)));
      break;
    }
    case Op::arc_tangent2: {  // of a = y, b = x
      const Expr p = g.divide(one, g.add(square(a), square(b)));
      const Expr da = multiply(b, p), db = minus(multiply(a, p));
      l.d = {Weight{da}, Weight{db}};
      if (second) {
        l.bb = multiply(g.number(-2), multiply(da, db));
        l.aa = minus(l.bb);
        l.ab = g.subtract(square(db), square(da));
      }
      break;
    }
    case Op::hyperbolic_sine:
      l.d = {Weight{function(Op::hyperbolic_cosine)}};
      l.aa = v;
      break;
    case Op::hyperbolic_cosine:
      l.d = {Weight{function(Op::hyperbolic_sine)}};
      l.aa = v;
      break;
    case Op::hyperbolic_tangent: {
      const Expr p = g.subtract(one, square(v));
      l.d = {Weight{p}};
      if (second) l.aa = multiply(g.number(-2), multiply(v, p));
      break;
    }
    case Op::exponential:
      l.d = {Weight{v}};
      l.aa = v;
      break;
    case Op::logarithm: {
      const Expr p = g.divide(one, a);
      l.d = {Weight{p}};
      if (second) l.aa = minus(square(p));
      break;
    }
    case Op::power: {
      const Expr b1 = g.subtract(b, one), lower = g.power(a, b1), log_a = g.operation(Op::logarithm, a);
      l.d = {Weight{multiply(b, lower)}, Weight{multiply(v, log_a)}};
      if (second) {
        l.aa = multiply(multiply(b, b1), g.power(a, g.subtract(b1, one)));
        l.ab = multiply(lower, g.add(multiply(b, log_a), one));
        l.bb = multiply(v, square(log_a));
      }
      break;
    }
    case Op::select:
      l.d = {Weight{}, chosen(a, one), otherwise(a, one)};
      break;
    case Op::multiply_add:  // the graph has none
    case Op::sign:
    case Op::less:
    case Op::less_equal:
    case Op::logical_and:
    case Op::logical_or:
    case Op::logical_not:
      break;
  }
  return l;
}

std::array<Expr, 3> operands(const Graph::Node& n) { return {n.a, n.b, n.c}; }

// The nodes between the inputs and the values: those that both depend on an input and are needed by a value.  They
// become vertices numbered in the order of their ids, operands first.
struct Part {
  std::vector<Expr> node;              // of each vertex
  std::vector<std::int64_t> vertex;    // of each id, -1 where it is none
  std::vector<std::int64_t> input_of;  // of each vertex: index into inputs, -1 where it is an operation

  Part(const Graph& graph, std::span<const Expr> values, std::span<const Expr> inputs) {
    const auto needed = reachable(graph, values);
    vertex.assign(needed.size(), -1);
    std::vector<std::int64_t> input(needed.size(), -1);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (inputs[i].id < needed.size()) input[inputs[i].id] = static_cast<std::int64_t>(i);
    }
    for (std::uint32_t id = 0; id < needed.size(); ++id) {
      if (!needed[id]) continue;
      const auto& n = graph.node({id});
      bool depends = input[id] >= 0;
      if (n.kind == Graph::Kind::operation) {
        const int arity = info(n.op).arity;
        for (int k = 0; k < arity; ++k) depends = depends || vertex[operands(n)[k].id] >= 0;
      }
      if (!depends) continue;
      vertex[id] = static_cast<std::int64_t>(node.size());
      node.push_back({id});
      input_of.push_back(input[id]);
    }
  }

  std::size_t size() const { return node.size(); }
  bool contains(Expr e) const { return e.id < vertex.size() && vertex[e.id] >= 0; }
  std::uint32_t at(Expr e) const { return static_cast<std::uint32_t>(vertex[e.id]); }
  // The vertices that are operations, or those that are inputs.
  std::vector<std::uint32_t> operations() const { return vertices(false); }
  std::vector<std::uint32_t> leaves() const { return vertices(true); }

 private:
  std::vector<std::uint32_t> vertices(bool are_inputs) const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t v = 0; v < size(); ++v) {
      if ((input_of[v] >= 0) == are_inputs) result.push_back(v);
    }
    return result;
  }
};

// The derivatives of every vertex by its operands; operands that are no vertices are left out.
std::vector<Local> all_local_derivatives(Graph& graph, Guards& guards, const Part& part, bool second) {
  std::vector<Local> result(part.size());
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part.input_of[v] >= 0) continue;
    const auto n = graph.node(part.node[v]);
    auto& local = result[v] = local_derivatives(graph, guards, part.node[v], second);
    for (int k = 0; k < 3; ++k) {
      if (k >= info(n.op).arity || !part.contains(operands(n)[k])) local.d[k] = {};
    }
    if (info(n.op).arity == 2 && n.a == n.b) {  // x*x: the one derivative is the sum of both
      local.d = {guards.plus(local.d[0], local.d[1])};
      local.aa = graph.add(graph.add(local.aa, local.bb), graph.add(local.ab, local.ab));
      local.ab = local.bb = {};
    }
    const bool a = part.contains(n.a), b = info(n.op).arity > 1 && part.contains(n.b);
    if (!a) local.aa = {};
    if (!b) local.bb = {};
    if (!a || !b) local.ab = {};
  }
  return result;
}

// The adjoint of every vertex: the derivative of `e` by it.
std::vector<Weight> adjoints(Graph& graph, Guards& guards, const Part& part, std::span<const Local> local, Expr e) {
  std::vector<Weight> adjoint(part.size());
  adjoint[part.at(e)] = {graph.number(1)};
  for (std::size_t v = part.size(); v-- > 0;) {
    if (adjoint[v].is_zero() || part.input_of[v] >= 0) continue;
    const auto n = graph.node(part.node[v]);
    for (int k = 0; k < info(n.op).arity; ++k) {
      if (local[v].d[k].is_zero()) continue;
      auto& below = adjoint[part.at(operands(n)[k])];
      below = guards.plus(below, guards.times(adjoint[v], local[v].d[k]));
    }
  }
  return adjoint;
}

void add_edges(Graph& graph, Elimination& elimination, const Part& part, std::span<const Local> local) {
  std::vector<std::uint8_t> linear(part.size(), 1);
  for (std::uint32_t v = 0; v < part.size(); ++v) {
    if (part.input_of[v] >= 0) continue;
    const auto n = graph.node(part.node[v]);
    for (int k = 0; k < info(n.op).arity; ++k) {
      const auto weight = local[v].d[k];
      if (weight.is_zero()) continue;
      const auto u = part.at(operands(n)[k]);
      elimination.add_edge(v, u, weight);
      linear[v] = linear[v] && linear[u] && weight.list == 0 && graph.constant(weight.plain);
    }
    if (linear[v]) elimination.set_linear(v);
  }
}

void sort(std::vector<Entry>& entries) {
  std::ranges::sort(entries, {}, [](const Entry& e) { return std::pair(e.row, e.column); });
}

}  // namespace

std::optional<Expr> time_derivative(Graph& graph, Expr e) {
  const auto needed = reachable(graph, {&e, 1});
  Guards guards(graph);
  std::vector<Expr> dot(needed.size());
  std::vector<std::uint8_t> is_third(needed.size());  // needs a derivative that trajectories do not have
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const auto n = graph.node({id});
    if (n.kind == Graph::Kind::input) {
      Input input = graph.input_of({id});
      if (input.kind == InputKind::time) dot[id] = graph.number(1);
      if (input.kind != InputKind::dof && input.kind != InputKind::signal) continue;
      if (++input.derivative > 2) {
        is_third[id] = 1;
      } else {
        dot[id] = graph.input(input);
      }
    } else if (n.kind == Graph::Kind::operation) {
      const int arity = info(n.op).arity;
      bool moves = false;
      for (int k = 0; k < arity; ++k) {
        const auto operand = operands(n)[k].id;
        moves = moves || dot[operand] != Expr{} || is_third[operand];
      }
      if (!moves) continue;
      const auto local = local_derivatives(graph, guards, {id}, false);
      Weight sum;
      for (int k = 0; k < arity; ++k) {
        const Expr rate = dot[operands(n)[k].id];
        if (is_third[operands(n)[k].id] && !local.d[k].is_zero()) is_third[id] = 1;
        if (rate != Expr{}) sum = guards.plus(sum, guards.times(local.d[k], {rate}));
      }
      dot[id] = guards.total(sum);
    }
  }
  return is_third[e.id] ? std::nullopt : std::optional(dot[e.id]);
}

std::vector<Entry> jacobian(Graph& graph, std::span<const Expr> values, std::span<const Expr> inputs) {
  const Part part(graph, values, inputs);
  Guards guards(graph);
  const auto local = all_local_derivatives(graph, guards, part, false);
  std::vector<Entry> entries;
  const auto append = [&](std::size_t row, std::uint32_t v, Weight weight) {
    const Expr value = guards.total(weight);
    if (value != Expr{}) entries.push_back({static_cast<int>(row), static_cast<int>(part.input_of[v]), value});
  };
  if (values.size() == 1) {
    if (!part.contains(values[0])) return {};
    const auto adjoint = adjoints(graph, guards, part, local, values[0]);
    for (const auto v : part.leaves()) append(0, v, adjoint[v]);
  } else {
    // One vertex more for each value keeps a value that others use from being eliminated before its own row is read.
    Elimination elimination(guards, part.size() + values.size());
    add_edges(graph, elimination, part, local);
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (part.contains(values[row])) {
        elimination.add_edge(static_cast<std::uint32_t>(part.size() + row), part.at(values[row]), {graph.number(1)});
      }
    }
    elimination.eliminate(part.operations());
    for (std::size_t row = 0; row < values.size(); ++row) {
      elimination.for_each_below(static_cast<std::uint32_t>(part.size() + row),
                                 [&](std::uint32_t v, Weight weight) { append(row, v, weight); });
    }
  }
  sort(entries);
  return entries;
}

std::vector<Entry> hessian(Graph& graph, Expr e, std::span<const Expr> inputs, std::optional<Expr> factor) {
  const Part part(graph, {&e, 1}, inputs);
  if (!part.contains(e)) return {};
  Guards guards(graph);
  const auto local = all_local_derivatives(graph, guards, part, true);
  const auto adjoint = adjoints(graph, guards, part, local, e);

  // To start with, vertices interact by the nodes' own second derivatives times their adjoints.
  Elimination start(guards, part.size());
  add_edges(graph, start, part, local);
  for (std::uint32_t v = 0; v < part.size(); ++v) {
    const auto n = graph.node(part.node[v]);
    const auto bend = [&](Expr x, Expr y, Expr second) {
      if (second == Expr{}) return;
      const auto weight = guards.times(adjoint[v], {second});
      if (!weight.is_zero()) start.add_interaction(part.at(x), part.at(y), weight);
    };
    bend(n.a, n.a, local[v].aa);
    bend(n.b, n.b, local[v].bb);
    bend(n.a, n.b, local[v].ab);
  }

  const auto entries_of = [&](Elimination elimination) {
    elimination.eliminate(part.operations());
    std::vector<Entry> entries;
    for (const auto u : part.leaves()) {
      elimination.for_each_interaction(u, [&](std::uint32_t v, Weight weight) {
        const Expr value = part.input_of[v] <= part.input_of[u] ? guards.total(weight) : Expr{};
        if (value == Expr{}) return;
        entries.push_back({static_cast<int>(part.input_of[u]), static_cast<int>(part.input_of[v]), value});
      });
    }
    sort(entries);
    return entries;
  };
  if (!factor) return entries_of(start);
  // The factor goes where there is less to multiply: the interactions at the start or those at the end.
  auto scaled = start;
  const auto interactions = scaled.scale_interactions({*factor});
  auto entries = entries_of(std::move(scaled));
  if (entries.size() >= interactions) return entries;
  entries = entries_of(std::move(start));
  for (auto& entry : entries) entry.value = graph.multiply(*factor, entry.value);
  return entries;
}

}  // namespace spacetime::symbolic
