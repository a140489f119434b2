// An independent judge of the throws of tests/reference/problems.md.  It shares nothing with the programs that it
// judges: the arm's dynamics are a closed form in absolute angles, derivatives come from second-order jets, splines
// from the textbook recursion, and all linear algebra is dense.
#pragma once

#include <Eigen/Core>

namespace judge {

struct Throw {
  int spans = 64;
  bool ball = false;  // P92: the ball is two more degrees of freedom, held, flying and landing at instances
  double price = 0;   // of the squared accelerations of the joints: 1e-3 in P94R
};
inline constexpr Throw p94{64, false, 0}, p94r{64, false, 1e-3}, p92{24, true, 0};

int unknowns(const Throw& problem);
int rows(const Throw& problem);

// At coefficients x, one degree of freedom after another.  Rows in the reference's order: q1(0), q1(T), q2(0), ...,
// the same for the rates, then throw_x, throw_y (or flight, basket, held x, held y).
struct Point {
  double objective = 0;
  Eigen::VectorXd gradient, constraints;
  Eigen::MatrixXd hessian;   // of the objective
  Eigen::MatrixXd jacobian;  // rows x unknowns
};
Point evaluate(const Throw& problem, const Eigen::VectorXd& x);

// sum_k multipliers[k] * (second derivative of row k)
Eigen::MatrixXd row_curvature(const Throw& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers);

struct Judgement {
  double objective = 0;
  double violation = 0;  // largest |c|
  double kkt = 0;        // largest |gradient - A^T lambda| over max(1, largest |gradient|), lambda by least squares
  int rank = 0;          // of A
  double curvature = 0;  // smallest eigenvalue of the Lagrangian's Hessian on the null space of A
};
Judgement judge(const Throw& problem, const Eigen::VectorXd& x);

// Inverse dynamics of a hanging chain of uniform rods in a vertical plane: the torques at relative angles q, with
// their rates and accelerations.
Eigen::VectorXd torques(const Eigen::VectorXd& lengths, const Eigen::VectorXd& masses, const Eigen::VectorXd& q,
                        const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations);

}  // namespace judge
