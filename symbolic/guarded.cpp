#include "symbolic/guarded.h"

#include <algorithm>
#include <utility>

namespace spacetime::symbolic {
namespace {

// Beyond these a weight is selected early, so that a scene with thousands of nested choices costs no more than it
// must; only there could a choice that was not made spoil a derivative.
constexpr std::size_t most_terms = 16;
constexpr std::size_t most_literals = 32;

}  // namespace

Weight Guards::guarded(Expr condition, bool nonzero, Expr e) {
  while (graph_.is_operation(condition, Op::logical_not)) condition = graph_.node(condition).a, nonzero = !nonzero;
  if (const auto value = graph_.constant(condition)) return {(*value != 0) == nonzero ? e : Expr{}};
  return stored({{{{condition, nonzero}}, e}});
}

Guards::Terms Guards::terms(Weight x) const {
  if (x.list > 0) return lists_[x.list];
  if (x.is_zero()) return {};
  return {{{}, x.plain}};
}

Weight Guards::stored(Terms terms) {
  if (terms.empty()) return {};
  const bool large = terms.size() > most_terms ||
                     std::ranges::any_of(terms, [](const Term& term) { return term.guard.size() > most_literals; });
  // With an unguarded term nothing more can be spoiled: whatever multiplies the sum multiplies that term.
  const bool exposed = std::ranges::any_of(terms, [](const Term& term) { return term.guard.empty(); });
  if (large || exposed) return {total(std::move(terms))};
  lists_.push_back(std::move(terms));
  return {{}, static_cast<std::uint32_t>(lists_.size() - 1)};
}

// Adds a term to a sum; terms whose guards differ in nothing but one opposite literal become one without it.
void Guards::accumulate(Terms& terms, Term term) {
  for (std::size_t i = 0; i < terms.size(); ++i) {
    auto& other = terms[i];
    if (other.guard == term.guard) {
      other.value = graph_.add(other.value, term.value);
      if (other.value == Expr{}) terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
    if (other.guard.size() != term.guard.size()) continue;
    const auto [there, here] = std::ranges::mismatch(other.guard, term.guard);
    if (there->condition != here->condition || !std::equal(there + 1, other.guard.end(), here + 1)) continue;
    const auto [chosen, otherwise] =
        here->nonzero ? std::pair(term.value, other.value) : std::pair(other.value, term.value);
    term.value = graph_.select(here->condition, chosen, otherwise);
    term.guard.erase(here);
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(i));
    return accumulate(terms, std::move(term));
  }
  terms.push_back(std::move(term));
}

Weight Guards::plus(Weight x, Weight y) {
  if (x.list == 0 && y.list == 0) return {graph_.add(x.plain, y.plain)};
  auto sum = terms(x);
  for (auto& term : terms(y)) accumulate(sum, std::move(term));
  return stored(std::move(sum));
}

Weight Guards::times(Weight x, Weight y) {
  if (x.list == 0 && y.list == 0) return {graph_.multiply(x.plain, y.plain)};
  Terms product;
  for (const auto& p : terms(x)) {
    for (const auto& q : terms(y)) {
      Term term{{}, graph_.multiply(p.value, q.value)};
      std::ranges::set_union(p.guard, q.guard, std::back_inserter(term.guard));
      const auto contradiction = std::ranges::adjacent_find(
          term.guard, [](const Literal& l, const Literal& r) { return l.condition == r.condition; });
      if (contradiction == term.guard.end() && term.value != Expr{}) accumulate(product, std::move(term));
    }
  }
  return stored(std::move(product));
}

Weight Guards::negated(Weight x) { return times(x, {graph_.number(-1)}); }

Expr Guards::total(Weight x) { return x.list == 0 ? x.plain : total(lists_[x.list]); }

// Splits the terms on the first condition met.  The depth of the recursion is at most the number of literals that a
// list may hold.
Expr Guards::total(Terms terms) {
  Expr sum;
  while (!terms.empty()) {
    if (terms.back().guard.empty()) {
      sum = graph_.add(sum, terms.back().value);
      terms.pop_back();
      continue;
    }
    const Expr condition = terms.back().guard.front().condition;
    Terms chosen, otherwise, rest;
    for (auto& term : terms) {
      const auto literal = std::ranges::find(term.guard, condition, &Literal::condition);
      if (literal == term.guard.end()) {
        rest.push_back(std::move(term));
        continue;
      }
      auto& side = literal->nonzero ? chosen : otherwise;
      term.guard.erase(literal);
      side.push_back(std::move(term));
    }
    sum = graph_.add(sum, graph_.select(condition, total(std::move(chosen)), total(std::move(otherwise))));
    terms = std::move(rest);
  }
  return sum;
}

}  // namespace spacetime::symbolic
