// A problem with everything that is made from it to iterate: its transcription, a window's, layout and Newton.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/motion.h"
#include "common/problem.h"
#include "optimizer/newton.h"
#include "optimizer/reshape.h"

namespace spacetime::optimizer {

// What holds for the iterations beside the problem.
struct Setting {
  Window window;
  std::map<std::string, double> damping;  // by degree of freedom: most change of a value in one iteration
};

// The parts refer to one another, so it stays where it is.
struct Numerics {
  Problem problem;
  Transcription whole;
  Freedom freedom;
  std::optional<Transcription> part;  // in a window
  Layout layout;
  Newton newton;

  // Throws InputError where the problem makes no sense with its constants' values.
  Numerics(Problem problem, const Setting& setting);
  Numerics(const Numerics&) = delete;
  Numerics& operator=(const Numerics&) = delete;

  const Transcription& t() const { return part ? *part : whole; }  // what is iterated
  // The unknowns of that, out of all; what a window leaves as it is is settled, in x too.  And back.
  std::vector<double> open(std::vector<double>& x);
  void close(const std::vector<double>& own, std::vector<double>& x) const;
};

// Coefficients and parameters: what a problem asks for, functionals left out.
double count_unknowns(const Problem& problem);

// All unknowns where a problem starts: its keyframes and declared values, or a motion as far as it goes.
std::vector<double> start_of(const Problem& problem, const Transcription& whole, const Motion* from);

// Each degree of freedom's coefficients, out of all unknowns.
Curves curves_of(const Transcription& whole, const std::vector<double>& x);

}  // namespace spacetime::optimizer
