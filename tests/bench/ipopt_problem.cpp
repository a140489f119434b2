#include "tests/bench/ipopt_problem.h"

#include <algorithm>
#include <random>

#include "common/diagnostic.h"
#include "optimizer/newton.h"

namespace spacetime {

using namespace optimizer;

IpoptProblem::IpoptProblem(const Transcription& transcription, const Layout& layout, std::vector<double> start)
    : x(std::move(start)), t_(transcription), layout_(layout), linear_(start_linearisation(layout)) {
  if (!t_.conditionals.empty()) throw InputError("conditions have no place in a problem for Ipopt");
  for (const Row& row : t_.rows) {
    if (row.kind == Row::Kind::soft) throw InputError("soft constraints have no place in a problem for Ipopt");
  }
  find_pattern();
}

// What is not zero at a random point with random multipliers.
void IpoptProblem::find_pattern() {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> number(0.5, 1.5);
  at_.resize(t_.unknowns());
  std::ranges::generate(at_, [&] { return number(generator); });
  std::vector<double> lambda(t_.rows.size());
  std::ranges::generate(lambda, [&] { return number(generator); });
  values_ = evaluate(t_, at_, workspace_);
  linearise(t_, layout_, at_, workspace_, linear_);
  add_row_curvature(t_, layout_, at_, values_, lambda, workspace_, linear_);
  for (int u = 0; u < t_.unknowns(); ++u) {
    const auto listed = [&](int row, int other, const BorderedMatrix& matrix, std::vector<Entry>& entries) {
      const auto [low, high] = std::minmax(layout_.of_unknown[u], other);
      if (matrix.at(high, low) != 0) entries.push_back({row, u, high, low});
    };
    for (std::size_t r = 0; r < t_.rows.size(); ++r) {
      listed(static_cast<int>(r), layout_.of_row[r], linear_.jacobian, jacobian_);
    }
    for (int v = u; v < t_.unknowns(); ++v) listed(v, layout_.of_unknown[v], linear_.hessian, hessian_);
  }
}

void IpoptProblem::move(const Number* at, bool is_new) {
  if (!is_new) return;
  at_.assign(at, at + t_.unknowns());
  has_values_ = has_derivatives_ = false;
}

void IpoptProblem::need_values() {
  if (has_values_) return;
  const Stopwatch watch(seconds_evaluating);
  values_ = evaluate(t_, at_, workspace_);
  has_values_ = true;
}

void IpoptProblem::need_first_derivatives() {
  if (has_derivatives_) return;
  const Stopwatch watch(seconds_evaluating);
  linearise(t_, layout_, at_, workspace_, linear_);
  has_derivatives_ = true;
}

bool IpoptProblem::get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) {
  n = t_.unknowns();
  m = static_cast<Index>(t_.rows.size());
  jacobian = static_cast<Index>(jacobian_.size());
  hessian = static_cast<Index>(hessian_.size());
  style = C_STYLE;
  return true;
}

bool IpoptProblem::get_bounds_info(Index, Number* lower, Number* upper, Index m, Number* row_lower, Number* row_upper) {
  constexpr double infinite = 2e19;  // Ipopt's own
  for (int u = 0; u < t_.unknowns(); ++u) {
    lower[u] = std::max(t_.lower[u], -infinite);
    upper[u] = std::min(t_.upper[u], infinite);
  }
  for (Index r = 0; r < m; ++r) {
    row_lower[r] = t_.rows[r].at_most ? -infinite : 0;
    row_upper[r] = 0;
  }
  return true;
}

bool IpoptProblem::get_starting_point(Index, bool, Number* start, bool, Number*, Number*, Index, bool, Number*) {
  std::ranges::copy(x, start);
  return true;
}

bool IpoptProblem::eval_f(Index, const Number* at, bool is_new, Number& value) {
  move(at, is_new);
  need_values();
  value = values_.objective;
  return values_.finite;
}

bool IpoptProblem::eval_grad_f(Index n, const Number* at, bool is_new, Number* gradient) {
  move(at, is_new);
  need_first_derivatives();
  for (Index u = 0; u < n; ++u) gradient[u] = linear_.gradient[layout_.of_unknown[u]];
  return true;
}

bool IpoptProblem::eval_g(Index, const Number* at, bool is_new, Index, Number* residual) {
  move(at, is_new);
  need_values();
  std::ranges::copy(values_.residual, residual);
  return values_.finite;
}

bool IpoptProblem::eval_jac_g(Index, const Number* at, bool is_new, Index, Index entries, Index* rows, Index* columns,
                              Number* values) {
  if (values) {
    move(at, is_new);
    need_first_derivatives();
  }
  for (Index k = 0; k < entries; ++k) {
    const Entry& entry = jacobian_[k];
    if (values) {
      values[k] = linear_.jacobian.at(entry.high, entry.low);
    } else {
      rows[k] = entry.row;
      columns[k] = entry.column;
    }
  }
  return true;
}

// values += scale * Hessian of f + sum (of_lambda * lambda) c
void IpoptProblem::add_hessian(const Number* lambda, double of_lambda, double scale, Number* values) {
  std::vector<double> scaled(lambda, lambda + t_.rows.size());
  for (double& l : scaled) l *= of_lambda;
  need_values();
  has_derivatives_ = false;
  need_first_derivatives();
  has_derivatives_ = true;
  {
    const Stopwatch watch(seconds_evaluating);
    add_row_curvature(t_, layout_, at_, values_, scaled, workspace_, linear_);
  }
  for (std::size_t k = 0; k < hessian_.size(); ++k) {
    values[k] += scale * linear_.hessian.at(hessian_[k].high, hessian_[k].low);
  }
}

bool IpoptProblem::eval_h(Index, const Number* at, bool is_new, Number factor, Index, const Number* lambda, bool,
                          Index entries, Index* rows, Index* columns, Number* values) {
  if (!values) {
    for (Index k = 0; k < entries; ++k) {
      rows[k] = hessian_[k].row;
      columns[k] = hessian_[k].column;
    }
    return true;
  }
  move(at, is_new);
  std::fill(values, values + entries, 0.0);
  if (factor != 0) {
    add_hessian(lambda, 1 / factor, factor, values);
  } else {
    add_hessian(lambda, 1, 1, values);
    add_hessian(lambda, 0, -1, values);
  }
  return true;
}

bool IpoptProblem::intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number, Number,
                                         Number, Number, Number, Index, const Ipopt::IpoptData*,
                                         Ipopt::IpoptCalculatedQuantities*) {
  iterations = iteration;
  return true;
}

void IpoptProblem::finalize_solution(Ipopt::SolverReturn, Index n, const Number* at, const Number*, const Number*,
                                     Index m, const Number*, const Number* lambda, Number, const Ipopt::IpoptData*,
                                     Ipopt::IpoptCalculatedQuantities*) {
  x.assign(at, at + n);
  multipliers.assign(lambda, lambda + m);
}

}  // namespace spacetime
