// The expression graph: hash-consed nodes in an arena, handles are integers.
//
// Two expressions that are built alike are one node, so equality is equality of handles and every pass that walks
// nodes once is linear in the shared size, however large the tree would be.  Operands always have smaller ids than
// the node they make: a walk over ids in rising order visits operands first and needs no recursion.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/program.h"

namespace spacetime::symbolic {

struct Expr {
  std::uint32_t id = 0;
  bool operator==(const Expr&) const = default;
  auto operator<=>(const Expr&) const = default;
};

class Graph {
 public:
  enum class Kind : std::uint8_t {
    number,     // a literal
    pi,         // an exact multiple of pi
    input,      // see Input
    operation,  // op over operands
  };
  struct Node {
    Kind kind = Kind::number;
    Op op = Op::add;
    Expr a, b, c;               // operation
    double number = 0;          // number: the value; pi: the multiple
    std::uint32_t input = 0;    // index into inputs()
  };

  Graph();

  // Leaves.
  Expr number(double value);            // must be finite
  Expr pi(double multiple = 1);         // multiple * pi, kept exact: cos(pi(0.5)) is number(0)
  Expr input(const Input& input);

  // Operations; each folds what is known (0*x, x*1, x-x, numbers, exact multiples of pi in sin/cos/tan, signs pulled
  // outwards, ...) and puts the operands of commutative operations in canonical order.  A fold whose result is not
  // finite is not made: the node stays, and is_undefined() finds it.
  Expr operation(Op op, Expr a, Expr b = {}, Expr c = {});
  Expr add(Expr a, Expr b);
  Expr subtract(Expr a, Expr b);
  Expr multiply(Expr a, Expr b);
  Expr divide(Expr a, Expr b);
  Expr negate(Expr a);
  Expr power(Expr a, Expr b);           // small integer exponents become products
  Expr sine(Expr a);
  Expr cosine(Expr a);
  Expr square_root(Expr a);
  Expr select(Expr condition, Expr a, Expr b);

  const Node& node(Expr e) const { return nodes_[e.id]; }
  const Input& input_of(Expr e) const { return inputs_[nodes_[e.id].input]; }
  std::size_t size() const { return nodes_.size(); }

  bool is_number(Expr e, double value) const;
  // The value of a number or a multiple of pi; nothing for anything else.
  std::optional<double> constant(Expr e) const;
  // An operation whose operands are all constant but whose value is not finite, such as 1/0.
  bool is_undefined(Expr e) const;

 private:
  std::vector<Node> nodes_;
  std::vector<Input> inputs_;
  // ... the hash table
};

}  // namespace spacetime::symbolic
