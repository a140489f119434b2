// Conjugate gradients on the normal equations, for a symmetric matrix of which only products are known.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace spacetime::optimizer {

struct LeastSquares {
  Eigen::VectorXd solution;
  int iterations = 0;
};

// Minimises |K v - b|^2, K being symmetric and perhaps singular or indefinite, from v = 0: the least-squares solution
// of least size.  Ends where |K (b - K v)| is `tolerance` of |K b|, or after `most` iterations.  The condition number
// is that of K squared.  [Cohen92 §3.6.3; Hestenes and Stiefel 1952, §10]
LeastSquares least_squares_cg(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                              const Eigen::VectorXd& b, double tolerance, int most);

}  // namespace spacetime::optimizer
