// From nodes to operations: which products are fused into the sums that use them, and with which sign each result is
// kept.
//
// There is one fused operation, a*b + c.  A difference such as c - a*b becomes one where -a is at hand instead of a,
// or where the whole is wanted negated.  So every result may be kept as it is, negated, or (for one operation more)
// both ways, and the signs are chosen so that few operations are needed in all.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "symbolic/graph.h"

namespace spacetime::symbolic {

// A node's value, or its negative.
struct Signed {
  Expr node{};
  bool minus = false;
  bool operator==(const Signed&) const = default;
};

struct Operation {
  Op op = Op::add;
  std::array<Signed, 3> operand{};
};

class Lowering {
 public:
  // For everything that the roots need.
  Lowering(Graph& graph, std::span<const Expr> roots);

  // A root as a value to be computed; leaves stand for themselves, never with minus.
  Signed value(Expr root);
  // Whether a value is made from its own negative.
  bool is_made_by_negation(Signed value) const;
  // How a value that is no leaf is made, from values in the same sense.
  Operation operation(Signed value);

 private:
  // What a node is made of:
  //   sum       x0 + x1, each x with its sign
  //   product   x0 x1 or x0 / x1: the signs multiply
  //   fused     x0 + x1 x2
  //   odd       a function of x0 that passes the sign on
  //   even      a function of x0 that forgets it
  //   function  any other: x as they are
  //   choice    x0 ? x1 : x2, where the sign of x0 is all the same
  enum class Form : std::uint8_t { leaf, sum, product, fused, odd, even, function, choice };
  // With which signs a value is at hand, as bits; a number is at hand with both, for nothing.
  enum Kept : std::uint8_t { kept_plus = 1, kept_minus = 2, kept_both = 3 };
  struct Row {
    Form form = Form::leaf;
    Op op = Op::add;
    Kept kept = kept_plus;
    bool is_number = false;
    std::array<Signed, 3> x{};
    Signed taken{};           // fused: the product x1 x2 as the node that it was
    std::uint32_t uses = 0;   // by rows and roots
    std::uint8_t wanted = 0;  // by roots: with these signs, as bits
  };

  void collect(std::span<const Expr> roots);
  void fuse();
  void choose_signs();
  void settle();

  Signed stripped(Expr e) const;
  bool is_lone_product(Expr e) const;  // a product that no root wants
  void take(std::uint32_t sum, int k);
  bool has(Signed value) const { return rows_[value.node.id].kept & (value.minus ? kept_minus : kept_plus); }
  bool fits(const Row& row, bool negated) const;
  std::array<Signed, 3> arranged(const Row& row, bool negated) const;
  int trouble(std::uint32_t id) const;
  Signed literal(Signed value);

  Graph& graph_;
  std::vector<Row> rows_;             // by id
  std::vector<std::uint32_t> order_;  // ids of the rows that are no leaves, operands first
};

}  // namespace spacetime::symbolic
