// The expression graph: hash-consed nodes in an arena, handles are integers.
//
// Two expressions that are built alike are one node, so equality is equality of handles and every pass that walks
// nodes once is linear in the shared size, however large the tree would be.  Operands always have smaller ids than
// the node they make: a walk over ids in rising order visits operands first and needs no recursion.
#pragma once

#include <array>
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
    Expr a{}, b{}, c{};       // operation
    double number = 0;        // number: the value; pi: the multiple
    std::uint32_t input = 0;  // index into inputs()
    bool operator==(const Node&) const = default;
  };

  Graph();  // node 0 is the number 0, so that a default Expr is zero in every graph

  // Leaves.
  Expr number(double value);     // must be finite
  Expr pi(double multiple = 1);  // multiple * pi, kept exact: cos(pi(0.5)) is number(0)
  Expr input(const Input& input);

  // Operations; each folds what is known (0*x, x*1, x-x, numbers, exact multiples of pi in sin/cos/tan, signs pulled
  // outwards, ...) and puts the operands of commutative operations in canonical order.  A fold whose result is not
  // finite is not made: the node stays, and is_undefined() finds it.  The rules are in fold.cpp.
  Expr operation(Op op, Expr a, Expr b = {}, Expr c = {});
  Expr add(Expr a, Expr b);
  Expr subtract(Expr a, Expr b);
  Expr multiply(Expr a, Expr b);
  Expr divide(Expr a, Expr b);
  Expr negate(Expr a);
  Expr power(Expr a, Expr b);  // small integer exponents become products
  Expr sine(Expr a);
  Expr cosine(Expr a);
  Expr square_root(Expr a);
  Expr select(Expr condition, Expr a, Expr b);

  const Node& node(Expr e) const { return nodes_[e.id]; }
  const Input& input_of(Expr e) const { return inputs_[nodes_[e.id].input]; }
  std::size_t size() const { return nodes_.size(); }
  const std::vector<Input>& inputs() const { return inputs_; }

  bool is_number(Expr e, double value) const;
  bool is_operation(Expr e, Op op) const { return nodes_[e.id].kind == Kind::operation && nodes_[e.id].op == op; }
  // The value of a number or a multiple of pi; nothing for anything else.
  std::optional<double> constant(Expr e) const;
  // An operation whose operands are all constant but whose value is not finite, such as 1/0.
  bool is_undefined(Expr e) const;

 private:
  // The node as it stands, unfolded: the one there is, or a new one.
  Expr intern(const Node& node);
  Expr make(Op op, Expr a, Expr b = {}, Expr c = {});
  void grow();

  bool is_constant(Expr e) const { return nodes_[e.id].kind == Kind::number || nodes_[e.id].kind == Kind::pi; }
  bool is_condition(Expr e) const;
  std::optional<Expr> fold_constants(Op op, Expr a, Expr b, Expr c);
  Expr scaled(Expr coefficient, Expr e);
  Expr tangent(Expr a);
  Expr comparison(Op op, Expr a, Expr b);
  Expr logical(Op op, Expr a, Expr b);
  Expr function(Op op, Expr a);

  std::vector<Node> nodes_;
  std::vector<Input> inputs_;
  std::unordered_map<std::string, Expr> input_nodes_;  // by kind, derivative, index and name
  std::vector<std::uint32_t> table_;                   // open addressing; node ids, 0 where empty (node 0 is not in it)
};

}  // namespace spacetime::symbolic
