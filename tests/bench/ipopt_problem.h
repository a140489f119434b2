// A transcribed problem as Ipopt wants it: the same unknowns, rows and exact derivatives that our own methods see.
#pragma once

#include <IpTNLP.hpp>
#include <span>
#include <vector>

#include "optimizer/evaluation.h"

namespace spacetime {

class IpoptProblem : public Ipopt::TNLP {
 public:
  // The first two must outlive it.  Throws InputError for soft constraints and conditions, which it does not know.
  IpoptProblem(const optimizer::Transcription& transcription, const optimizer::Layout& layout, std::vector<double> x);

  std::vector<double> x;            // the start, then where the run has ended
  std::vector<double> multipliers;  // one a row, of the end
  int iterations = 0;
  double seconds_evaluating = 0;

 private:
  using Index = Ipopt::Index;
  using Number = Ipopt::Number;
  struct Entry {
    int row, column;  // of the Jacobian or of the Hessian's lower triangle
    int high, low;    // positions in the KKT matrix
  };

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) override;
  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* row_lower, Number* row_upper) override;
  bool get_starting_point(Index n, bool init_x, Number* start, bool init_z, Number* z_lower, Number* z_upper, Index m,
                          bool init_lambda, Number* lambda) override;
  bool eval_f(Index n, const Number* at, bool is_new, Number& value) override;
  bool eval_grad_f(Index n, const Number* at, bool is_new, Number* gradient) override;
  bool eval_g(Index n, const Number* at, bool is_new, Index m, Number* residual) override;
  bool eval_jac_g(Index n, const Number* at, bool is_new, Index m, Index entries, Index* rows, Index* columns,
                  Number* values) override;
  bool eval_h(Index n, const Number* at, bool is_new, Number factor, Index m, const Number* lambda, bool is_new_lambda,
              Index entries, Index* rows, Index* columns, Number* values) override;
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number value, Number primal, Number dual,
                             Number mu, Number step, Number regularisation, Number dual_length, Number primal_length,
                             Index trials, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override;
  void finalize_solution(Ipopt::SolverReturn status, Index n, const Number* at, const Number* z_lower,
                         const Number* z_upper, Index m, const Number* g, const Number* lambda, Number value,
                         const Ipopt::IpoptData* data, Ipopt::IpoptCalculatedQuantities* quantities) override;

  void find_pattern();
  void move(const Number* at, bool is_new);
  void need_values();
  void need_first_derivatives();
  void add_hessian(const Number* lambda, double of_lambda, double scale, Number* values);

  const optimizer::Transcription& t_;
  const optimizer::Layout& layout_;
  optimizer::Workspace workspace_;
  std::vector<Entry> jacobian_, hessian_;

  std::vector<double> at_;  // the present point, and what is known there
  optimizer::Values values_;
  optimizer::Linearisation linear_;
  bool has_values_ = false, has_derivatives_ = false;
};

}  // namespace spacetime
