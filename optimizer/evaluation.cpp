#include "optimizer/evaluation.h"

#include <algorithm>
#include <cmath>

#include "optimizer/clones.h"

namespace spacetime::optimizer {
namespace {

// The residual of an inequality that does not count at present: well satisfied.
constexpr double content = -1;

bool counts(std::span<const char> active, int row) { return active.empty() || active[row]; }

// A batch that has been run: one row of `stride` numbers an output.
struct Outputs {
  const double* data;
  std::size_t stride;
  double operator()(std::size_t output, int sample) const { return data[output * stride + sample]; }
  const double* row(std::size_t output) const { return data + output * stride; }
};

// What multiplies an output of a summed batch in the Lagrangian, for its program's multiplier inputs.
double multiplier_of(const Transcription& t, const Target& target, std::span<const double> multipliers,
                     double of_objective) {
  switch (target.kind) {
    case Target::Kind::nowhere:
      break;
    case Target::Kind::objective:
      return of_objective * target.factor;
    case Target::Kind::functional:
      return -multipliers[t.functional_row[target.index]];  // the row is z - F
  }
  return 0;
}

// `origin`: where in x coefficient 0 would stand; outside of it in a window.
SPACETIME_CLONES void gather(const BasisValues* basis, const double* x, int origin, int derivative, int samples,
                             double* result) {
  for (int s = 0; s < samples; ++s) {
    const double* b = basis[s].b[derivative].data();
    const double* c = x + (origin + basis[s].first);
    result[s] = (b[0] * c[0] + b[1] * c[1]) + (b[2] * c[2] + b[3] * c[3]);
  }
}

// Runs a batch at x.  Multiplier inputs are read only for Depth::hessian; others see zero.  `of_objective` multiplies
// the objective, soft rows among it.
Outputs run(const Transcription& t, const Batch& batch, Depth depth, std::span<const double> x, const Values* values,
            std::span<const double> multipliers, Workspace& w, double of_objective = 1) {
  const int samples = batch.samples(), outputs = batch.outputs();
  const auto& inputs = batch.program->inputs;
  // Rows a multiple of a cache line long, and never a multiple of the page: those would share cache sets.
  const std::size_t stride = (static_cast<std::size_t>(samples) + 7) / 8 * 8 + 8;
  w.inputs.resize(inputs.size() * stride);
  w.outputs.resize(batch.evaluator->outputs(depth) * stride);
  w.pointers.resize(inputs.size());
  w.uniform.assign(inputs.size(), 1);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    double* to = w.inputs.data() + i * stride;
    w.pointers[i] = to;
    const Input& input = inputs[i];
    switch (input.kind) {
      case InputKind::dof:
        break;  // below, slot by slot
      case InputKind::time:
        w.pointers[i] = batch.times.data();
        w.uniform[i] = 0;
        break;
      case InputKind::constant:
        *to = t.constants.at(input.name);
        break;
      case InputKind::functional:
        *to = x[t.first_functional() + input.index];
        break;
      case InputKind::multiplier:
        if (depth != Depth::hessian) {
          *to = 0;
        } else if (batch.summed()) {
          *to = multiplier_of(t, batch.targets[input.index], multipliers, of_objective);
        } else {
          w.uniform[i] = 0;
          for (int s = 0; s < samples; ++s) {
            const int row = batch.first_row + s * outputs + input.index;
            to[s] = t.rows[row].kind == Row::Kind::soft
                        ? of_objective * t.rows[row].weight * excess(t.rows[row], values->residual[row])
                        : multipliers[row];
          }
        }
        break;
      case InputKind::parameter: {
        const auto found = std::ranges::find(t.problem->parameters, input.name, &Parameter::name);
        *to = x[t.first_parameter() + (found - t.problem->parameters.begin())];
        break;
      }
      case InputKind::signal:
        *to = 0;
        break;  // no problem that is read has any
    }
  }
  for (const Slot& slot : batch.slots) {
    for (int d = 0; d <= max_derivative; ++d) {
      if (slot.input[d] < 0) continue;
      w.uniform[slot.input[d]] = 0;
      gather(batch.tables[slot.table].data(), x.data(), t.origin(slot.dof), d, samples,
             w.inputs.data() + slot.input[d] * stride);
    }
  }
  batch.evaluator->run(depth, samples, w.pointers, w.uniform, w.outputs.data(), stride);
  return {w.outputs.data(), stride};
}

// block(i, j) += scale * sum over (d, e) of  b_d[i] h(d, e) b_e[j], for the samples of one chunk.
struct HessianTerm {
  int d, e;
  const double* h;
};
SPACETIME_CLONES void add_block(const HessianTerm* terms, int count, const BasisValues* basis_a,
                                const BasisValues* basis_b, const double* scale, int from, int to, double* block) {
  for (int s = from; s < to; ++s) {
    double v[max_derivative + 1][4] = {};
    for (int k = 0; k < count; ++k) {
      const double h = terms[k].h[s] * (scale ? scale[s] : 1.0);
      const double* b = basis_b[s].b[terms[k].e].data();
      for (int j = 0; j < 4; ++j) v[terms[k].d][j] += h * b[j];
    }
    for (int d = 0; d <= max_derivative; ++d) {
      const double* b = basis_a[s].b[d].data();
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) block[4 * i + j] += b[i] * v[d][j];
      }
    }
  }
}

