#include "optimizer/conjugate.h"

namespace spacetime::optimizer {

LeastSquares least_squares_cg(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                              const Eigen::VectorXd& b, double tolerance, int most) {
  LeastSquares result{Eigen::VectorXd::Zero(b.size()), 0};
  Eigen::VectorXd residual = b, slope = product(residual), direction = slope;
  double squares = slope.squaredNorm();
  const double enough = tolerance * tolerance * squares;
  while (squares > enough && result.iterations < most) {
    const Eigen::VectorXd image = product(direction);
    const double curvature = image.squaredNorm();
    if (!(curvature > 0)) break;
    const double length = squares / curvature;
    result.solution += length * direction;
    residual -= length * image;
    slope = product(residual);
    const double now = slope.squaredNorm();
    direction = slope + now / squares * direction;
    squares = now;
    ++result.iterations;
  }
  return result;
}

}  // namespace spacetime::optimizer
