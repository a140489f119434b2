#include "symbolic/lowering.h"

#include <algorithm>
#include <utility>

#include "common/assert.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

constexpr Op odd_functions[] = {
    Op::sine, Op::tangent, Op::arc_sine, Op::arc_tangent, Op::hyperbolic_sine, Op::hyperbolic_tangent, Op::sign};
constexpr Op even_functions[] = {Op::cosine, Op::hyperbolic_cosine, Op::absolute};

constexpr int most_rounds = 10;  // of improving signs; after a few nothing changes any more

bool is_among(std::span<const Op> ops, Op op) { return std::ranges::find(ops, op) != ops.end(); }

}  // namespace

Lowering::Lowering(Graph& graph, std::span<const Expr> roots) : graph_(graph) {
  collect(roots);
  fuse();
  choose_signs();
  settle();
}

Signed Lowering::stripped(Expr e) const {
  const bool minus = graph_.is_operation(e, Op::negate);
  return {minus ? graph_.node(e).a : e, minus};
}

void Lowering::collect(std::span<const Expr> roots) {
  const auto needed = reachable(graph_, roots);
  rows_.resize(needed.size());
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    const auto& n = graph_.node({id});
    if (graph_.constant({id})) rows_[id].kept = kept_both, rows_[id].is_number = true;
    if (!needed[id] || n.kind != Graph::Kind::operation || n.op == Op::negate) continue;
    auto& row = rows_[id];
    row.op = n.op;
    row.x = {stripped(n.a), stripped(n.b), stripped(n.c)};
    row.form = Form::function;
    if (n.op == Op::add || n.op == Op::subtract) row.form = Form::sum;
    if (n.op == Op::subtract) row.x[1].minus = !row.x[1].minus;
    if (n.op == Op::multiply || n.op == Op::divide) row.form = Form::product;
    if (is_among(odd_functions, n.op)) row.form = Form::odd;
    if (is_among(even_functions, n.op)) row.form = Form::even;
    if (n.op == Op::select) row.form = Form::choice;
    for (int k = 0; k < info(n.op).arity; ++k) ++rows_[row.x[k].node.id].uses;
    order_.push_back(id);
  }
  for (const auto root : roots) {
    const auto [node, minus] = stripped(root);
    ++rows_[node.id].uses;
    rows_[node.id].wanted |= minus ? kept_minus : kept_plus;
  }
}

bool Lowering::is_lone_product(Expr e) const {
  const auto& row = rows_[e.id];
  return row.form == Form::product && row.op == Op::multiply && row.wanted == 0;
}

// Fuses the product x[k] into its sum.
void Lowering::take(std::uint32_t sum, int k) {
  auto& row = rows_[sum];
  auto& product = rows_[row.x[k].node.id];
  row.form = Form::fused;
  row.taken = row.x[k];
  row.x = {row.x[1 - k], product.x[0], product.x[1]};
  row.x[1].minus ^= row.taken.minus;
  --product.uses;
  for (const auto& x : product.x) rows_[x.node.id].uses += product.uses > 0 ? 1 : 0;
}

// A product whose only use is a sum goes into it.  One with several uses goes too where all of them are sums that have
// no other product to take: then nobody needs it by itself.
void Lowering::fuse() {
  std::vector<std::uint32_t> takers(rows_.size());  // sums without a product of their own, by the product
  for (const auto id : order_) {
    const auto& row = rows_[id];
    for (int k = 1; k >= 0 && row.form == Form::sum; --k) {
      if (is_lone_product(row.x[k].node) && rows_[row.x[k].node.id].uses == 1) take(id, k);
    }
    if (row.form != Form::sum) continue;
    for (int k = 0; k < 2; ++k) ++takers[row.x[k].node.id];
  }
  for (const auto id : order_) {
    const auto& row = rows_[id];
    for (int k = 1; k >= 0 && row.form == Form::sum; --k) {
      const auto product = row.x[k].node, other = row.x[1 - k].node;
      if (!is_lone_product(product) || takers[product.id] != rows_[product.id].uses) continue;
      --takers[product.id];
      take(id, k);
      --takers[other.id];
    }
  }
}

