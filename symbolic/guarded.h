// Weights of derivative paths that lead through `select`, `min`, `max` and `abs`.
//
// The derivative along a path counts only where every choice on it was made that way.  Multiplying by 0 where it was
// not would let what has not been chosen spoil the result (0 * inf), so a weight keeps its conditions apart, as a sum
// of guarded terms, and they are selected after all multiplication:  [c] p * q = select(c, p q, 0).
#pragma once

#include <cstdint>
#include <vector>

#include "symbolic/graph.h"

namespace spacetime::symbolic {

// A plain expression almost always; otherwise (list > 0) a sum of guarded terms kept in a Guards.
struct Weight {
  Expr plain;
  std::uint32_t list = 0;
  bool is_zero() const { return list == 0 && plain == Expr{}; }
};

class Guards {
 public:
  explicit Guards(Graph& graph) : graph_(graph), lists_(1) {}

  // `e` where the condition is nonzero (or, with nonzero false, where it is zero), else nothing.
  Weight guarded(Expr condition, bool nonzero, Expr e);
  Weight times(Weight x, Weight y);
  Weight plus(Weight x, Weight y);
  Weight negated(Weight x);
  bool is_constant(Weight x) const { return x.list == 0 && graph_.constant(x.plain).has_value(); }
  // The weight as an expression: conditions selected.
  Expr total(Weight x);

 private:
  struct Literal {
    Expr condition;
    bool nonzero = true;
    auto operator<=>(const Literal&) const = default;
  };
  struct Term {
    std::vector<Literal> guard;  // all must hold; sorted
    Expr value;
  };
  using Terms = std::vector<Term>;

  Terms terms(Weight x) const;
  Weight stored(Terms terms);
  void accumulate(Terms& terms, Term term);
  Expr total(Terms terms);

  Graph& graph_;
  std::vector<Terms> lists_;
};

}  // namespace spacetime::symbolic
