// How large a problem may be.  Documents are checked as far as their numbers alone tell (protocol); the optimizer
// counts what really comes of them, with the constants' values and the knots as they are.
#pragma once

namespace spacetime::limits {

// Constraint residuals (instances times components) of a whole problem; the optimizer keeps some hundred
// bytes of each.  Also the largest count a scope may ask for.
inline constexpr int instances = 4'000'000;

// Operations run in one evaluation of a whole problem, or by one `sample`: those of each program times its instances,
// quadrature points or times.  Arms of twelve links on 4,096 spans run less than 1e9; this many take the better
// part of a minute, within which nobody can cancel.
inline constexpr double evaluated_operations = 1e11;

}  // namespace spacetime::limits
