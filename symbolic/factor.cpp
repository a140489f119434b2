#include "symbolic/factor.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace spacetime::symbolic {
namespace {

using Factors = std::vector<std::size_t>;

constexpr std::size_t most_collected = 200;  // terms; collecting takes time quadratic in them
constexpr int deepest_collecting = 32;       // sums inside sums that one sum may become

// A factor, and whether it stands below; how often it does in a term.
struct Factor {
  std::size_t item = 0;
  bool below = false;
  std::size_t times = 1;
  auto operator<=>(const Factor&) const = default;
};

std::vector<Factor> factors_of(const Term& term) {
  std::vector<Factor> out;
  for (const bool below : {false, true}) {
    const Factors& factors = below ? term.under : term.over;
    for (auto at = factors.begin(); at != factors.end();) {
      const auto end = std::upper_bound(at, factors.end(), *at);
      out.push_back({*at, below, static_cast<std::size_t>(end - at)});
      at = end;
    }
  }
  return out;
}

void put(Term& term, const Factor& factor) {
  Factors& factors = factor.below ? term.under : term.over;
  factors.insert(factors.end(), factor.times, factor.item);
}

void take(Term& term, const Factor& factor) {
  Factors& factors = factor.below ? term.under : term.over;
  const auto first = std::lower_bound(factors.begin(), factors.end(), factor.item);
  factors.erase(first, first + static_cast<std::ptrdiff_t>(factor.times));
}

std::vector<Term> with_like_terms_added(std::vector<Term> terms) {
  std::map<std::pair<Factors, Factors>, std::size_t> places;
  std::vector<Term> out;
  for (Term& term : terms) {
    std::ranges::sort(term.over);
    std::ranges::sort(term.under);
    const auto [place, is_new] = places.try_emplace({term.over, term.under}, out.size());
    if (is_new)
      out.push_back(std::move(term));
    else
      out[place->second].number += term.number;
  }
  std::erase_if(out, [](const Term& term) { return term.number == 0; });
  return out;
}

// The factor that most terms have; of those the longest to write, then the first.
std::optional<Factor> most_common(ReadingItems& items, const std::vector<Term>& terms) {
  std::map<Factor, std::size_t> counts;
  for (const Term& term : terms)
    for (const Factor& factor : factors_of(term)) ++counts[factor];
  std::optional<Factor> best;
  std::size_t most = 1;
  for (const auto& [factor, count] : counts) {
    if (count < 2 || count < most || items[factor.item].kind == Reading::Kind::number) continue;
    if (best && count == most) {
      const double length = items.length(factor.item), longest = items.length(best->item);
      if (length < longest || (length == longest && !items.before(factor.item, best->item))) continue;
    }
    best = factor;
    most = count;
  }
  return best;
}

Term sum_of(ReadingItems& items, std::vector<Term> terms, int depth);

std::vector<Term> collected(ReadingItems& items, std::vector<Term> terms, int depth) {
  std::vector<Term> out;
  while (const auto common = most_common(items, terms)) {
    const auto has = [](const Term& term, const Factor& factor) {
      const std::vector<Factor> factors = factors_of(term);
      return std::ranges::find(factors, factor) != factors.end();
    };
    const auto sharing =
        std::stable_partition(terms.begin(), terms.end(), [&](const Term& term) { return !has(term, *common); });
    std::vector<Term> inner(sharing, terms.end());
    terms.erase(sharing, terms.end());
    std::vector<Factor> shared = factors_of(inner.front());
    std::erase_if(shared, [&](const Factor& factor) {
      return std::ranges::any_of(inner, [&](const Term& term) { return !has(term, factor); });
    });
    for (Term& term : inner)
      for (const Factor& factor : shared) take(term, factor);
    Term product = sum_of(items, std::move(inner), depth + 1);
    for (const Factor& factor : shared) put(product, factor);
    out.push_back(std::move(product));
  }
  out.insert(out.end(), std::make_move_iterator(terms.begin()), std::make_move_iterator(terms.end()));
  return out;
}

// Highest time derivatives first, as equations of motion are written; numbers last; no minus in front where any term
// has none.  The sum is of the sign in which the graph keeps it, where it can be: it is then read the same again.
Term sorted_sum(ReadingItems& items, const std::vector<Term>& terms) {
  std::vector<Reading::Operand> operands;
  for (const Term& term : terms) operands.push_back({items.magnitude(term), term.number < 0});
  std::ranges::sort(operands, [&](const Reading::Operand& x, const Reading::Operand& y) {
    const auto is_number = [&](std::size_t item) { return items[item].kind <= Reading::Kind::pi; };
    const auto group = [&](std::size_t item) { return std::tuple(is_number(item), -items.degree(item)); };
    if (group(x.item) != group(y.item)) return group(x.item) < group(y.item);
    return items.before(x.item, y.item);
  });
  const auto positive = std::ranges::find(operands, false, &Reading::Operand::opposite);
  const bool minus = positive == operands.end();
  if (minus)
    for (Reading::Operand& operand : operands) operand.opposite = false;
  else
    std::rotate(operands.begin(), positive, positive + 1);
  const std::size_t sum = items.sum(operands);
  const auto negative = std::ranges::find(operands, true, &Reading::Operand::opposite);
  if (!items.is_negative(sum) || negative == operands.end()) return {minus ? -1.0 : 1.0, {sum}, {}};
  for (Reading::Operand& operand : operands) operand.opposite = !operand.opposite;
  std::rotate(operands.begin(), negative, negative + 1);
  return {-1.0, {items.sum(std::move(operands))}, {}};
}

Term sum_of(ReadingItems& items, std::vector<Term> terms, int depth) {
  terms = with_like_terms_added(std::move(terms));
  if (terms.empty()) return {0, {}, {}};
  if (terms.size() <= most_collected && depth < deepest_collecting) terms = collected(items, std::move(terms), depth);
  if (terms.size() == 1) return std::move(terms.front());
  const double size = std::fabs(terms.front().number);
  const bool common = std::ranges::all_of(terms, [&](const Term& term) { return std::fabs(term.number) == size; });
  if (common)
    for (Term& term : terms) term.number = term.number < 0 ? -1 : 1;
  Term out = sorted_sum(items, terms);
  if (common) out.number *= size;
  return out;
}

}  // namespace

Term sum_of(ReadingItems& items, std::vector<Term> terms) { return sum_of(items, std::move(terms), 0); }

}  // namespace spacetime::symbolic