// Samples whose rows do not count are left out, not multiplied by zero: they may be no numbers.  All rows of a sample
// share its condition.
void add_hessian(const Transcription& t, const Layout& layout, const Batch& batch, const Outputs& out,
                 BorderedMatrix& hessian, std::span<const char> active = {}) {
  const auto sample_counts = [&](int s) {
    return batch.summed() || counts(active, batch.first_row + s * batch.outputs());
  };
  const std::size_t base = batch.program->values.size() + batch.program->jacobian.size();
  const double* scale = batch.summed() ? batch.weights.data() : nullptr;
  for (const HessianBlock& pattern : batch.hessian) {
    std::array<HessianTerm, (max_derivative + 1) * (max_derivative + 1)> terms;
    int count = 0;
    for (int d = 0; d <= max_derivative; ++d) {
      for (int e = 0; e <= max_derivative; ++e) {
        if (pattern.entry[d][e] >= 0) terms[count++] = {d, e, out.row(base + pattern.entry[d][e])};
      }
    }
    const Slot &a = batch.slots[pattern.a], &b = batch.slots[pattern.b];
    const auto &basis_a = batch.tables[a.table], &basis_b = batch.tables[b.table];
    for (std::size_t k = 0; k + 1 < batch.chunks.size(); ++k) {
      const int from = batch.chunks[k];
      std::array<double, 16> block{};
      const int to = batch.chunks[k + 1];
      const auto add = [&](int first, int last) {
        add_block(terms.data(), count, basis_a.data(), basis_b.data(), scale, first, last, block.data());
      };
      if (batch.summed() || active.empty()) {
        add(from, to);
      } else {
        for (int s = from; s < to; ++s) {
          if (sample_counts(s)) add(s, s + 1);
        }
      }
      const int* row = &layout.of_unknown[t.origin(a.dof) + basis_a[from].first];
      const int* column = &layout.of_unknown[t.origin(b.dof) + basis_b[from].first];
      for (int i = 0; i < 4; ++i) {
        const int last = pattern.a == pattern.b ? i : 3;  // a block on the diagonal: its lower triangle
        for (int j = 0; j <= last; ++j) {
          if (row[i] >= 0 && column[j] >= 0) hessian.add(row[i], column[j], block[4 * i + j]);
        }
      }
    }
  }
  for (const BorderHessian& pattern : batch.border_hessian) {
    const int z = layout.of_unknown[t.first_functional() + pattern.unknown];
    if (z < 0) continue;
    for (int s = 0; s < batch.samples(); ++s) {
      if (!sample_counts(s)) continue;
      const double h = out(base + pattern.entry, s) * (scale ? scale[s] : 1.0);
      if (pattern.other >= 0) {
        const int other = layout.of_unknown[t.first_functional() + pattern.other];
        if (other >= 0) hessian.add(z, other, h);
        continue;
      }
      const Slot& slot = batch.slots[pattern.slot];
      const BasisValues& basis = batch.basis(slot, s);
      for (int k = 0; k < 4; ++k) {
        const int position = layout.of_unknown[t.origin(slot.dof) + basis.first + k];
        if (position >= 0) hessian.add(z, position, h * basis.b[pattern.derivative][k]);
      }
    }
  }
}

