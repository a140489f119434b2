// From a problem to a finite-dimensional one: unknown coefficients, and programs at fixed times.
//
//   minimise  f(x) = sum of the objective's terms + sum over soft rows of w/2 r(x)^2
//   such that c(x) = 0, or c(x) <= 0, in every hard row, and lower <= x <= upper
//
// The unknowns x are the coefficients of all degrees of freedom, one after another, then one number z for each lifted
// functional F, whose row is z - F(x) = 0, then the parameters.  [Cohen92 §3.4; design, "Numerics"]
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/bspline.h"
#include "common/constants.h"
#include "common/evaluate.h"
#include "common/problem.h"
#include "optimizer/freedom.h"

namespace spacetime::optimizer {

// One scalar equation.
struct Row {
  enum class Kind { hard, soft, functional } kind = Kind::hard;
  int statement = 0;     // index of the constraint, or of the functional
  double time = 0;       // s; not a number where the relation has none
  double weight = 0;     // soft
  bool at_most = false;  // c <= 0 rather than c = 0
};

// A degree of freedom that a program uses: its inputs by derivative, -1 where absent.
struct Slot {
  int dof = 0;
  int table = 0;  // into Batch::tables
  std::array<int, max_derivative + 1> input{-1, -1, -1};
};

// Derivative entries that belong together: outputs of the evaluator (counted from its first Jacobian or Hessian entry),
// -1 where structurally zero.
struct JacobianBlock {  // of output `output` by the derivatives of `slot`
  int output = 0, slot = 0;
  std::array<int, max_derivative + 1> entry{-1, -1, -1};
};
struct HessianBlock {  // entry[d][e]: by derivative d of slot a and derivative e of slot b
  int a = 0, b = 0;
  std::array<std::array<int, max_derivative + 1>, max_derivative + 1> entry{};
};
// Functionals and parameters together: unknowns of the border, counted from the first functional.
struct BorderJacobian {  // of output `output` by an unknown of the border
  int output = 0, unknown = 0, entry = 0;
};
struct BorderHessian {  // by an unknown of the border and another (`slot` -1), or a slot's derivative
  int unknown = 0, other = -1, slot = -1, derivative = 0, entry = 0;
};

// Where an output of a summed batch goes.
struct Target {
  enum class Kind { nowhere, objective, functional } kind = Kind::nowhere;
  int index = 0;      // term of the objective, or functional
  double factor = 1;  // the term's weight
};

// One program at many times, with what becomes of its outputs:
//   summed: weights[s] * value of output o goes to targets[o];
//   rows:   the value is the residual of row first_row + s * outputs + o.
struct Batch {
  const Program* program = nullptr;
  const Evaluator* evaluator = nullptr;
  std::vector<double> times;    // s, one a sample; not a number where there is none
  std::vector<double> weights;  // s; summed only
  std::vector<Target> targets;  // summed only, one an output
  int first_row = -1;           // rows only

  std::vector<std::vector<BasisValues>> tables;  // one for each distinct basis: one a sample
  std::vector<Slot> slots;
  std::vector<int> chunks;  // samples [chunks[k], chunks[k+1]) touch the same coefficients
  std::vector<JacobianBlock> jacobian;
  std::vector<HessianBlock> hessian;
  std::vector<BorderJacobian> border_jacobian;
  std::vector<BorderHessian> border_hessian;

  bool summed() const { return first_row < 0; }
  int outputs() const { return static_cast<int>(program->values.size()); }
  int samples() const { return static_cast<int>(times.size()); }
  const BasisValues& basis(const Slot& slot, int sample) const { return tables[slot.table][sample]; }
};

// Rows that count only while a condition on the motion holds (`when`).  The batch has one output a row of the others'.
struct Conditional {
  Batch condition;    // summed, without targets: only its values are wanted
  int output = 0;     // of the condition's program
  int first_row = 0;  // rows first_row + s * rows ... belong to sample s
  int rows = 0;       // a sample
};

struct Transcription {
  const Problem* problem = nullptr;
  Constants constants;
  std::vector<int> first;   // first unknown of each degree of freedom, of the functionals, of the parameters; the end
  std::vector<int> from;    // the coefficient of each degree of freedom that stands at `first`
  std::vector<char> fixed;  // one an unknown: data, not to be moved
  std::vector<double> lower, upper;  // of each unknown, infinite where there is none
  std::vector<double> most_change;   // of each unknown in one iteration (`damp`), infinite where there is none
  std::vector<int> functional_row;   // of each functional; -1 where it is data
  std::vector<double> elsewhere;     // what of each functional lies outside the window
  std::vector<Row> rows;
  std::vector<Batch> batches;
  std::vector<Conditional> conditionals;
  std::map<std::string, Evaluator> evaluators;  // of the programs in batches

  int dofs() const { return static_cast<int>(problem->dofs.size()); }
  int functionals() const { return static_cast<int>(problem->functionals.size()); }
  int first_functional() const { return first[dofs()]; }
  int first_parameter() const { return first[dofs() + 1]; }
  int unknowns() const { return first[dofs() + 2]; }
  int origin(int dof) const { return first[dof] - from[dof]; }  // where coefficient 0 would stand
};

// The problem must be valid (protocol reads only such) and outlive the transcription.  Throws InputError where a
// scope, weight or bound makes no sense with the constants' present values.
Transcription transcribe(const Problem& problem);
Transcription transcribe(const Problem& problem, const Freedom& freedom);

}  // namespace spacetime::optimizer
