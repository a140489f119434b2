#include "symbolic/reading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "symbolic/factor.h"
#include "symbolic/functional.h"
#include "symbolic/functions.h"
#include "symbolic/reading_items.h"
#include "symbolic/reading_parts.h"

namespace spacetime::symbolic {
namespace {

using Kind = Reading::Kind;

constexpr int most_rounds = 10;        // examples take up to five
constexpr double most_relations = 32;  // in one condition; more are kept as a number by a name

bool is_truth(Op op) {
  return op == Op::less || op == Op::less_equal || op == Op::logical_and || op == Op::logical_or ||
         op == Op::logical_not;
}

class Reader {
 public:
  Reader(Model& model, std::span<const Expr> values);

  std::vector<std::size_t> roots(std::span<const Expr> values);
  std::vector<Reading::Item> items() { return items_.take(); }

 private:
  // What has been read of a node: one term, a sum whose terms may still join those of a larger one, or a condition.
  struct Read {
    enum class State : std::uint8_t { nothing, term, sum, condition } state = State::nothing;
    Term term;
    std::vector<Term> terms;
    std::size_t condition = 0;
  };

  template <class Visit>
  void for_each_operand(Expr e, Visit visit) const;
  const FunctionalUse* functional_of(Expr e) const;

  void read(Expr e);
  Read input(Expr e);
  Read operation(Expr e);
  Read sum(const Graph::Node& node);
  Read product(const Graph::Node& node);
  Read power(const Graph::Node& node);
  Read choice(const Graph::Node& node);
  Read logic(const Graph::Node& node);
  Read function(const Graph::Node& node);

  Read of(Term term) const { return {Read::State::term, std::move(term), {}, 0}; }
  Read of_item(std::size_t item);
  Read truth(std::size_t item) const { return {Read::State::condition, {}, {}, item}; }

  void settle(Read& read);
  Term term(Expr e);
  std::vector<Term> terms(Expr e);
  std::size_t number(Expr e);
  std::size_t condition(Expr e);
  bool is_short(const Term& term) const;