// Calls visit(sample, output, position, derivative) for every entry of the batch's first derivatives by what is free.
template <typename Visit>
void for_each_derivative(const Transcription& t, const Layout& layout, const Batch& batch, const Outputs& out,
                         Visit visit) {
  const std::size_t base = batch.program->values.size();
  for (const JacobianBlock& pattern : batch.jacobian) {
    const Slot& slot = batch.slots[pattern.slot];
    for (int s = 0; s < batch.samples(); ++s) {
      const BasisValues& basis = batch.basis(slot, s);
      std::array<double, 4> sum{};
      for (int d = 0; d <= max_derivative; ++d) {
        if (pattern.entry[d] < 0) continue;
        const double j = out(base + pattern.entry[d], s);
        for (int k = 0; k < 4; ++k) sum[k] += j * basis.b[d][k];
      }
      const int* position = &layout.of_unknown[t.origin(slot.dof) + basis.first];
      for (int k = 0; k < 4; ++k) {
        if (sum[k] != 0 && position[k] >= 0) visit(s, pattern.output, position[k], sum[k]);
      }
    }
  }
  for (const BorderJacobian& pattern : batch.border_jacobian) {
    const int position = layout.of_unknown[t.first_functional() + pattern.unknown];
    if (position < 0) continue;
    for (int s = 0; s < batch.samples(); ++s) visit(s, pattern.output, position, out(base + pattern.entry, s));
  }
}

void add_first_derivatives(const Transcription& t, const Layout& layout, const Batch& batch, const Outputs& out,
                           std::span<const char> active, Linearisation& result) {
  const int outputs = batch.outputs();
  for_each_derivative(t, layout, batch, out, [&](int s, int output, int position, double value) {
    if (!batch.summed()) {
      const int row = batch.first_row + s * outputs + output;
      if (counts(active, row)) result.jacobian.add(layout.of_row[row], position, value);
      return;
    }
    const Target& target = batch.targets[output];
    if (target.kind == Target::Kind::objective) result.gradient[position] += batch.weights[s] * target.factor * value;
    if (target.kind == Target::Kind::functional) {
      result.jacobian.add(layout.of_row[t.functional_row[target.index]], position, -batch.weights[s] * value);
    }
  });
}

// Zeros, and the ones of the functionals' rows z - F.
void start_first_derivatives(const Transcription& t, const Layout& layout, Linearisation& result) {
  result.gradient.setZero();
  result.jacobian.set_zero();
  for (int k = 0; k < t.functionals(); ++k) {
    const int row = t.functional_row[k];
    if (row >= 0) result.jacobian.add(layout.of_row[row], layout.of_unknown[t.first_functional() + k], 1);
  }
}

// The objective's Hessian does not depend on multipliers of rows; everything else's does.
bool needs_multipliers(const Batch& batch) {
  return !batch.summed() || std::ranges::any_of(batch.targets, [](const Target& target) {
    return target.kind == Target::Kind::functional;
  });
}

}  // namespace

Values evaluate(const Transcription& t, std::span<const double> x, Workspace& workspace, std::span<const char> active) {
  Values values;
  values.terms.assign(t.problem->objective.size(), 0.0);
  values.residual.assign(t.rows.size(), 0.0);
  for (int k = 0; k < t.functionals(); ++k) {
    const int row = t.functional_row[k];
    if (row >= 0) values.residual[row] = x[t.first_functional() + k] - t.elsewhere[k];  // z - F
  }
  for (const Batch& batch : t.batches) {
    const Outputs out = run(t, batch, Depth::values, x, nullptr, {}, workspace);
    const int outputs = batch.outputs();
    for (int o = 0; o < outputs; ++o) {
      if (!batch.summed()) {
        for (int s = 0; s < batch.samples(); ++s) {
          const int row = batch.first_row + s * outputs + o;
          values.residual[row] = counts(active, row) ? out(o, s) : t.rows[row].at_most ? content : 0;
        }
        continue;
      }
      double sum = 0;
      for (int s = 0; s < batch.samples(); ++s) sum += batch.weights[s] * out(o, s);
      const Target& target = batch.targets[o];
      if (target.kind == Target::Kind::objective) values.terms[target.index] += target.factor * sum;
      if (target.kind == Target::Kind::functional) values.residual[t.functional_row[target.index]] -= sum;
    }
  }
  for (const double term : values.terms) values.objective += term;
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const double c = excess(t.rows[r], values.residual[r]);
    values.finite &= std::isfinite(values.residual[r]);
    if (t.rows[r].kind == Row::Kind::soft) values.objective += t.rows[r].weight / 2 * c * c;
  }
  values.finite &= std::isfinite(values.objective);
  return values;
}

