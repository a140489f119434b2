// Expressions as people write them: sums of several terms, products with numerators and denominators, powers, parts
// with names of their own.
//
// The graph's nodes say what is computed; a reading says how it is put on paper.  Every item carries the node that
// the language makes of it when it is written down and read again, found by calling the same constructors in the same
// order.  So a text made of a reading parses back to exactly these nodes, whatever has been collected or rearranged.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "symbolic/model.h"

namespace spacetime::symbolic {

struct Reading {
  enum class Kind : std::uint8_t {
    number,
    pi,        // number * pi
    input,     // name, with `number` primes
    sum,       // opposite: subtracted
    product,   // opposite: divided by
    negative,  // of one operand
    power,     // base, exponent
    call,      // name(operands)
    less,
    less_equal,
    logical_and,
    logical_or,
    logical_not,
  };
  struct Operand {
    std::size_t item = 0;
    bool opposite = false;
  };
  struct Item {
    Kind kind = Kind::number;
    Expr expr{};  // what it is in the graph
    double number = 0;
    std::string name{};
    std::vector<Operand> operands{};
    InputKind input = InputKind::time;  // of an input
  };

  std::vector<Item> items;         // operands stand before what they are operands of
  std::vector<std::size_t> roots;  // what was asked for, a component each
  std::vector<std::size_t> order;  // the items in use, operands first, as a reader meets them
  std::vector<std::size_t> parts;  // of these, those that get names, in the same order

  bool is_part(std::size_t item) const { return part_number[item] >= 0; }
  std::vector<int> part_number;  // of each item: its place in parts, or -1
};

// `values`, factored: products' factors and sums' terms gathered, like terms added, common factors collected, and
// sorted; powers, quotients and signs as they are written.  What is used more than once, or too long to be read in one
// go, becomes a part.  Equal to the values but for rounding.
//
// What the language cannot write is put into words it has: a number as a condition, a condition as a number.
Reading read(Model& model, std::span<const Expr> values);

inline bool is_condition(Reading::Kind kind) { return kind >= Reading::Kind::less; }
inline bool is_leaf(Reading::Kind kind) { return kind <= Reading::Kind::input; }

}  // namespace spacetime::symbolic
