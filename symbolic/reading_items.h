// The items of a reading while it is made: each written form once, with the node that it stands for.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/reading.h"

namespace spacetime::symbolic {

// number * over / under.  Factors may repeat; numbers among them are left as they are.
struct Term {
  double number = 1;
  std::vector<std::size_t> over, under;
};

class ReadingItems {
 public:
  explicit ReadingItems(Model& model);

  std::size_t number(double value);
  std::size_t pi(double multiple);
  std::size_t input(Expr e);
  std::size_t negative(std::size_t item);
  std::size_t sum(std::vector<Reading::Operand> terms);  // at least two, the first not subtracted
  std::size_t product(std::vector<std::size_t> over, std::vector<std::size_t> under);
  std::size_t power(std::size_t base, std::size_t exponent);
  std::size_t call(std::string name, Op op, std::vector<std::size_t> operands);
  std::size_t functional(FunctionalUse use, std::vector<std::size_t> operands);
  std::size_t condition(Reading::Kind kind, Op op, std::vector<std::size_t> operands);

  // A term without its sign, factors in order and powers gathered.
  std::size_t magnitude(Term term);
  // A term with its sign.
  std::size_t item(const Term& term);

  // The order in which factors stand in products, and terms of one degree in sums: numbers, constants, the motion,
  // functions, sums; by name among their like.
  bool before(std::size_t x, std::size_t y);
  // The highest time derivative of the motion in it, counted from 1; 0 where nothing moves.
  int degree(std::size_t item) const { return notes_[item].degree; }
  // How long it is when written out, in characters, about.
  double length(std::size_t item) const { return notes_[item].length; }
  // How many relations a condition is made of.
  double relations(std::size_t item) const { return notes_[item].relations; }
  bool is_negative(std::size_t item) const { return model_.graph.is_operation(items_[item].expr, Op::negate); }
  const Reading::Item& operator[](std::size_t item) const { return items_[item]; }

  std::vector<Reading::Item> take() { return std::move(items_); }

 private:
  struct Note {
    std::string key;  // to sort by
    int degree = 0;
    double length = 0, relations = 0;
  };

  std::size_t enter(Reading::Item item);
  std::size_t turned(std::size_t item);
  Note note(const Reading::Item& item) const;
  std::string key(const Reading::Item& item) const;
  std::string declared(const Reading::Item& item) const;
  std::vector<std::size_t> with_powers(std::vector<std::size_t> factors);

  Model& model_;
  std::vector<Reading::Item> items_;
  std::vector<Note> notes_;
  std::unordered_map<std::uint32_t, std::size_t> by_node_;
  std::unordered_map<std::string, std::size_t> places_;  // of inputs' names in the scene
};

}  // namespace spacetime::symbolic
