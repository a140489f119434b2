// A line search for the strong Wolfe conditions [Nocedal and Wright 2006, algorithms 3.5 and 3.6]:
//
//   phi(a) <= phi(0) + c1 a phi'(0),   |phi'(a)| <= c2 |phi'(0)|,   c1 = 1e-4, c2 = 0.9
#pragma once

#include <functional>
#include <optional>

namespace spacetime::optimizer {

struct LinePoint {
  double length = 0, value = 0, slope = 0;  // value and slope not finite: not a point to go to
};

// A point where both hold, the first to within `noise`, what rounding makes of phi; not beyond `longest`.  There, and
// where an interval has shrunk to nothing, the first is enough.  Nothing where not even that is found, or where the
// slope at the start is not downhill.  The point returned is the one that phi was asked for last, `first` is tried
// first.
std::optional<LinePoint> wolfe_search(const std::function<LinePoint(double)>& phi, const LinePoint& start, double first,
                                      double longest, double noise);

}  // namespace spacetime::optimizer
