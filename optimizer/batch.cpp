#include "optimizer/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "common/diagnostic.h"

namespace spacetime::optimizer {
namespace {

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
    meanings[i].border = border_index_of(problem, input);
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

}  // namespace

int index_of(const Problem& problem, const std::string& dof) {
  const auto found = std::ranges::find(problem.dofs, dof, &Dof::name);
  return static_cast<int>(found - problem.dofs.begin());
}

int require_dof(const Problem& problem, const std::string& name) {
  const int dof = index_of(problem, name);
  if (dof == static_cast<int>(problem.dofs.size())) {
    throw InputError(fmt::format("there is no degree of freedom '{}'", name));
  }
  return dof;
}

std::vector<char> named_dofs(const Problem& problem, const DofNames& names) {
  std::vector<char> named(problem.dofs.size(), names.empty());
  for (const std::string& name : names) named[require_dof(problem, name)] = 1;
  return named;
}

Span span_of(const Problem& problem, const Constants& constants, const std::optional<Interval>& interval,
             const std::string& what) {
  if (!interval) return {problem.start, problem.end};
  const double a = evaluate(problem, constants, interval->from, what);
  const double b = evaluate(problem, constants, interval->to, what);
  if (!(a < b) || b <= problem.start || a >= problem.end) {
    throw InputError(fmt::format("the {} [{}, {}] does not meet the animation's time, [{}, {}]", what, a, b,
                                 problem.start, problem.end));
  }
  return {a, b};
}

int border_index_of(const Problem& problem, const Input& input) {
  if (input.kind == InputKind::functional) return input.index;
  if (input.kind != InputKind::parameter) return -1;
  const auto found = std::ranges::find(problem.parameters, input.name, &Parameter::name);
  return static_cast<int>(problem.functionals.size() + (found - problem.parameters.begin()));
}

void complete(const Problem& problem, Batch& batch) {
  std::vector<Meaning> meanings;
  add_slots(problem, batch, meanings);
  add_jacobian(batch, meanings);
  add_hessian(batch, meanings);
  add_chunks(batch);
}

}  // namespace spacetime::optimizer
