#include "optimizer/transcription.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/diagnostic.h"
#include "optimizer/quadrature.h"

namespace spacetime::optimizer {
namespace {

constexpr double no_time = std::numeric_limits<double>::quiet_NaN();

int index_of(const Problem& problem, const std::string& dof) {
  const auto found = std::ranges::find(problem.dofs, dof, &Dof::name);
  return static_cast<int>(found - problem.dofs.begin());
}

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

// What of each input the program's derivative entries mean: a slot's derivative, or a functional.
struct Meaning {
  int slot = -1, derivative = 0, border = -1;
};

void add_slots(const Problem& problem, Batch& batch, std::vector<Meaning>& meanings) {
  const Program& program = *batch.program;
  std::map<int, int> slot_of_dof;
  std::map<std::vector<double>, int> table_of_knots;
  meanings.resize(program.inputs.size());
  for (std::size_t i = 0; i < program.inputs.size(); ++i) {
    const Input& input = program.inputs[i];
    if (input.kind == InputKind::functional) meanings[i].border = input.index;
    if (input.kind == InputKind::parameter) {
      const auto found = std::ranges::find(problem.parameters, input.name, &Parameter::name);
      meanings[i].border = static_cast<int>(problem.functionals.size() + (found - problem.parameters.begin()));
    }
    if (input.kind != InputKind::dof) continue;
    const int dof = index_of(problem, input.name);
    const auto [found, added] = slot_of_dof.try_emplace(dof, static_cast<int>(batch.slots.size()));
    if (added) {
      const Basis& basis = problem.dofs[dof].basis;
      const auto [table, fresh] = table_of_knots.try_emplace(basis.knots, static_cast<int>(batch.tables.size()));
      if (fresh) {
        auto& values = batch.tables.emplace_back();
        values.reserve(batch.times.size());
        for (const double t : batch.times) values.push_back(basis_values(basis, t));
      }
      batch.slots.push_back({dof, table->second, {-1, -1, -1}});
    }
    batch.slots[found->second].input[input.derivative] = static_cast<int>(i);
    meanings[i] = {found->second, input.derivative, -1};
  }
}

void add_jacobian(Batch& batch, const std::vector<Meaning>& meanings) {
  std::map<std::pair<int, int>, int> block_of;
  const auto& entries = batch.program->jacobian;
  for (int k = 0; k < static_cast<int>(entries.size()); ++k) {
    const Meaning& by = meanings[entries[k].input];
    if (by.border >= 0) {
      batch.border_jacobian.push_back({entries[k].row, by.border, k});
      continue;
    }
    const auto [found, added] =
        block_of.try_emplace({entries[k].row, by.slot}, static_cast<int>(batch.jacobian.size()));
    if (added) batch.jacobian.push_back({entries[k].row, by.slot, {-1, -1, -1}});
    batch.jacobian[found->second].entry[by.derivative] = k;
  }
}

void add_hessian(Batch& batch, const std::vector<Meaning>& meanings) {
  std::map<std::pair<int, int>, int> block_of;
  const auto& entries = batch.program->hessian;
  for (int k = 0; k < static_cast<int>(entries.size()); ++k) {
    Meaning a = meanings[entries[k].row], b = meanings[entries[k].column];
    if (a.border < 0 && b.border >= 0) std::swap(a, b);
    if (a.border >= 0) {
      batch.border_hessian.push_back({a.border, b.border, b.slot, b.derivative, k});
      continue;
    }
    if (a.slot < b.slot) std::swap(a, b);
    const auto [found, added] = block_of.try_emplace({a.slot, b.slot}, static_cast<int>(batch.hessian.size()));
    if (added) {
      auto& block = batch.hessian.emplace_back(HessianBlock{a.slot, b.slot, {}});
      for (auto& row : block.entry) row.fill(-1);
    }
    auto& entry = batch.hessian[found->second].entry;
    entry[a.derivative][b.derivative] = k;
    if (a.slot == b.slot) entry[b.derivative][a.derivative] = k;
  }
}

void add_chunks(Batch& batch) {
  batch.chunks.push_back(0);
  for (int s = 1; s < batch.samples(); ++s) {
    const bool same =
        std::ranges::all_of(batch.tables, [&](const auto& table) { return table[s].first == table[s - 1].first; });
    if (!same) batch.chunks.push_back(s);
  }
  if (batch.samples() > 0) batch.chunks.push_back(batch.samples());
}

class Transcriber {
 public:
  explicit Transcriber(const Problem& problem) : problem_(problem) { out_.problem = &problem; }

