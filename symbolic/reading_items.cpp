#include "symbolic/reading_items.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "symbolic/functional.h"
#include "symbolic/written_number.h"

namespace spacetime::symbolic {
namespace {

using Kind = Reading::Kind;
using Operand = Reading::Operand;

constexpr char key_end = '~';
constexpr std::size_t longest_key = 48;  // enough to tell names apart; fingerprints settle the rest

std::vector<Operand> operands_of(const std::vector<std::size_t>& items) {
  std::vector<Operand> out;
  for (const std::size_t item : items) out.push_back({item, false});
  return out;
}

// By which letter of the alphabet an item sorts among factors.
char rank(const Reading::Item& item) {
  switch (item.kind) {
    case Kind::number:
      return 'a';
    case Kind::pi:
      return 'b';
    case Kind::input:
      return item.input == InputKind::constant    ? 'c'
             : item.input == InputKind::parameter ? 'd'
             : item.input == InputKind::time      ? 'e'
                                                  : 'f';
    case Kind::call:
      return 'h';
    case Kind::product:
      return 'i';
    case Kind::sum:
      return 'j';
    default:
      return 'k';
  }
}

}  // namespace

ReadingItems::ReadingItems(Model& model) : model_(model) {
  for (const Constant& constant : model.problem.constants) places_.try_emplace(constant.name, places_.size());
  for (const Parameter& parameter : model.problem.parameters) places_.try_emplace(parameter.name, places_.size());
  for (const Dof& dof : model.problem.dofs) places_.try_emplace(dof.name, places_.size());
}

std::size_t ReadingItems::enter(Reading::Item item) {
  const auto [found, is_new] = by_node_.try_emplace(item.expr.id, items_.size());
  if (is_new) {
    notes_.push_back(note(item));
    items_.push_back(std::move(item));
  }
  return found->second;
}

// Names in the order of their declaration.
std::string ReadingItems::declared(const Reading::Item& item) const {
  const auto place = places_.find(item.name);
  const std::string number = std::to_string(place == places_.end() ? 0 : place->second);
  return std::string(8 - std::min<std::size_t>(8, number.size()), '0') + number + item.name +
         static_cast<char>('0' + static_cast<int>(item.number));
}

// To sort by: rank and name, then the operands'; numbers do not count in products.  Powers stand by their bases, the
// higher first.
std::string ReadingItems::key(const Reading::Item& item) const {
  if (item.kind == Kind::power) {
    std::string out = notes_[item.operands[0].item].key;
    const double exponent = items_[item.operands[1].item].number;
    out.back() = static_cast<char>(key_end - std::clamp(exponent, 1.0, 64.0));
    return out;
  }
  const bool is_product = item.kind == Kind::product;
  std::string out;
  if (!is_product) out = rank(item) + (item.kind == Kind::input ? declared(item) : item.name);
  for (std::size_t i = 0; i < item.operands.size() && out.size() < longest_key; ++i) {
    const std::size_t operand = item.operands[i].item;
    if (!is_product || items_[operand].kind != Kind::number) out += notes_[operand].key;
  }
  out.resize(std::min(out.size(), longest_key));
  if (!is_product || out.empty()) out += key_end;
  return out;
}

ReadingItems::Note ReadingItems::note(const Reading::Item& item) const {
  Note out;
  if (item.kind == Kind::input && item.input == InputKind::dof) out.degree = 1 + static_cast<int>(item.number);
  if (item.kind == Kind::less || item.kind == Kind::less_equal) out.relations = 1;
  out.length = static_cast<double>(item.name.size()) + 1;
  if (item.kind == Kind::number || item.kind == Kind::pi)
    out.length = static_cast<double>(written(item.number).size()) + (item.kind == Kind::pi ? 2 : 0);
  for (const Operand& operand : item.operands) {
    const Note& part = notes_[operand.item];
    out.degree = std::max(out.degree, part.degree);
    out.length += part.length + 2;
    out.relations += part.relations;
  }
  out.key = key(item);
  return out;
}

bool ReadingItems::before(std::size_t x, std::size_t y) {
  if (x == y) return false;
  if (const int order = notes_[x].key.compare(notes_[y].key); order != 0) return order < 0;
  const auto a = model_.fingerprints.of(items_[x].expr), b = model_.fingerprints.of(items_[y].expr);
  return a != b ? a < b : x < y;
}

std::size_t ReadingItems::number(double value) {
  return enter({.kind = Kind::number, .expr = model_.graph.number(value), .number = value});
}

std::size_t ReadingItems::pi(double multiple) {
  return enter({.kind = Kind::pi, .expr = model_.graph.pi(multiple), .number = multiple});
}

std::size_t ReadingItems::input(Expr e) {
  const Input& input = model_.graph.input_of(e);
  return enter({.kind = Kind::input,
                .expr = e,
                .number = static_cast<double>(input.derivative),
                .name = input.kind == InputKind::time ? "t" : input.name,
                .input = input.kind});
}

std::size_t ReadingItems::negative(std::size_t item) {
  if (items_[item].kind == Kind::number) return number(-items_[item].number);
  if (items_[item].kind == Kind::pi) return pi(-items_[item].number);
  return enter({.kind = Kind::negative, .expr = model_.graph.negate(items_[item].expr), .operands = {{item, false}}});
}

std::size_t ReadingItems::sum(std::vector<Operand> terms) {
  Graph& graph = model_.graph;
  Expr e = items_[terms.front().item].expr;
  for (std::size_t i = 1; i < terms.size(); ++i) {
    const Expr term = items_[terms[i].item].expr;
    e = terms[i].opposite ? graph.subtract(e, term) : graph.add(e, term);
  }
  return enter({.kind = Kind::sum, .expr = e, .operands = std::move(terms)});
}

std::size_t ReadingItems::product(std::vector<std::size_t> over, std::vector<std::size_t> under) {
  if (over.empty()) over.push_back(number(1));
  if (over.size() == 1 && under.empty()) return over.front();
  Graph& graph = model_.graph;
  const auto all = [&](const std::vector<std::size_t>& factors) {
    Expr e = items_[factors.front()].expr;
    for (std::size_t i = 1; i < factors.size(); ++i) e = graph.multiply(e, items_[factors[i]].expr);
    return e;
  };
  Expr e = all(over);
  if (!under.empty()) e = graph.divide(e, all(under));
  std::vector<Operand> operands = operands_of(over);
  for (const std::size_t factor : under) operands.push_back({factor, true});
  return enter({.kind = Kind::product, .expr = e, .operands = std::move(operands)});
}

std::size_t ReadingItems::power(std::size_t base, std::size_t exponent) {
  return enter({.kind = Kind::power,
                .expr = model_.graph.power(items_[base].expr, items_[exponent].expr),
                .operands = operands_of({base, exponent})});
}

std::size_t ReadingItems::call(std::string name, Op op, std::vector<std::size_t> operands) {
  std::array<Expr, 3> e{};
  for (std::size_t i = 0; i < operands.size(); ++i) e[i] = items_[operands[i]].expr;
  return enter({.kind = Kind::call,
                .expr = model_.graph.operation(op, e[0], e[1], e[2]),
                .name = std::move(name),
                .operands = operands_of(operands)});
}

std::size_t ReadingItems::functional(FunctionalUse use, std::vector<std::size_t> operands) {
  use.integrand = items_[operands[0]].expr;
  if (operands.size() > 1) use.from = items_[operands[1]].expr;
  if (operands.size() > 2) use.to = items_[operands[2]].expr;
  return enter({.kind = Kind::call,
                .expr = symbolic::functional(model_, use),
                .name = use.kind == Functional::Kind::at ? "at" : "integral",
                .operands = operands_of(operands)});
}

std::size_t ReadingItems::condition(Kind kind, Op op, std::vector<std::size_t> operands) {
  std::array<Expr, 2> e{};
  for (std::size_t i = 0; i < operands.size(); ++i) e[i] = items_[operands[i]].expr;
  return enter({.kind = kind, .expr = model_.graph.operation(op, e[0], e[1]), .operands = operands_of(operands)});
}

// Sorted, and x*x*x as x^3.
std::vector<std::size_t> ReadingItems::with_powers(std::vector<std::size_t> factors) {
  std::ranges::sort(factors, [&](std::size_t x, std::size_t y) { return before(x, y); });
  std::vector<std::size_t> out;
  for (auto at = factors.begin(); at != factors.end();) {
    const auto end = std::find_if(at, factors.end(), [&](std::size_t x) { return x != *at; });
    const auto count = static_cast<double>(end - at);
    out.push_back(count > 1 ? power(*at, number(count)) : *at);
    at = end;
  }
  return out;
}

std::size_t ReadingItems::magnitude(Term term) {
  const double size = std::fabs(term.number);
  std::vector<std::size_t> over = with_powers(std::move(term.over)), under = with_powers(std::move(term.under));
  if (over.empty() && under.empty()) return number(size);
  if (size != 1) {
    const Fraction fraction = fraction_of(size);
    if (fraction.below != 1) under.insert(under.begin(), number(fraction.below));
    if (fraction.above != 1) over.insert(over.begin(), number(fraction.above));
  }
  return product(std::move(over), std::move(under));
}

std::size_t ReadingItems::item(const Term& term) {
  const std::size_t out = magnitude(term);
  return term.number < 0 ? turned(out) : out;
}

// -(a - b) as b - a, where the graph makes the same of it.
std::size_t ReadingItems::turned(std::size_t item) {
  std::vector<Operand> terms = items_[item].operands;
  const auto first = std::ranges::find(terms, true, &Operand::opposite);
  if (items_[item].kind != Kind::sum || first == terms.end()) return negative(item);
  for (Operand& term : terms) term.opposite = !term.opposite;
  std::rotate(terms.begin(), first, first + 1);
  const std::size_t out = sum(std::move(terms));
  return items_[out].expr == model_.graph.negate(items_[item].expr) ? out : negative(item);
}

}  // namespace spacetime::symbolic