// Whether one operation gives the row's value, or its negative, from what is at hand.
bool Lowering::fits(const Row& row, bool negated) const {
  const auto has_with = [&](Signed x) { return has({x.node, x.minus != negated}); };
  const auto product = [&](Signed a, Signed b) {
    const auto p = rows_[a.node.id].kept, q = rows_[b.node.id].kept;
    const bool opposite = (a.minus != b.minus) != negated;
    return opposite ? ((p & kept_plus) && (q & kept_minus)) || ((p & kept_minus) && (q & kept_plus)) : (p & q) != 0;
  };
  const auto& x = row.x;
  switch (row.form) {
    case Form::leaf:
      return false;
    case Form::sum:
      return has_with(x[0]) || has_with(x[1]);
    case Form::product:
      return product(x[0], x[1]);
    case Form::fused:
      return has_with(x[0]) && product(x[1], x[2]);
    case Form::odd:
      return has_with(x[0]);
    case Form::even:
      return !negated;
    case Form::function:
      return !negated && has(x[0]) && (info(row.op).arity < 2 || has(x[1])) && (info(row.op).arity < 3 || has(x[2]));
    case Form::choice:
      return has_with(x[1]) && has_with(x[2]);
  }
  return false;
}

// The operands that fit, with the signs that are taken; of a sum, the second may be at hand only with the other sign,
// to be subtracted.
std::array<Signed, 3> Lowering::arranged(const Row& row, bool negated) const {
  auto x = row.x;
  const auto flip = [&](Signed& a) { a.minus = a.minus != negated; };
  const auto take_any_sign = [&](Signed& a) { a.minus = !has({a.node, false}); };
  const auto arrange_product = [&](Signed& a, Signed& b) {
    const bool opposite = (a.minus != b.minus) != negated;
    for (const bool sign : {false, true}) {
      a.minus = sign, b.minus = sign != opposite;
      if (has(a) && has(b)) return;
    }
  };
  switch (row.form) {
    case Form::sum:
      flip(x[0]), flip(x[1]);
      if (!has(x[0])) std::swap(x[0], x[1]);
      break;
    case Form::product:
      arrange_product(x[0], x[1]);
      break;
    case Form::fused:
      flip(x[0]), arrange_product(x[1], x[2]);
      break;
    case Form::odd:
      flip(x[0]);
      break;
    case Form::even:
      take_any_sign(x[0]);
      break;
    case Form::choice:
      take_any_sign(x[0]), flip(x[1]), flip(x[2]);
      break;
    case Form::leaf:
    case Form::function:
      break;
  }
  return x;
}

// The operations beyond one that a row costs.
int Lowering::trouble(std::uint32_t id) const {
  const auto& row = rows_[id];
  if (row.uses == 0 || row.is_number) return 0;
  const int missing = (row.wanted & ~row.kept) != 0 ? 1 : 0;
  const int twice = row.kept == kept_both ? 1 : 0;
  if (row.form == Form::leaf) return twice + missing;
  const bool made = ((row.kept & kept_plus) && fits(row, false)) || ((row.kept & kept_minus) && fits(row, true));
  return twice + missing + (made ? 0 : 1);
}