  Transcription run() {
    out_.constants = evaluate_constants(problem_);
    int unknowns = 0;
    for (const Dof& dof : problem_.dofs) {
      out_.first.push_back(unknowns);
      unknowns += dof.basis.size();
    }
    out_.first.push_back(unknowns);
    out_.first.push_back(unknowns + static_cast<int>(problem_.functionals.size()));
    out_.first.push_back(out_.first.back() + static_cast<int>(problem_.parameters.size()));
    if (out_.unknowns() == 0) {
      throw InputError(
          "there is nothing to find: the problem has no degree of freedom and no parameter. Declare a `dof`");
    }
    add_bounds();
    for (const auto& [hash, program] : problem_.programs) out_.evaluators.emplace(hash, Evaluator(program));
    add_functionals();
    add_objective();
    for (int k = 0; k < static_cast<int>(problem_.constraints.size()); ++k) add_constraint(k);
    return std::move(out_);
  }

 private:
  double value(const Quantity& quantity, const std::string& what) const {
    return evaluate(problem_, out_.constants, quantity, what);
  }

  Batch start_batch(const std::string& hash) const {
    Batch batch;
    batch.program = &problem_.programs.at(hash);
    batch.evaluator = &out_.evaluators.at(hash);
    return batch;
  }

  void finish(Batch batch) {
    std::vector<Meaning> meanings;
    add_slots(problem_, batch, meanings);
    add_jacobian(batch, meanings);
    add_hessian(batch, meanings);
    add_chunks(batch);
    out_.batches.push_back(std::move(batch));
  }

  // The quadrature points of an integral, or the one time of `at`, or the one sample without a time.
  void sample(Batch& batch, bool integral, bool timed, const std::optional<Quantity>& from,
              const std::optional<Quantity>& to, const std::string& what) {
    if (!timed) {
      batch.times = {no_time};
      batch.weights = {1};
      return;
    }
    const double a = from ? value(*from, what + ": a time") : problem_.start;
    const double b = to ? value(*to, what + ": a time") : integral ? problem_.end : a;
    for (const double t : {a, b}) {
      if (t < problem_.start || t > problem_.end) {
        throw InputError(what + ": the time " + std::to_string(t) + " lies outside the animation's, " +
                         std::to_string(problem_.start) + " to " + std::to_string(problem_.end));
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

  void add_bounds() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    out_.lower.assign(out_.unknowns(), -infinite);
    out_.upper.assign(out_.unknowns(), infinite);
    const auto bound = [&](const std::string& name, const std::optional<Quantity>& lower,
                           const std::optional<Quantity>& upper, int from, int to) {
      const double low = lower ? value(*lower, "the lower bound of " + name) : -infinite;
      const double high = upper ? value(*upper, "the upper bound of " + name) : infinite;
      if (!(low < high)) {
        throw InputError("the bounds of " + name + " leave no room: " + std::to_string(low) + " to " +
                         std::to_string(high) + ". Use `eliminate`, or a constraint, for what does not move");
      }
      std::fill(out_.lower.begin() + from, out_.lower.begin() + to, low);
      std::fill(out_.upper.begin() + from, out_.upper.begin() + to, high);
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
    for (int k = 0; k < static_cast<int>(problem_.functionals.size()); ++k) {
      const Functional& functional = problem_.functionals[k];
      Batch batch = start_batch(functional.program);
      batch.targets.resize(batch.outputs());
      batch.targets[functional.output] = {Target::Kind::functional, k, 1};
      sample(batch, functional.kind == Functional::Kind::integral, true, functional.from, functional.to,
             "a functional");
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
    if (constraint.condition) keep_where(*constraint.condition, batch);
    batch.first_row = static_cast<int>(out_.rows.size());
    if (constraint.condition) add_condition(*constraint.condition, batch);
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

  void add_condition(const Condition& condition, const Batch& batch) {
    if (!depends_on_motion(problem_.programs.at(condition.program))) return;
    Conditional conditional{start_batch(condition.program), condition.output, batch.first_row, batch.outputs()};
    conditional.condition.times = batch.times;
    conditional.condition.weights.assign(batch.times.size(), 1.0);
    conditional.condition.targets.resize(conditional.condition.outputs());
    std::vector<Meaning> meanings;
    add_slots(problem_, conditional.condition, meanings);
    out_.conditionals.push_back(std::move(conditional));
  }

  const Problem& problem_;
  Transcription out_;
};

}  // namespace

Transcription transcribe(const Problem& problem) { return Transcriber(problem).run(); }

}  // namespace spacetime::optimizer