Eigen::VectorXd residual_of(const Transcription& t, const Layout& layout, const Values& values) {
  Eigen::VectorXd c = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t r = 0; r < t.rows.size(); ++r) c[layout.of_row[r]] = values.residual[r];
  return c;
}

Eigen::VectorXd soft_weights(const Transcription& t, const Layout& layout, const Eigen::VectorXd& c) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(layout.size());
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const Row& row = t.rows[r];
    const int k = layout.of_row[r];
    if (row.kind == Row::Kind::soft && !(row.at_most && c[k] <= 0)) weights[k] = row.weight;
  }
  return weights;
}

double stationarity_of(const Layout& layout, const Eigen::VectorXd& lagrangian, const Eigen::VectorXd& objective) {
  double largest = 0, of_objective = 1;
  for (const int u : layout.free) {
    const int position = layout.of_unknown[u];
    largest = std::max(largest, std::abs(lagrangian[position]));
    of_objective = std::max(of_objective, std::abs(objective[position]));
  }
  return largest / of_objective;
}

Linearisation start_linearisation(const Layout& layout) {
  return {Eigen::VectorXd::Zero(layout.size()), BorderedMatrix(layout.pattern), BorderedMatrix(layout.pattern)};
}

void linearise(const Transcription& t, const Layout& layout, std::span<const double> x, Workspace& workspace,
               Linearisation& result, std::span<const char> active) {
  start_first_derivatives(t, layout, result);
  result.hessian.set_zero();
  for (const Batch& batch : t.batches) {
    const bool waits = needs_multipliers(batch);
    const Outputs out = run(t, batch, waits ? Depth::jacobian : Depth::hessian, x, nullptr, {}, workspace);
    add_first_derivatives(t, layout, batch, out, active, result);
    if (!waits) add_hessian(t, layout, batch, out, result.hessian);
  }
}

void differentiate(const Transcription& t, const Layout& layout, std::span<const double> x, Workspace& workspace,
                   Linearisation& result) {
  start_first_derivatives(t, layout, result);
  for (const Batch& batch : t.batches) {
    add_first_derivatives(t, layout, batch, run(t, batch, Depth::jacobian, x, nullptr, {}, workspace), {}, result);
  }
}

void add_row_curvature(const Transcription& t, const Layout& layout, std::span<const double> x, const Values& values,
                       std::span<const double> multipliers, Workspace& workspace, Linearisation& result,
                       std::span<const char> active) {
  for (const Batch& batch : t.batches) {
    if (!needs_multipliers(batch) || batch.program->hessian.empty()) continue;
    add_hessian(t, layout, batch, run(t, batch, Depth::hessian, x, &values, multipliers, workspace), result.hessian,
                active);
  }
}

void set_violation_curvature(const Transcription& t, const Layout& layout, std::span<const double> x,
                             std::span<const double> multipliers, Workspace& workspace, BorderedMatrix& curvature,
                             std::span<const char> active) {
  const Values none{0, {}, std::vector<double>(t.rows.size(), 0.0)};
  curvature.set_zero();
  for (const Batch& batch : t.batches) {
    if (!needs_multipliers(batch) || batch.program->hessian.empty()) continue;
    add_hessian(t, layout, batch, run(t, batch, Depth::hessian, x, &none, multipliers, workspace, 0), curvature,
                active);
  }
}

std::vector<char> active_rows(const Transcription& t, std::span<const double> x, Workspace& workspace) {
  std::vector<char> active(t.rows.size(), 1);
  for (const Conditional& conditional : t.conditionals) {
    const Outputs out = run(t, conditional.condition, Depth::values, x, nullptr, {}, workspace);
    for (int s = 0; s < conditional.condition.samples(); ++s) {
      const auto first = active.begin() + conditional.first_row + s * conditional.rows;
      std::fill(first, first + conditional.rows, static_cast<char>(out(conditional.output, s) != 0));
    }
  }
  return active;
}

void settle_functionals(const Transcription& t, std::vector<double>& x, Workspace& workspace) {
  // Each may use those before it: the k-th pass settles at least the k-th.
  for (int k = 0; k < t.functionals(); ++k) {
    if (t.functional_row[k] < 0) continue;
    const double missing = evaluate(t, x, workspace).residual[t.functional_row[k]];
    if (std::isfinite(missing)) x[t.first_functional() + k] -= missing;
  }
}

}  // namespace spacetime::optimizer