  Model& model_;
  ReadingItems items_;
  std::vector<std::uint32_t> uses_;  // by id
  std::vector<Read> read_;           // by id
};

const FunctionalUse* Reader::functional_of(Expr e) const {
  if (model_.graph.node(e).kind != Graph::Kind::input) return nullptr;
  const Input& input = model_.graph.input_of(e);
  return input.kind == InputKind::functional ? &model_.functionals[static_cast<std::size_t>(input.index)] : nullptr;
}

// Operands, and what functionals are made of.
template <class Visit>
void Reader::for_each_operand(Expr e, Visit visit) const {
  const Graph::Node& node = model_.graph.node(e);
  if (node.kind == Graph::Kind::operation) {
    const int arity = info(node.op).arity;
    visit(node.a);
    if (arity > 1) visit(node.b);
    if (arity > 2) visit(node.c);
  } else if (const FunctionalUse* use = functional_of(e)) {
    visit(use->integrand);
    if (use->from) visit(*use->from);
    if (use->to) visit(*use->to);
  }
}

Reader::Reader(Model& model, std::span<const Expr> values) : model_(model), items_(model) {
  std::uint32_t last = 0;
  for (const Expr e : values) last = std::max(last, e.id);
  uses_.assign(std::size_t{last} + 1, 0);
  read_.resize(uses_.size());
  for (const Expr e : values) ++uses_[e.id];
  for (std::uint32_t id = last + 1; id-- > 0;)
    if (uses_[id] > 0) for_each_operand({id}, [&](Expr operand) { ++uses_[operand.id]; });
  for (std::uint32_t id = 0; id <= last; ++id)
    if (uses_[id] > 0) read({id});
}

std::vector<std::size_t> Reader::roots(std::span<const Expr> values) {
  std::vector<std::size_t> out;
  for (const Expr e : values) out.push_back(number(e));
  return out;
}

void Reader::read(Expr e) {
  const Graph::Node node = model_.graph.node(e);
  Read& out = read_[e.id];
  switch (node.kind) {
    case Graph::Kind::number:
      out = of({node.number, {}, {}});
      break;
    case Graph::Kind::pi:
      out = of({node.number < 0 ? -1.0 : 1.0, {items_.pi(std::fabs(node.number))}, {}});
      break;
    case Graph::Kind::input:
      out = input(e);
      break;
    case Graph::Kind::operation:
      out = operation(e);
      break;
  }
  // What is used again is read once and keeps together, so that it is still shared.
  if (uses_[e.id] < 2 || out.state == Read::State::condition) return;
  settle(out);
  if (!is_short(out.term)) out = of({out.term.number < 0 ? -1.0 : 1.0, {items_.magnitude(out.term)}, {}});
}

// Leaves and products of two, which are no longer than the name they could be given.
bool Reader::is_short(const Term& term) const {
  const auto leaf = [&](std::size_t item) { return is_leaf(items_[item].kind); };
  return term.over.size() + term.under.size() <= 1 ||
         (term.over.size() == 2 && term.under.empty() && std::ranges::all_of(term.over, leaf));
}

void Reader::settle(Read& read) {
  if (read.state == Read::State::sum) read = of(sum_of(items_, std::move(read.terms)));
  if (read.state == Read::State::condition) {
    const std::vector<std::size_t> operands{read.condition, items_.number(1), items_.number(0)};
    read = of_item(items_.call("if", Op::select, operands));
  }
}

Reader::Read Reader::of_item(std::size_t item) {
  const Reading::Item& it = items_[item];
  if (it.kind == Kind::number) return of({it.number, {}, {}});
  if (it.kind == Kind::negative) return of({-1, {it.operands[0].item}, {}});
  return of({1, {item}, {}});
}

Term Reader::term(Expr e) {
  Read& read = read_[e.id];
  if (read.state == Read::State::condition) {
    Read number = read;
    settle(number);
    return number.term;
  }
  settle(read);
  return uses_[e.id] < 2 ? std::move(read.term) : read.term;
}

std::vector<Term> Reader::terms(Expr e) {
  if (read_[e.id].state == Read::State::sum) return std::move(read_[e.id].terms);
  return {term(e)};
}

std::size_t Reader::number(Expr e) { return items_.item(term(e)); }

// A condition; a number holds where it is not 0.
std::size_t Reader::condition(Expr e) {
  if (read_[e.id].state == Read::State::condition) return read_[e.id].condition;
  const std::size_t x = items_.magnitude(term(e)), zero = items_.number(0);
  return items_.condition(
      Kind::logical_or, Op::logical_or,
      {items_.condition(Kind::less, Op::less, {x, zero}), items_.condition(Kind::less, Op::less, {zero, x})});
}

Reader::Read Reader::input(Expr e) {
  if (!functional_of(e)) return of_item(items_.input(e));
  const FunctionalUse use = *functional_of(e);
  std::vector<std::size_t> operands{number(use.integrand)};
  if (use.from) operands.push_back(number(*use.from));
  if (use.to) operands.push_back(number(*use.to));
  return of_item(items_.functional(use, operands));
}

Reader::Read Reader::operation(Expr e) {
  const Graph::Node node = model_.graph.node(e);
  switch (node.op) {
    case Op::add:
    case Op::subtract:
    case Op::negate:
      return sum(node);
    case Op::multiply:
    case Op::divide:
      return product(node);
    case Op::power:
      return power(node);
    case Op::select:
      return choice(node);
    default:
      return is_truth(node.op) ? logic(node) : function(node);
  }
}

void negate(std::vector<Term>& terms) {
  for (Term& term : terms) term.number = -term.number;
}

Reader::Read Reader::sum(const Graph::Node& node) {
  if (node.op == Op::negate && read_[node.a.id].state != Read::State::sum) {
    Term out = term(node.a);
    out.number = -out.number;
    return of(std::move(out));
  }
  std::vector<Term> all = terms(node.a);
  if (node.op == Op::negate) {
    negate(all);
  } else {
    std::vector<Term> more = terms(node.b);
    if (node.op == Op::subtract) negate(more);
    if (all.size() < more.size()) std::swap(all, more);
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return {Read::State::sum, {}, std::move(all), 0};
}

void append(std::vector<std::size_t>& to, std::vector<std::size_t> from) {
  if (to.size() < from.size()) std::swap(to, from);
  to.insert(to.end(), from.begin(), from.end());
}

Reader::Read Reader::product(const Graph::Node& node) {
  Term a = term(node.a), b = term(node.b);
  if (node.op == Op::divide) {
    std::swap(b.over, b.under);
    if (std::fabs(b.number) != 1) b.under.push_back(items_.number(std::fabs(b.number)));
    b.number = b.number < 0 ? -1 : 1;
  }
  const double number = a.number * b.number;
  if (!std::isfinite(number) || (number == 0 && a.number != 0 && b.number != 0)) {
    // Written apart, as it stands in the graph.
    a.over = {items_.magnitude(a)};
    a.under.clear();
    b.over.push_back(items_.number(std::fabs(b.number)));
    a.number = a.number < 0 ? -1 : 1;
    b.number = b.number < 0 ? -1 : 1;
  }
  a.number *= b.number;
  append(a.over, std::move(b.over));
  append(a.under, std::move(b.under));
  return of(std::move(a));
}

Reader::Read Reader::power(const Graph::Node& node) { return of_item(items_.power(number(node.a), number(node.b))); }

Reader::Read Reader::choice(const Graph::Node& node) {
  // The derivative of abs(x) is made for nonzero x alone; sign(x) among its factors says the same.
  if (read_[node.a.id].state != Read::State::condition && node.c == Expr{}) {
    Term chosen = term(node.b), on = term(node.a);
    const std::size_t x = items_.magnitude(on);
    const bool says = std::ranges::any_of(chosen.over, [&](std::size_t factor) {
      const Reading::Item& item = items_[factor];
      return item.kind == Kind::call && item.name == "sign" && item.operands[0].item == x;
    });
    if (says) return of(std::move(chosen));
    read_[node.a.id] = of(std::move(on));
    read_[node.b.id] = of(std::move(chosen));
  }
  return of_item(items_.call("if", Op::select, {condition(node.a), number(node.b), number(node.c)}));
}

Reader::Read Reader::logic(const Graph::Node& node) {
  if (node.op == Op::less || node.op == Op::less_equal)
    return truth(items_.condition(node.op == Op::less ? Kind::less : Kind::less_equal, node.op,
                                  {number(node.a), number(node.b)}));
  if (node.op == Op::logical_not) return truth(items_.condition(Kind::logical_not, node.op, {condition(node.a)}));
  const Kind kind = node.op == Op::logical_and ? Kind::logical_and : Kind::logical_or;
  const std::size_t out = items_.condition(kind, node.op, {condition(node.a), condition(node.b)});
  if (items_.relations(out) <= most_relations) return truth(out);
  // Conditions have no names; a number that is 1 where they hold has.
  const std::size_t number = items_.call("if", Op::select, {out, items_.number(1), items_.number(0)});
  return truth(items_.condition(Kind::less, Op::less, {items_.number(0), number}));
}

Reader::Read Reader::function(const Graph::Node& node) {
  std::vector<std::size_t> operands{number(node.a)};
  if (info(node.op).arity > 1) operands.push_back(number(node.b));
  return of_item(items_.call(std::string(function_of(node.op)->name), node.op, operands));
}

std::vector<Expr> nodes_of(const Reading& reading) {
  std::vector<Expr> out;
  for (const std::size_t root : reading.roots) out.push_back(reading.items[root].expr);
  return out;
}

Reading read_once(Model& model, std::span<const Expr> values) {
  Reading out;
  Reader reader(model, values);
  out.roots = reader.roots(values);
  out.items = reader.items();
  return out;
}

}  // namespace

Reading read(Model& model, std::span<const Expr> values) {
  // What has been collected may bring out more to collect, and the graph may turn signs: read again until nothing
  // changes, so that a reading of the reading is the same.
  std::vector<Expr> now(values.begin(), values.end());
  for (int round = 1;; ++round) {
    Reading out = read_once(model, now);
    std::vector<Expr> read = nodes_of(out);
    if (read == now || round == most_rounds) {
      choose_parts(out);
      return out;
    }
    now = std::move(read);
  }
}

}  // namespace spacetime::symbolic
