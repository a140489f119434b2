#include "optimizer/transcription.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/diagnostic.h"
#include "common/limits.h"
#include "optimizer/batch.h"
#include "optimizer/quadrature.h"

namespace spacetime::optimizer {
namespace {

constexpr double no_time = std::numeric_limits<double>::quiet_NaN();

std::vector<double> distinct_knots(const Problem& problem, const std::vector<int>& dofs) {
  std::vector<double> knots;
  for (const int dof : dofs) {
    const auto some = breakpoints(problem.dofs[dof].basis);
    knots.insert(knots.end(), some.begin(), some.end());
  }
  std::ranges::sort(knots);
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

std::vector<int> dofs_of(const Problem& problem, const Program& program) {
  std::vector<int> dofs;
  for (const Input& input : program.inputs) {
    if (input.kind == InputKind::dof) dofs.push_back(index_of(problem, input.name));
  }
  std::ranges::sort(dofs);
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

// The knots that matter to a program: of its degrees of freedom, or of all where it has none.
std::vector<double> knots_of(const Problem& problem, const Program& program) {
  std::vector<int> dofs = dofs_of(problem, program);
  if (dofs.empty()) {
    for (int k = 0; k < static_cast<int>(problem.dofs.size()); ++k) dofs.push_back(k);
  }
  return distinct_knots(problem, dofs);
}

// `over [a, b]` without a step takes the knots of the finest basis among the program's degrees of freedom.
std::vector<double> finest_knots(const Problem& problem, const Program& program) {
  std::vector<double> finest;
  for (const int dof : dofs_of(problem, program)) {
    auto knots = breakpoints(problem.dofs[dof].basis);
    if (knots.size() > finest.size()) finest = std::move(knots);
  }
  return finest.empty() ? knots_of(problem, program) : finest;
}

class Transcriber {
 public:
  Transcriber(const Problem& problem, const Freedom& freedom) : problem_(problem), freedom_(freedom) {
    out_.problem = &problem;
  }

  Transcription run() {
    out_.constants = evaluate_constants(problem_);
    add_functionals();
    add_objective();
    for (int k = 0; k < static_cast<int>(problem_.constraints.size()); ++k) add_constraint(k);
    number_unknowns();
    if (out_.unknowns() == 0) {
      throw InputError(
          "there is nothing to find: the problem has no degree of freedom and no parameter. Declare a `dof`");
    }
    add_bounds();
    return std::move(out_);
  }

 private:
  double value(const Quantity& quantity, const std::string& what) const {
    return evaluate(problem_, out_.constants, quantity, what);
  }

  Batch start_batch(const std::string& hash) {
    Batch batch;
    batch.program = &problem_.programs.at(hash);
    auto found = out_.evaluators.find(hash);
    if (found == out_.evaluators.end()) found = out_.evaluators.emplace(hash, Evaluator(*batch.program)).first;
    batch.evaluator = &found->second;
    return batch;
  }

  // Throws where a batch is more than a problem may have, before anything is made for each of its samples.
  void charge(const Batch& batch, const std::string& what) {
    evaluated_ += static_cast<double>(batch.program->op.size()) * static_cast<double>(batch.times.size());
    if (evaluated_ > limits::evaluated_operations) {
      throw InputError(
          fmt::format("{}: one evaluation of all up to here runs {:.3g} operations, more than {:.3g}. Use "
                      "larger steps, fewer knot spans or simpler expressions",
                      what, evaluated_, limits::evaluated_operations));
    }
  }

  void charge_rows(const Batch& batch, const std::string& what) {
    const double rows =
        static_cast<double>(out_.rows.size()) + batch.outputs() * static_cast<double>(batch.times.size());
    if (rows > limits::instances) {
      throw InputError(
          fmt::format("{}: the constraints up to here have {:.0f} residuals (instances times components), "
                      "more than {}. Use larger steps or fewer knot spans",
                      what, rows, limits::instances));
    }
    charge(batch, what);
  }

  void finish(Batch batch) {
    complete(problem_, batch);
    out_.batches.push_back(std::move(batch));
  }

  // The quadrature points of an integral, or the one time of `at`, or the one sample without a time; those that depend
  // on what is free.
  void sample(Batch& batch, bool integral, bool timed, const std::optional<Quantity>& from,
              const std::optional<Quantity>& to, const std::string& what) {
    if (!timed) {
      batch.times = {no_time};
      batch.weights = {1};
    } else {
      const double a = from ? value(*from, what + ": a time") : problem_.start;
      const double b = to ? value(*to, what + ": a time") : integral ? problem_.end : a;
      for (const double t : {a, b}) {
        if (t < problem_.start || t > problem_.end) {
          throw InputError(fmt::format("{}: the time {:.6g} lies outside the animation's, {:.6g} to {:.6g}", what, t,
                                       problem_.start, problem_.end));
        }
      }
      if (integral) {
        auto rule = gauss_legendre(knots_of(problem_, *batch.program), a, b);
        batch.times = std::move(rule.times);
        batch.weights = std::move(rule.weights);
      } else {
        batch.times = {a};
        batch.weights = {1};
      }
    }
    keep_free(batch);
  }

  // Drops the samples that no free unknown has a part in.
  void keep_free(Batch& batch) const {
    if (freedom_.whole) return;
    struct Use {
      int dof;
      std::array<bool, max_derivative + 1> derivative{};
    };
    std::vector<Use> uses;
    for (const Input& input : batch.program->inputs) {
      const int border = border_index_of(problem_, input);
      if (border >= 0 && border < out_.functionals() && out_.functional_row[border] >= 0) return;
      if (input.kind != InputKind::dof) continue;
      const int dof = index_of(problem_, input.name);
      auto found = std::ranges::find(uses, dof, &Use::dof);
      if (found == uses.end()) found = uses.insert(found, Use{dof});
      found->derivative[input.derivative] = true;
    }
    const auto depends = [&](double time) {
      return std::ranges::any_of(uses, [&](const Use& use) {
        const Basis& basis = problem_.dofs[use.dof].basis;
        const auto [from, to] = freedom_.dofs[use.dof];
        if (from >= to || !(basis.knots[from] <= time && time <= basis.knots[to + 3])) return false;
        const BasisValues values = basis_values(basis, time);
        for (int k = 0; k < 4; ++k) {
          if (!freedom_.has(use.dof, values.first + k)) continue;
          for (int d = 0; d <= max_derivative; ++d) {
            if (use.derivative[d] && values.b[d][k] != 0) return true;
          }
        }
        return false;
      });
    };
    std::size_t kept = 0;
    for (std::size_t s = 0; s < batch.times.size(); ++s) {
      if (!depends(batch.times[s])) continue;
      batch.times[kept] = batch.times[s];
      if (!batch.weights.empty()) batch.weights[kept] = batch.weights[s];
      ++kept;
    }
    batch.times.resize(kept);
    if (!batch.weights.empty()) batch.weights.resize(kept);
  }

  // Of each degree of freedom the coefficients that are free or that a sample touches.
  void number_unknowns() {
    std::vector<Freedom::Range> held = freedom_.dofs;
    const auto hold = [&](const Batch& batch) {
      for (const Slot& slot : batch.slots) {
        auto& [from, to] = held[slot.dof];
        for (const BasisValues& basis : batch.tables[slot.table]) {
          if (from == to) from = to = basis.first;
          from = std::min(from, basis.first);
          to = std::max(to, basis.first + 4);
        }
      }
    };
    for (const Batch& batch : out_.batches) hold(batch);
    for (const Conditional& conditional : out_.conditionals) hold(conditional.condition);
    int unknowns = 0;
    for (int dof = 0; dof < out_.dofs(); ++dof) {
      out_.first.push_back(unknowns);
      out_.from.push_back(held[dof].from);
      unknowns += held[dof].to - held[dof].from;
      for (int k = held[dof].from; k < held[dof].to; ++k) out_.fixed.push_back(!freedom_.has(dof, k));
    }
    out_.first.push_back(unknowns);
    out_.first.push_back(unknowns + static_cast<int>(problem_.functionals.size()));
    out_.first.push_back(out_.first.back() + static_cast<int>(problem_.parameters.size()));
    for (const int row : out_.functional_row) out_.fixed.push_back(row < 0);
    out_.fixed.resize(out_.unknowns(), !freedom_.whole);
  }

  void add_bounds() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    out_.lower.assign(out_.unknowns(), -infinite);
    out_.upper.assign(out_.unknowns(), infinite);
    out_.most_change.assign(out_.unknowns(), infinite);
    const auto bound = [&](const std::string& name, const std::optional<Quantity>& lower,
                           const std::optional<Quantity>& upper, int from, int to) {
      const double low = lower ? value(*lower, "the lower bound of " + name) : -infinite;
      const double high = upper ? value(*upper, "the upper bound of " + name) : infinite;
      if (!(low < high)) {
        throw InputError("the bounds of " + name + " leave no room: " + std::to_string(low) + " to " +
                         std::to_string(high) + ". Use `eliminate`, or a constraint, for what does not move");
      }
      for (int u = from; u < to; ++u) {
        if (out_.fixed[u]) continue;
        out_.lower[u] = low;
        out_.upper[u] = high;
      }
    };
    for (int k = 0; k < out_.dofs(); ++k) {
      const Dof& dof = problem_.dofs[k];
      bound(dof.name, dof.lower, dof.upper, out_.first[k], out_.first[k + 1]);
    }
    for (std::size_t k = 0; k < problem_.parameters.size(); ++k) {
      const Parameter& parameter = problem_.parameters[k];
      const int at = out_.first_parameter() + static_cast<int>(k);
      bound(parameter.name, parameter.lower, parameter.upper, at, at + 1);
    }
  }

  void add_functionals() {
    out_.elsewhere.assign(problem_.functionals.size(), 0.0);
    for (int k = 0; k < static_cast<int>(problem_.functionals.size()); ++k) {
      const Functional& functional = problem_.functionals[k];
      Batch batch = start_batch(functional.program);
      batch.targets.resize(batch.outputs());
      batch.targets[functional.output] = {Target::Kind::functional, k, 1};
      sample(batch, functional.kind == Functional::Kind::integral, true, functional.from, functional.to,
             "a functional");
      charge(batch, "a functional");
      const bool is_free = freedom_.whole || batch.samples() > 0;
      out_.functional_row.push_back(is_free ? static_cast<int>(out_.rows.size()) : -1);
      if (!is_free) continue;
      finish(std::move(batch));
      out_.rows.push_back({Row::Kind::functional, k, no_time, 0, false});
    }
  }

  // Pieces that run the same program over the same times share one batch.
  void add_objective() {
    using Site = std::tuple<std::string, Piece::Kind, std::vector<double>>;
    std::map<Site, int> batch_of;
    std::vector<Batch> pending;
    for (int k = 0; k < static_cast<int>(problem_.objective.size()); ++k) {
      const Term& term = problem_.objective[k];
      const double weight = value(term.weight, term.name + ": the weight");
      for (const Piece& piece : term.pieces) {
        Batch batch = start_batch(piece.program);
        sample(batch, piece.kind == Piece::Kind::integral, piece.kind != Piece::Kind::once, piece.from, piece.to,
               term.name);
        if (batch.samples() == 0) continue;
        charge(batch, term.name);
        Site site{piece.program, piece.kind, piece.kind == Piece::Kind::once ? std::vector<double>{} : batch.times};
        auto [found, added] = batch_of.try_emplace(std::move(site), static_cast<int>(pending.size()));
        // An output that two pieces share (one term twice) needs a batch of its own.
        if (!added && pending[found->second].targets[piece.output].kind != Target::Kind::nowhere) {
          found->second = static_cast<int>(pending.size());
          added = true;
        }
        if (added) {
          batch.targets.resize(batch.outputs());
          pending.push_back(std::move(batch));
        }
        pending[found->second].targets[piece.output] = {Target::Kind::objective, k, weight};
      }
    }
    for (Batch& batch : pending) finish(std::move(batch));
  }

  void add_constraint(int index) {
    const Constraint& constraint = problem_.constraints[index];
    Row row{Row::Kind::hard, index, no_time, 0, constraint.relation == Constraint::Relation::at_most};
    if (constraint.weight) {
      row.kind = Row::Kind::soft;
      row.weight = value(*constraint.weight, constraint.name + ": the weight");
      if (row.weight < 0) throw InputError(constraint.name + ": the weight of a soft constraint must not be negative");
      if (row.weight == 0) return;  // asks nothing
    }
    Batch batch = start_batch(constraint.program);
    batch.times = scope_times(problem_, out_.constants, constraint.scope, finest_knots(problem_, *batch.program),
                              constraint.name);
    keep_free(batch);
    if (batch.times.empty()) return;
    charge_rows(batch, constraint.name);
    if (constraint.condition) keep_where(*constraint.condition, batch);
    batch.first_row = static_cast<int>(out_.rows.size());
    if (constraint.condition) add_condition(index, *constraint.condition, batch);
    for (const double time : batch.times) {
      row.time = time;
      out_.rows.insert(out_.rows.end(), batch.outputs(), row);
    }
    finish(std::move(batch));
  }

  bool depends_on_motion(const Program& program) const {
    return std::ranges::any_of(program.inputs, [](const Input& input) { return is_unknown(input.kind); });
  }

  // A condition on time and constants alone is settled here: instances where it fails are dropped.
  void keep_where(const Condition& condition, Batch& batch) const {
    const Program& program = problem_.programs.at(condition.program);
    if (depends_on_motion(program)) return;
    std::erase_if(batch.times, [&](double time) {
      std::vector<double> inputs;
      for (const Input& input : program.inputs) {
        inputs.push_back(input.kind == InputKind::time ? time : out_.constants.at(input.name));
      }
      return evaluate_once(program, Depth::values, inputs)[condition.output] == 0;
    });
  }

  void add_condition(int index, const Condition& condition, const Batch& batch) {
    if (!depends_on_motion(problem_.programs.at(condition.program))) return;
    Conditional conditional{start_batch(condition.program), condition.output, batch.first_row, batch.outputs()};
    conditional.condition.times = batch.times;
    charge(conditional.condition, problem_.constraints[index].name);
    conditional.condition.weights.assign(batch.times.size(), 1.0);
    conditional.condition.targets.resize(conditional.condition.outputs());
    complete(problem_, conditional.condition);
    out_.conditionals.push_back(std::move(conditional));
  }

  const Problem& problem_;
  const Freedom& freedom_;
  double evaluated_ = 0;  // operations in one evaluation, so far
  Transcription out_;
};

}  // namespace

Transcription transcribe(const Problem& problem) { return transcribe(problem, all_of(problem)); }

Transcription transcribe(const Problem& problem, const Freedom& freedom) { return Transcriber(problem, freedom).run(); }

}  // namespace spacetime::optimizer
