#include "optimizer/penalty.h"

#include <algorithm>
#include <cmath>

namespace spacetime::optimizer {

Penalty::Penalty(const Transcription& transcription, const Layout& layout, double weight)
    : t_(transcription), layout_(layout), weight_(weight), linear_(start_linearisation(layout)) {
  for (const int u : layout_.free) {
    if (u < t_.first_functional() || u >= t_.first_parameter()) free_.push_back(u);
  }
}

std::vector<double> Penalty::moved(std::vector<double> x, const Eigen::VectorXd& change) const {
  for (int k = 0; k < size(); ++k) x[free_[k]] += change[k];
  return x;
}

double Penalty::most_length(const Eigen::VectorXd& change) const {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(layout_.size());
  for (int k = 0; k < size(); ++k) direction[layout_.of_unknown[free_[k]]] = change[k];
  return optimizer::most_length(t_, layout_, direction);
}

double Penalty::price(std::size_t row) const {
  switch (t_.rows[row].kind) {
    case Row::Kind::hard:
      return 2 * weight_;
    case Row::Kind::soft:
      return t_.rows[row].weight;
    case Row::Kind::functional:
      break;
  }
  return 0;
}

// The total derivative by the free unknowns: what stands at z moves to what z = F(x) depends on, the last first, since
// each functional may use those before it.
Eigen::VectorXd Penalty::reduced(Eigen::VectorXd gradient) const {
  for (int k = t_.functionals() - 1; k >= 0; --k) {
    if (t_.functional_row[k] < 0) continue;
    const double by_z = gradient[layout_.of_unknown[t_.first_functional() + k]];
    const int row = layout_.of_row[t_.functional_row[k]];
    gradient -= by_z * multiply(linear_.jacobian, Eigen::VectorXd::Unit(layout_.size(), row));
  }
  Eigen::VectorXd result(size());
  for (int k = 0; k < size(); ++k) result[k] = gradient[layout_.of_unknown[free_[k]]];
  return result;
}

PenaltyPoint Penalty::at(std::vector<double> x) {
  settle_functionals(t_, x, workspace_);
  return settled_at(std::move(x));
}

PenaltyPoint Penalty::settled_at(std::vector<double> x) {
  PenaltyPoint point;
  point.x = std::move(x);
  point.values = evaluate(t_, point.x, workspace_);
  if (!point.values.finite) return point;
  differentiate(t_, layout_, point.x, workspace_, linear_);

  // From residuals to  f = objective  and  F - f = penalty.
  Eigen::VectorXd soft = Eigen::VectorXd::Zero(layout_.size()), hard = soft;
  point.value = point.values.objective;
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    const double amount = excess(t_.rows[r], point.values.residual[r]);
    const bool is_hard = t_.rows[r].kind == Row::Kind::hard;
    (is_hard ? hard : soft)[layout_.of_row[r]] = price(r) * amount;
    if (!is_hard) continue;
    point.value += weight_ * amount * amount;
    point.violation = std::max(point.violation, std::abs(amount));
  }
  const Eigen::VectorXd of_objective = reduced(linear_.gradient + multiply(linear_.jacobian, soft));
  point.gradient = of_objective + reduced(multiply(linear_.jacobian, hard));
  for (int k = 0; k < size(); ++k) {
    const int u = free_[k];
    const double amount = point.x[u] - std::clamp(point.x[u], t_.lower[u], t_.upper[u]);
    point.value += weight_ * amount * amount;
    point.gradient[k] += 2 * weight_ * amount;
    point.violation = std::max(point.violation, std::abs(amount));
  }
  point.objective_size = of_objective.size() > 0 ? of_objective.cwiseAbs().maxCoeff() : 0;
  point.finite = std::isfinite(point.value) && point.gradient.allFinite();
  return point;
}

Eigen::VectorXd Penalty::curvature(const PenaltyPoint& point) {
  linearise(t_, layout_, point.x, workspace_, linear_);
  Eigen::VectorXd prices = Eigen::VectorXd::Zero(layout_.size());
  for (std::size_t r = 0; r < t_.rows.size(); ++r) {
    const bool asks = excess(t_.rows[r], point.values.residual[r]) != 0 || !t_.rows[r].at_most;
    if (asks) prices[layout_.of_row[r]] = price(r);
  }
  Eigen::VectorXd result(size());
  for (int k = 0; k < size(); ++k) {
    const int at = layout_.of_unknown[free_[k]];
    const Eigen::VectorXd column = multiply(linear_.jacobian, Eigen::VectorXd::Unit(layout_.size(), at));
    result[k] = std::abs(linear_.hessian.on_diagonal(at) + prices.dot(column.cwiseAbs2()));
  }
  return result;
}

}  // namespace spacetime::optimizer
