#include <algorithm>
#include <set>

#include "symbolic/derivative.h"
#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/statement.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

std::optional<Quantity> maybe_quantity(Model& model, const std::optional<Expr>& e) {
  if (!e) return std::nullopt;
  return quantity(model, *e);
}

// Adds coefficient * functional to the term: to the integral or the value at a time that it already has, or a new one.
struct Sum {
  Functional::Kind kind;
  std::optional<Expr> from, to;
  Expr value;
};

// What the functionals enter linearly, taken apart:  e = sum_k c_k F_k + rest.  A functional belongs to the sum where
// c_k = de/dF_k contains no functional.
Expr take_apart(Model& model, Expr e, const std::vector<int>& functionals, std::vector<Sum>& sums) {
  std::vector<Expr> inputs;
  for (const int k : functionals) inputs.push_back(input_of(model, k));
  std::map<Expr, Expr> zero;
  for (const Entry& entry : jacobian(model.graph, std::vector{e}, inputs)) {
    if (model.facts.has_functional(entry.value)) continue;
    const auto column = static_cast<std::size_t>(entry.column);
    const FunctionalUse& use = model.functionals[static_cast<std::size_t>(functionals[column])];
    const Expr value = model.graph.multiply(entry.value, use.integrand);
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& s) {
      return s.kind == use.kind && s.from == use.from && s.to == use.to;
    });
    if (same != sums.end())
      same->value = model.graph.add(same->value, value);
    else
      sums.push_back({use.kind, use.from, use.to, value});
    zero[inputs[column]] = model.graph.number(0);
  }
  return substitute(model.graph, e, zero);
}

void add_piece(Model& model, Term& term, const Sum& sum) {
  Piece piece;
  piece.from = maybe_quantity(model, sum.from);
  piece.to = maybe_quantity(model, sum.to);
  if (sum.kind == Functional::Kind::at) {
    piece.kind = Piece::Kind::at;
    piece.program = add_program(model, std::vector{place(model, sum.value)}, Derivatives::second);
  } else {
    model.integrals.push_back(
        {sum.from, sum.to, place(model, sum.value), model.problem.objective.size(), term.pieces.size()});
  }
  term.pieces.push_back(std::move(piece));
}

// What is left: an expression at one time, or a function of functionals.
void add_rest(Model& model, Term& term, Expr rest) {
  const std::vector<int> functionals = functionals_in(model, std::vector{rest});
  if (const auto time = common_time(model, functionals))
    return add_piece(model, term, {Functional::Kind::at, time, {}, take_out(model, rest, functionals)});
  Piece piece;
  piece.kind = Piece::Kind::once;
  piece.program = add_program(model, std::vector{place(model, rest)}, Derivatives::second);
  term.pieces.push_back(std::move(piece));
}

// The bases of the degrees of freedom an integrand uses: they say at which times it is sampled.
std::set<std::vector<double>> bases_of(const Model& model, Expr e) {
  std::set<std::vector<double>> out;
  const auto needed = reachable(model.graph, std::vector{e});
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id] || model.graph.node({id}).kind != Graph::Kind::input) continue;
    const Input& input = model.graph.input_of({id});
    if (input.kind != InputKind::dof) continue;
    const auto dof = static_cast<std::size_t>(model.dof_index.at(input.name));
    out.insert(model.problem.dofs[dof].basis.knots);
  }
  return out;
}

}  // namespace

void add_term(Model& model, const MinimizeDeclaration& declaration, Term term) {
  if (const auto weight = elaborate_weight(model, declaration.weight, false)) term.weight = *weight;
  const auto e = elaborate_scalar(model, declaration.value, "an objective");
  if (e && model.facts.timed(*e)) {
    report(model, model.scene.nodes[declaration.value].span,
           "an objective is one number, but this changes in time: put it inside integral( ) or at( , time)");
  } else if (e) {
    const std::vector<int> functionals = functionals_in(model, std::vector{*e});
    std::vector<Sum> sums;
    Expr rest = *e;
    if (!common_time(model, functionals)) rest = take_apart(model, *e, functionals, sums);
    for (const Sum& sum : sums) add_piece(model, term, sum);
    if (!model.graph.is_number(rest, 0) || sums.empty()) add_rest(model, term, rest);
  }
  if (e) note_stated(model, {term.name, false, {}, {*e}});
  model.problem.objective.push_back(std::move(term));
}

void elaborate_objective(Model& model, const MinimizeDeclaration& declaration, const Span& span) {
  Named named;
  named.span = declaration.name ? declaration.name->span : span;
  named.is_constraint = false;
  Term term;
  term.place = place_of(span);
  term.since = static_cast<int>(model.problem.actions.size());
  term.name = statement_name(model, declaration.name, "objective", ++model.terms, named);
  add_term(model, declaration, std::move(term));
}

void finish_objective(Model& model) {
  // What begins later, or may, is not computed before.
  using Key = std::tuple<int, std::optional<Expr>, std::optional<Expr>, std::set<std::vector<double>>>;
  const auto begins = [&](std::size_t i) {
    const Term& term = model.problem.objective[i];
    return term.replacement ? -1 - static_cast<int>(i) : term.since;
  };
  std::map<Key, std::vector<const PendingIntegral*>> groups;
  for (const PendingIntegral& integral : model.integrals)
    groups[{begins(integral.term), integral.from, integral.to, bases_of(model, integral.integrand)}].push_back(
        &integral);
  for (const auto& [key, integrals] : groups) {
    std::vector<Expr> values;
    for (const PendingIntegral* integral : integrals) values.push_back(integral->integrand);
    const std::string program = add_program(model, values, Derivatives::second);
    for (std::size_t i = 0; i < integrals.size(); ++i) {
      Piece& piece = model.problem.objective[integrals[i]->term].pieces[integrals[i]->piece];
      piece.program = program;
      piece.output = static_cast<int>(i);
    }
  }
}

}  // namespace spacetime::symbolic
