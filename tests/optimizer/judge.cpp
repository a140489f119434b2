#include "tests/optimizer/judge.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace judge {
namespace {

constexpr double duration = 2, release = 1, land = 1.6, basket_x = 2.5, basket_y = 0.5, g = 9.81;
constexpr double ball_price = 1e-3;
constexpr int joints = 3, inputs = 3 * joints;  // of a jet: q, then q', then q''

// A number with its gradient and Hessian by the arm's nine inputs.
struct Jet {
  double v = 0;
  Eigen::Matrix<double, inputs, 1> d = Eigen::Matrix<double, inputs, 1>::Zero();
  Eigen::Matrix<double, inputs, inputs> dd = Eigen::Matrix<double, inputs, inputs>::Zero();

  Jet() = default;
  Jet(double value) : v(value) {}
};
Jet operator+(const Jet& a, const Jet& b) {
  Jet c;
  c.v = a.v + b.v;
  c.d = a.d + b.d;
  c.dd = a.dd + b.dd;
  return c;
}
Jet operator*(const Jet& a, const Jet& b) {
  Jet c;
  c.v = a.v * b.v;
  c.d = a.v * b.d + b.v * a.d;
  c.dd = a.v * b.dd + b.v * a.dd + a.d * b.d.transpose() + b.d * a.d.transpose();
  return c;
}
Jet operator-(const Jet& a, const Jet& b) { return a + Jet(-1) * b; }

// f(a) for a function with value f0, derivative f1 and second derivative f2 at a.
Jet chain(const Jet& a, double f0, double f1, double f2) {
  Jet c;
  c.v = f0;
  c.d = f1 * a.d;
  c.dd = f1 * a.dd + f2 * a.d * a.d.transpose();
  return c;
}
Jet sin(const Jet& a) { return chain(a, std::sin(a.v), std::cos(a.v), -std::sin(a.v)); }
Jet cos(const Jet& a) { return chain(a, std::cos(a.v), -std::sin(a.v), -std::cos(a.v)); }

const std::vector<double> arm_lengths{0.5, 0.4, 0.2}, arm_masses{2.0, 1.5, 0.5};

// A chain of rods in absolute angles a_k = -pi/2 + q_1 + ... + q_k:
//   T = sum_ij B_ij cos(a_i - a_j) a_i' a_j' / 2,   V = g sum_i G_i sin a_i,
//   B_ij = l_i l_j (m_j / 2 + sum of the masses beyond j) for i < j,   B_ii = l_i^2 (m_i / 3 + masses beyond i),
//   G_i = l_i (m_i / 2 + masses beyond i).
// Lagrange: Q_i = sum_j B_ij (cos(a_i - a_j) a_j'' + sin(a_i - a_j) a_j'^2) + g G_i cos a_i; joint k turns all angles
// from k on, so tau_k = Q_k + Q_{k+1} + ...
template <typename S>
std::vector<S> inverse_dynamics(const std::vector<double>& l, const std::vector<double>& m, const std::vector<S>& a,
                                const std::vector<S>& rate, const std::vector<S>& acceleration) {
  using std::cos, std::sin;
  const std::size_t n = l.size();
  const auto beyond = [&](std::size_t k) {
    double sum = 0;
    for (std::size_t i = k + 1; i < n; ++i) sum += m[i];
    return sum;
  };
  std::vector<S> tau(n, S(0));
  for (std::size_t i = 0; i < n; ++i) {
    S q = S(g * l[i] * (m[i] / 2 + beyond(i))) * cos(a[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t far = std::max(i, j);
      const double b = l[i] * l[j] * ((i == j ? m[i] / 3 : m[far] / 2) + beyond(far));
      const S angle = a[i] - a[j];
      q = q + S(b) * (cos(angle) * acceleration[j] + sin(angle) * rate[j] * rate[j]);
    }
    for (std::size_t k = 0; k <= i; ++k) tau[k] = tau[k] + q;
  }
  return tau;
}

// Sums from the base outwards: relative angles (or rates) to absolute ones.
template <typename S>
std::vector<S> absolute(std::vector<S> relative, double base) {
  S sum(base);
  for (S& value : relative) value = sum = sum + value;
  return relative;
}

// Clamped uniform cubic B-splines by the recursion of Cox and de Boor, one function at a time.
class Splines {
 public:
  explicit Splines(int spans) : spans_(spans) {
    for (int k = -3; k <= spans + 3; ++k) knots_.push_back(duration * std::clamp(k, 0, spans) / spans);
  }
  int size() const { return spans_ + 3; }
  double value(int i, int derivative, double t) const { return basis(i, 3, derivative, t); }

 private:
  double basis(int i, int degree, int derivative, double t) const {
    const double* u = &knots_[static_cast<std::size_t>(i)];
    if (degree == 0) {
      const bool last = u[1] == duration && u[0] < u[1] && t == duration;
      return (t >= u[0] && t < u[1]) || last ? 1 : 0;
    }
    const double left = u[degree] - u[0], right = u[degree + 1] - u[1];
    double sum = 0;
    if (derivative > 0) {
      if (left > 0) sum += degree * basis(i, degree - 1, derivative - 1, t) / left;
      if (right > 0) sum -= degree * basis(i + 1, degree - 1, derivative - 1, t) / right;
    } else {
      if (left > 0) sum += (t - u[0]) / left * basis(i, degree - 1, 0, t);
      if (right > 0) sum += (u[degree + 1] - t) / right * basis(i + 1, degree - 1, 0, t);
    }
    return sum;
  }

  int spans_;
  std::vector<double> knots_;
};

struct Node {
  double x, w;
};
// Gauss-Legendre on [-1, 1], four nodes, by Newton's iteration on P4 = (35 x^4 - 30 x^2 + 3) / 8;
// w = 2 / ((1 - x^2) P4'(x)^2).
std::array<Node, 4> gauss() {
  std::array<Node, 4> nodes{};
  for (std::size_t k = 0; k < 4; ++k) {
    double x = std::cos(std::numbers::pi * (4.0 - static_cast<double>(k) - 0.25) / 4.5);
    double slope = 1;
    for (int step = 0; step < 20; ++step) {
      slope = (140 * x * x * x - 60 * x) / 8;
      x -= (35 * x * x * x * x - 30 * x * x + 3) / 8 / slope;
    }
    slope = (140 * x * x * x - 60 * x) / 8;
    nodes[k] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

// The problem's functions at one time, by coefficients.
class Model {
 public:
  Model(const Throw& problem, const Eigen::VectorXd& x) : problem_(problem), x_(x), splines_(problem.spans) {}

  int unknowns() const { return (joints + (problem_.ball ? 2 : 0)) * splines_.size(); }

  // The derivative of a degree of freedom's d-th time derivative by all coefficients.
  Eigen::VectorXd weights(int dof, int d, double t) const {
    Eigen::VectorXd w = Eigen::VectorXd::Zero(unknowns());
    for (int k = 0; k < splines_.size(); ++k) w[dof * splines_.size() + k] = splines_.value(k, d, t);
    return w;
  }
  double value(int dof, int d, double t) const { return weights(dof, d, t).dot(x_); }

  // d inputs / d x
  Eigen::MatrixXd spread(double t) const {
    Eigen::MatrixXd p(inputs, unknowns());
    for (int i = 0; i < inputs; ++i) p.row(i) = weights(i % joints, i / joints, t).transpose();
    return p;
  }

  std::vector<Jet> state(int d, double t) const {
    std::vector<Jet> s(joints);
    for (int k = 0; k < joints; ++k) {
      s[static_cast<std::size_t>(k)] = Jet(value(k, d, t));
      s[static_cast<std::size_t>(k)].d[joints * d + k] = 1;
    }
    return s;
  }

  Jet integrand(double t) const {
    const auto angles = absolute(state(0, t), -std::numbers::pi / 2), rates = absolute(state(1, t), 0);
    const auto own = state(2, t);
    Jet sum;
    for (const Jet& tau : inverse_dynamics(arm_lengths, arm_masses, angles, rates, absolute(own, 0))) {
      sum = sum + tau * tau;
    }
    for (const Jet& q : own) sum = sum + Jet(problem_.price) * q * q;
    return sum;
  }

  struct Hand {
    Jet x, y, rate_x, rate_y;
  };
  Hand hand(double t) const {
    const auto a = absolute(state(0, t), -std::numbers::pi / 2), rate = absolute(state(1, t), 0);
    Hand h;
    for (std::size_t k = 0; k < joints; ++k) {
      const Jet l(arm_lengths[k]);
      h.x = h.x + l * cos(a[k]);
      h.y = h.y + l * sin(a[k]);
      h.rate_x = h.rate_x - l * sin(a[k]) * rate[k];
      h.rate_y = h.rate_y + l * cos(a[k]) * rate[k];
    }
    return h;
  }

 private:
  const Throw& problem_;
  const Eigen::VectorXd& x_;
  Splines splines_;
};

// Calls visit(t, jet, linear part's value, linear part's weights) for every row in the reference's order.
template <typename Visit>
void for_each_row(const Throw& problem, const Model& model, Visit visit) {
  const auto linear = [&](int dof, int d, double t, double right) {
    visit(t, Jet(0), model.value(dof, d, t) - right, model.weights(dof, d, t));
  };
  for (const int d : {0, 1}) {
    for (int dof = 0; dof < joints; ++dof) {
      linear(dof, d, 0, 0);
      linear(dof, d, duration, 0);
    }
  }
  const int bx = joints, by = joints + 1;
  if (!problem.ball) {
    const auto hand = model.hand(release);
    const double flight = land - release;
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(model.unknowns());
    visit(release, hand.x + Jet(flight) * hand.rate_x - Jet(basket_x), 0.0, nothing);
    visit(release, hand.y + Jet(flight) * hand.rate_y - Jet(g / 2 * flight * flight) - Jet(basket_y), 0.0, nothing);
    return;
  }
  for (int k = 0; k < 13; ++k) {
    const double t = release + (land - release) * k / 12;
    linear(bx, 2, t, 0);
    linear(by, 2, t, -g);
  }
  linear(bx, 0, land, basket_x);
  linear(by, 0, land, basket_y);
  for (const int dof : {bx, by}) {
    for (int k = 0; k < 12; ++k) {
      const double t = (release + 0.1) * k / 11;
      const auto hand = model.hand(t);
      visit(t, dof == bx ? hand.x : hand.y, -model.value(dof, 0, t), -model.weights(dof, 0, t));
    }
  }
}

}  // namespace

int unknowns(const Throw& problem) { return (joints + (problem.ball ? 2 : 0)) * (problem.spans + 3); }
int rows(const Throw& problem) { return problem.ball ? 64 : 14; }

Point evaluate(const Throw& problem, const Eigen::VectorXd& x) {
  const Model model(problem, x);
  const int n = unknowns(problem);
  Point point;
  point.gradient = Eigen::VectorXd::Zero(n);
  point.hessian = Eigen::MatrixXd::Zero(n, n);
  const double half = duration / problem.spans / 2;
  for (int span = 0; span < problem.spans; ++span) {
    for (const Node& node : gauss()) {
      const double t = (2 * span + 1 + node.x) * half, w = node.w * half;
      const Jet f = model.integrand(t);
      const Eigen::MatrixXd p = model.spread(t);
      point.objective += w * f.v;
      point.gradient += w * p.transpose() * f.d;
      point.hessian += w * p.transpose() * (f.dd * p);
      for (int dof = joints; problem.ball && dof < joints + 2; ++dof) {
        const Eigen::VectorXd b = model.weights(dof, 2, t);
        const double acceleration = b.dot(x);
        point.objective += w * ball_price * acceleration * acceleration;
        point.gradient += 2 * w * ball_price * acceleration * b;
        point.hessian += 2 * w * ball_price * b * b.transpose();
      }
    }
  }
  point.constraints.resize(rows(problem));
  point.jacobian.resize(rows(problem), n);
  int row = 0;
  for_each_row(problem, model, [&](double t, const Jet& jet, double linear, const Eigen::VectorXd& weights) {
    point.constraints[row] = jet.v + linear;
    point.jacobian.row(row++) = (model.spread(t).transpose() * jet.d + weights).transpose();
  });
  return point;
}

Eigen::MatrixXd row_curvature(const Throw& problem, const Eigen::VectorXd& x, const Eigen::VectorXd& multipliers) {
  const Model model(problem, x);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(unknowns(problem), unknowns(problem));
  int row = 0;
  for_each_row(problem, model, [&](double t, const Jet& jet, double, const Eigen::VectorXd&) {
    const Eigen::MatrixXd p = model.spread(t);
    sum += multipliers[row++] * p.transpose() * (jet.dd * p);
  });
  return sum;
}

Judgement judge(const Throw& problem, const Eigen::VectorXd& x) {
  const Point point = evaluate(problem, x);
  Judgement result;
  result.objective = point.objective;
  result.violation = point.constraints.cwiseAbs().maxCoeff();

  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> orthogonal(point.jacobian.transpose());
  const Eigen::VectorXd lambda = orthogonal.solve(point.gradient);
  result.kkt = (point.gradient - point.jacobian.transpose() * lambda).cwiseAbs().maxCoeff() /
               std::max(1.0, point.gradient.cwiseAbs().maxCoeff());

  Eigen::BDCSVD<Eigen::MatrixXd> svd(point.jacobian, Eigen::ComputeFullV);
  svd.setThreshold(1e-10);
  result.rank = static_cast<int>(svd.rank());
  const Eigen::MatrixXd free = svd.matrixV().rightCols(unknowns(problem) - result.rank);
  const Eigen::MatrixXd lagrangian = point.hessian - row_curvature(problem, x, lambda);
  const Eigen::MatrixXd reduced = free.transpose() * lagrangian * free;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced, Eigen::EigenvaluesOnly);
  result.curvature = eigen.eigenvalues()[0];
  return result;
}

Eigen::VectorXd torques(const Eigen::VectorXd& lengths, const Eigen::VectorXd& masses, const Eigen::VectorXd& q,
                        const Eigen::VectorXd& rates, const Eigen::VectorXd& accelerations) {
  const auto listed = [](const Eigen::VectorXd& v) { return std::vector<double>(v.begin(), v.end()); };
  const auto tau = inverse_dynamics<double>(listed(lengths), listed(masses), absolute(listed(q), -std::numbers::pi / 2),
                                            absolute(listed(rates), 0), absolute(listed(accelerations), 0));
  return Eigen::Map<const Eigen::VectorXd>(tau.data(), static_cast<Eigen::Index>(tau.size()));
}

}  // namespace judge