// Descent: whatever has a part in some trouble takes the sign that makes least of it, until nothing improves.
void Lowering::choose_signs() {
  // The users of each row, behind one another in one list.
  std::vector<std::uint32_t> first(rows_.size() + 1), users;
  const auto for_each_use = [&](auto f) {
    for (const auto id : order_) {
      const auto& row = rows_[id];
      for (int k = 0; row.uses > 0 && k < info(row.form == Form::fused ? Op::multiply_add : row.op).arity; ++k)
        f(id, row.x[k].node.id);
    }
  };
  for_each_use([&](std::uint32_t, std::uint32_t used) { ++first[used + 1]; });
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  users.resize(first.back());
  auto next = first;
  for_each_use([&](std::uint32_t id, std::uint32_t used) { users[next[used]++] = id; });
  const auto users_of = [&](std::uint32_t id) {
    return std::span(users).subspan(first[id], first[id + 1] - first[id]);
  };

  std::vector<std::uint32_t> pending;
  std::vector<std::uint8_t> is_pending(rows_.size());
  const auto offer = [&](std::uint32_t id) {
    if (is_pending[id] || rows_[id].uses == 0 || rows_[id].is_number) return;
    is_pending[id] = 1;
    pending.push_back(id);
  };
  const auto offer_around = [&](std::uint32_t id) {
    offer(id);
    if (rows_[id].form == Form::leaf) return;
    for (const auto& x : rows_[id].x) offer(x.node.id);
  };
  for (std::uint32_t id = 0; id < rows_.size(); ++id) {
    if (trouble(id) > 0) offer_around(id);
  }
  const auto improve = [&](std::uint32_t id) {
    is_pending[id] = 0;
    auto& row = rows_[id];
    const auto total = [&] {
      int sum = trouble(id);
      for (const auto user : users_of(id)) sum += trouble(user);
      return sum;
    };
    const auto before = row.kept;
    auto best = before;
    int least = total();
    for (const auto kept : {kept_plus, kept_minus, kept_both}) {
      if (kept == kept_minus && row.form == Form::leaf) continue;
      row.kept = kept;
      const int count = total();
      if (count < least) least = count, best = kept;
    }
    row.kept = best;
    if (best == before) return;
    offer_around(id);
    for (const auto user : users_of(id)) {
      if (trouble(user) > 0) offer_around(user);
    }
  };
  for (int round = 0; round < most_rounds && !pending.empty(); ++round) {
    const auto now = std::exchange(pending, {});
    for (auto id = now.rbegin(); id != now.rend(); ++id) improve(*id);
  }
}

// Pays for the trouble that is left, so that everything wanted can be made.
void Lowering::settle() {
  for (auto& row : rows_) {
    if ((row.wanted & ~row.kept) != 0) row.kept = kept_both;
  }
  for (const auto id : order_) {
    auto& row = rows_[id];
    if (row.uses == 0) continue;
    if (!fits(row, false) && !fits(row, true)) {
      if (row.form == Form::fused) {  // the product is made by itself, with the sign that is to be had
        auto& product = rows_[row.taken.node.id];
        if (product.uses++ == 0) product.kept = fits(product, false) ? kept_plus : kept_minus;
        row.form = Form::sum;
        row.x = {row.x[0], row.taken, {}};
      } else {
        for (const auto& x : row.x) {
          if (!has(x)) rows_[x.node.id].kept = kept_both;
        }
      }
    }
    const bool as_is = fits(row, false), negated = fits(row, true);
    SPACETIME_ASSERT(as_is || negated);
    if ((row.kept == kept_plus && !as_is) || (row.kept == kept_minus && !negated)) row.kept = kept_both;
  }
}

Signed Lowering::value(Expr root) { return literal(stripped(root)); }

bool Lowering::is_made_by_negation(Signed value) const {
  return value.node.id < rows_.size() && !fits(rows_[value.node.id], value.minus);
}

Operation Lowering::operation(Signed value) {
  const auto& row = rows_[value.node.id];
  if (is_made_by_negation(value)) return {Op::negate, {Signed{value.node, !value.minus}}};
  auto x = arranged(row, value.minus);
  auto op = row.op;
  if (row.form == Form::sum) {
    op = has(x[1]) ? Op::add : Op::subtract;
    if (op == Op::subtract) x[1].minus = !x[1].minus;
  }
  if (row.form == Form::fused) op = Op::multiply_add, x = {x[1], x[2], x[0]};
  for (int k = 0; k < info(op).arity; ++k) x[k] = literal(x[k]);
  return {op, x};
}

// A negative number is a number of its own.
Signed Lowering::literal(Signed value) {
  if (!value.minus || !graph_.constant(value.node)) return value;
  return {graph_.negate(value.node)};
}

}  // namespace spacetime::symbolic
