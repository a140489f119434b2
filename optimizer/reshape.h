// Actions that change the motion itself, within what is free: pure functions on coefficients.
#pragma once

#include <vector>

#include "common/constants.h"
#include "common/problem.h"
#include "optimizer/freedom.h"

namespace spacetime::optimizer {

// Coefficients of each degree of freedom.
using Curves = std::vector<std::vector<double>>;

// Adds a smooth random curve to each named degree of freedom: a cubic B-spline over the free time with eight spans and
// control points uniform in [-amplitude, amplitude], so that no value moves further than that.  The same seed
// gives the same curve.
void shake(const Problem& problem, const Constants& constants, const Freedom& freedom, const Shake& action, int seed,
           Curves& curves);

// Smooths each named degree of freedom: of all curves with the same ends (values and velocities, where they are free)
// the one that minimises  integral (q - q0)^2 + (s / 2 pi)^4 q''^2.  Wiggles with a period of s seconds are halved,
// faster ones vanish; integral q''^2 falls, unless it is the least there is.  Throws InputError where s is not
// positive.
void smooth(const Problem& problem, const Constants& constants, const Freedom& freedom, const Smooth& action,
            Curves& curves);

// Changes each keyed degree of freedom to have its value at the time, exactly, by the change d that minimises
// integral d^2 + r^4 d''^2: a bump about 5 r long, a third of the animation, with the overshoot of 4 % that smoothness
// asks.  Throws InputError where the time lies outside the animation's, or nothing is free there.
void pull(const Problem& problem, const Constants& constants, const Freedom& freedom, const PullKeys& action,
          Curves& curves);

// Sets one coefficient.  Throws InputError where there is none of that number, or it is not free.
void control(const Problem& problem, const Constants& constants, const Freedom& freedom, const Control& action,
             Curves& curves);

}  // namespace spacetime::optimizer
