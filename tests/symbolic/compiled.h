// Compiling scenes in tests and running what comes out.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/bspline.h"
#include "common/evaluate.h"
#include "symbolic/compile.h"

namespace spacetime::symbolic {

inline std::string file_text(const std::string& path) {
  std::ifstream in(std::string(SPACETIME_SOURCE_DIR "/") + path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

// The problem of a scene without mistakes.
inline Problem problem_of(const std::string& text) {
  Compilation result = compile(text);
  for (const Diagnostic& diagnostic : result.diagnostics) ADD_FAILURE() << render(diagnostic, "scene", text);
  return result.problem.value();
}

// Values of what programs read.
struct State {
  std::map<std::pair<std::string, int>, double> dofs;  // by name and derivative
  double time = 0;
  std::map<std::string, double> constants;  // where they differ from the problem's
  std::map<std::string, double> parameters;
  std::vector<double> functionals;
};

inline double value_of(const Problem& problem, const Quantity& quantity, const State& state = {});

// Multipliers are 1.
inline std::vector<double> run(const Problem& problem, const std::string& key, const State& state) {
  const Program& program = problem.programs.at(key);
  EXPECT_FALSE(validate(program).has_value());
  std::vector<double> inputs;
  for (const Input& input : program.inputs) {
    double value = 1;
    if (input.kind == InputKind::dof) value = state.dofs.at({input.name, input.derivative});
    if (input.kind == InputKind::time) value = state.time;
    if (input.kind == InputKind::functional) value = state.functionals.at(static_cast<std::size_t>(input.index));
    if (input.kind == InputKind::parameter) value = state.parameters.at(input.name);
    if (input.kind == InputKind::constant) {
      const auto set = state.constants.find(input.name);
      if (set != state.constants.end())
        value = set->second;
      else
        for (const Constant& constant : problem.constants)
          if (constant.name == input.name) value = value_of(problem, constant.value, state);
    }
    inputs.push_back(value);
  }
  return evaluate_once(program, Depth::values, inputs);
}

inline double value_of(const Problem& problem, const Quantity& quantity, const State& state) {
  if (quantity.program.empty()) return quantity.number;
  return run(problem, quantity.program, state).at(static_cast<std::size_t>(quantity.output));
}

inline std::vector<double> plotted(const Problem& problem, const std::string& name, const State& state) {
  for (const Plot& plot : problem.plots) {
    if (plot.name != name) continue;
    const auto values = run(problem, plot.program, state);
    std::vector<double> out;
    for (const int output : plot.outputs) out.push_back(values.at(static_cast<std::size_t>(output)));
    return out;
  }
  ADD_FAILURE() << "no plot " << name;
  return {};
}

// The state at time t of trajectories with these coefficients, one degree of freedom after the other.
inline State state_at(const Problem& problem, const std::vector<double>& coefficients, double t) {
  State out;
  out.time = t;
  std::size_t first = 0;
  for (const Dof& dof : problem.dofs) {
    const auto size = static_cast<std::size_t>(dof.basis.size());
    const std::span<const double> own(coefficients.data() + first, size);
    for (int d = 0; d <= 2; ++d) out.dofs[{dof.name, d}] = value(dof.basis, own, t, d);
    first += size;
  }
  return out;
}

}  // namespace spacetime::symbolic
