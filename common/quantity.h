// Numbers that follow from constants, and the times they make.
#pragma once

#include <string>
#include <vector>

namespace spacetime {

// Where in the scene's text something was written; 1-based, 0 where unknown.
struct Place {
  int line = 0, column = 0;
  bool operator==(const Place&) const = default;
};

// A number, or one output of a program over constants, re-evaluated whenever a constant is set.
struct Quantity {
  double number = 0;    // used where `program` is empty
  std::string program;  // key into Problem::programs, or empty
  int output = 0;       // which of the program's values
  bool operator==(const Quantity&) const = default;
};

// The times at which a statement is sampled.
struct Scope {
  enum class Kind {
    once,   // depends on no time: a single instance over functionals, parameters and constants alone
    times,  // at `times`
    every,  // from, from + step, ..., and always to
    count,  // `count` evenly spaced, both ends among them
    knots,  // from, to and every knot between (the finest basis among the program's degrees of freedom)
    whole,  // as knots, over the problem's whole time
  } kind = Kind::whole;
  std::vector<Quantity> times;
  Quantity from, to, step;
  int count = 0;
  bool operator==(const Scope&) const = default;
};

}  // namespace spacetime
