// Which equations say nothing new: rows of the Jacobian that are combinations of others.
#pragma once

#include <string>
#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime::optimizer {

// Equations of one statement that follow from others, at first order.
struct Dependence {
  int statement = 0;          // index of the constraint
  std::vector<int> others;    // constraints that it follows from, its own other instances among them; empty where it
                              // does not depend on anything that is free
  std::vector<double> times;  // s, one an equation; not a number where there is none
  bool repeated = false;      // each is a multiple of a single other equation
  bool operator==(const Dependence&) const = default;
};

struct Dependences {
  int equations = 0;  // looked at
  std::vector<Dependence> all;
};

// Of the hard equations that count (all where `active` is empty).  Nothing where they are too many, and couple too
// widely, for the search to be a small part of a solve.
Dependences dependences(const Transcription& transcription, const Layout& layout, const BorderedMatrix& jacobian,
                        const std::vector<char>& active);

// "8 of 64 equations follow from others: ..."; empty where there is none.
std::string sentence(const Problem& problem, const Dependences& dependences);

}  // namespace spacetime::optimizer
