// The throws of tests/reference/problems.md with their starts, for benchmarks of whole solves.
#pragma once

#include <string>
#include <vector>

#include "common/problem.h"

namespace spacetime {

std::string file_text(const std::string& path);  // from the root of the sources

struct Start {
  std::string name;
  std::vector<double> coefficients;  // of all degrees of freedom, one after another
};

struct Throw {
  std::string name;
  Problem problem;
  std::vector<Start> starts;
};

// `name`: P94, P94R, P94J or P92.  Its starts are the reference's S0 to S3 and, after them, its thirty random sketches,
// whose keys are for the arm (a ball's keys are those of the scene).
Throw throw_named(const std::string& name);

}  // namespace spacetime
