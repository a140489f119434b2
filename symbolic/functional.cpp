#include "symbolic/functional.h"

#include <algorithm>

#include "symbolic/expression.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

// A name no placed functional has, so that the two kinds of input are different nodes.
constexpr const char* unplaced = "unplaced";

bool is_unplaced(const Graph& graph, Expr e) {
  if (graph.node(e).kind != Graph::Kind::input) return false;
  const Input& input = graph.input_of(e);
  return input.kind == InputKind::functional && input.name == unplaced;
}

void enter(Model& model, int index) {
  const FunctionalUse use = model.functionals[static_cast<std::size_t>(index)];
  std::map<Expr, Expr> by;
  for (const int inner : functionals_in(model, std::vector{use.integrand}))
    by[input_of(model, inner)] =
        model.graph.input({InputKind::functional, {}, model.placed[static_cast<std::size_t>(inner)], 0});
  const Expr integrand = substitute(model.graph, use.integrand, by);
  Functional out;
  out.kind = use.kind;
  out.program = add_program(model, std::vector{integrand}, Derivatives::second);
  if (use.from) out.from = quantity(model, *use.from);
  if (use.to) out.to = quantity(model, *use.to);
  model.placed[static_cast<std::size_t>(index)] = static_cast<int>(model.problem.functionals.size());
  model.problem.functionals.push_back(out);
}

}  // namespace

Expr functional(Model& model, const FunctionalUse& use) {
  if (use.kind == Functional::Kind::at && !model.facts.timed(use.integrand)) return use.integrand;
  const auto [it, fresh] = model.functional_index.try_emplace(use, static_cast<int>(model.functionals.size()));
  if (fresh) {
    model.functionals.push_back(use);
    model.placed.push_back(-1);
  }
  return input_of(model, it->second);
}

Expr input_of(Model& model, int functional) {
  return model.graph.input({InputKind::functional, unplaced, functional, 0});
}

std::vector<int> functionals_in(Model& model, std::span<const Expr> values) {
  std::vector<int> out;
  if (std::none_of(values.begin(), values.end(), [&](Expr e) { return model.facts.has_functional(e); })) return out;
  const auto needed = reachable(model.graph, values);
  for (std::uint32_t id = 0; id < needed.size(); ++id)
    if (needed[id] && is_unplaced(model.graph, {id})) out.push_back(model.graph.input_of({id}).index);
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<int> all_functionals_in(Model& model, std::span<const Expr> values) {
  std::vector<int> out = functionals_in(model, values);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Expr integrand = model.functionals[static_cast<std::size_t>(out[i])].integrand;
    for (const int inner : functionals_in(model, std::vector{integrand}))
      if (std::ranges::find(out, inner) == out.end()) out.push_back(inner);
  }
  std::ranges::sort(out);
  return out;
}

std::optional<Expr> common_time(const Model& model, const std::vector<int>& functionals) {
  std::optional<Expr> time;
  for (const int index : functionals) {
    const FunctionalUse& use = model.functionals[static_cast<std::size_t>(index)];
    if (use.kind != Functional::Kind::at || (time && *time != *use.from)) return std::nullopt;
    time = use.from;
  }
  return time;
}

Expr take_out(Model& model, Expr e, const std::vector<int>& functionals) {
  std::map<Expr, Expr> by;
  for (const int index : functionals)
    by[input_of(model, index)] = model.functionals[static_cast<std::size_t>(index)].integrand;
  return substitute(model.graph, e, by);
}

Expr place(Model& model, Expr e) { return place(model, std::vector{e}).front(); }

std::vector<Expr> place(Model& model, std::vector<Expr> values) {
  // What a functional is made of was written before it: ascending order places inner ones first.
  std::vector<std::uint8_t> wanted(model.functionals.size(), 0);
  for (const int index : functionals_in(model, values)) wanted[static_cast<std::size_t>(index)] = 1;
  for (std::size_t i = wanted.size(); i-- > 0;)
    if (wanted[i] && model.placed[i] < 0)
      for (const int inner : functionals_in(model, std::vector{model.functionals[i].integrand}))
        wanted[static_cast<std::size_t>(inner)] = 1;
  std::map<Expr, Expr> by;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    if (model.placed[i] < 0) enter(model, static_cast<int>(i));
    by[input_of(model, static_cast<int>(i))] = model.graph.input({InputKind::functional, {}, model.placed[i], 0});
  }
  for (Expr& e : values) e = substitute(model.graph, e, by);
  return values;
}

Expr substitute(Graph& graph, Expr e, const std::map<Expr, Expr>& by) {
  if (by.empty()) return e;
  const auto needed = reachable(graph, std::vector{e});
  std::vector<Expr> now(needed.size());
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const auto node = graph.node({id});
    const auto replaced = by.find({id});
    if (replaced != by.end())
      now[id] = replaced->second;
    else if (node.kind != Graph::Kind::operation)
      now[id] = {id};
    else
      now[id] = graph.operation(node.op, now[node.a.id], now[node.b.id], now[node.c.id]);
  }
  return now[e.id];
}

}  // namespace spacetime::symbolic
