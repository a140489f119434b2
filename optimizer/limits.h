// Inequalities by a primal-dual barrier inside the same KKT matrix.
//
//   c(x) + s = 0, s > 0 in every hard limit,   lower < x < upper
//   phi(x, s) = f(x) - mu (sum log s + sum log(x - lower) + sum log(upper - x))
//
// Slacks and multipliers z of the bounds are eliminated: a limit's row gets -s/lambda on the diagonal, a bounded
// unknown z/(x - lower) + z/(upper - x).  [Waechter and Biegler 2006, §2]
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "optimizer/layout.h"
#include "optimizer/transcription.h"

namespace spacetime::optimizer {

// The barrier's own unknowns, in KKT positions; zero where they do not apply.
struct Barrier {
  double mu = 0;
  Eigen::VectorXd slack, dual;             // at limits' rows
  Eigen::VectorXd lower_dual, upper_dual;  // at unknowns
};

// Of an earlier solve, for limits and bounds that are still there; 0 where nothing is known.
struct Carried {
  double mu = 0;
  double reached = std::numeric_limits<double>::infinity();  // the tolerance that solve's point was within
  std::vector<double> dual;                                  // one a row
  std::vector<double> lower_dual, upper_dual;                // one an unknown
};

class Limits {
 public:
  Limits(const Transcription& transcription, const Layout& layout);

  bool none() const { return rows_.empty() && lower_.empty() && upper_.empty(); }
  int count() const { return static_cast<int>(rows_.size() + lower_.size() + upper_.size()); }

  // Moves unknowns that touch or leave their bounds to the inside, by this part of what a first start is pushed.
  void push_inside(std::vector<double>& x, double part = 1) const;
  // Slacks and multipliers on the central path as near as x allows.  `c` is the residual in KKT positions.
  Barrier start(const std::vector<double>& x, const Eigen::VectorXd& c, double mu) const;

  // Takes over multipliers of an earlier solve, with slacks to match, as far as they make sense with the barrier's mu.
  void carry(const Carried& carried, const Layout& layout, const Eigen::VectorXd& c, const std::vector<double>& x,
             Barrier& barrier) const;

  // What the barrier adds: D and -E; the gradient of phi; bounds' multipliers' pull on the unknowns; the
  // residual with c + s + mu / lambda at limits, for the right side of the KKT system.
  Eigen::VectorXd diagonal(const std::vector<double>& x, const Barrier& barrier) const;
  Eigen::VectorXd gradient(const std::vector<double>& x, const Barrier& barrier) const;
  Eigen::VectorXd pull(const Barrier& barrier) const;
  Eigen::VectorXd right(const Eigen::VectorXd& c, const Barrier& barrier) const;
  double value(const std::vector<double>& x, const Barrier& barrier) const;  // the barrier's part of phi

  // The other unknowns' step that goes with d (of the unknowns) and the new multipliers.
  struct Change {
    Eigen::VectorXd slack, dual, lower_dual, upper_dual;
    double most_primal = 1, most_dual = 1;  // lengths that keep a fraction of the distance to every limit
  };
  Change change(const std::vector<double>& x, const Barrier& barrier, const Eigen::VectorXd& c,
                const Eigen::VectorXd& slope, const Eigen::VectorXd& solution) const;

  // The sum of |slack * multiplier - mu|.
  double gap(const std::vector<double>& x, const Barrier& barrier, double mu) const;

  // Slacks larger than a limit leaves free give nothing away: s = max(s, -c).
  void widen(Barrier& barrier, const Eigen::VectorXd& c) const;
  // Keeps multipliers within a factor of mu / slack, so that the barrier's curvature stays meaningful.
  void guard(const std::vector<double>& x, Barrier& barrier) const;

  const std::vector<int>& rows() const { return rows_; }

 private:
  struct Bound {
    int unknown, position;
    double value, margin;
  };
  std::vector<int> rows_;  // positions of hard limits
  std::vector<Bound> lower_, upper_;
  int size_ = 0;
};

}  // namespace spacetime::optimizer
