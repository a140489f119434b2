// A value of a program as people write it, for messages: "sqrt(x - 2*k*t)".
#pragma once

#include <string>

#include "common/problem.h"

namespace spacetime::optimizer {

// The expression of value number `value`, which stands at the sample's time.  Where it would be longer than some 60
// characters its inner parts are left out: "sqrt(a*... + b)".
std::string infix(const Problem& problem, const Program& program, int value);

}  // namespace spacetime::optimizer
