// Scenes for tests of the optimizer: compiled here, never read from documents.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "common/diagnostic.h"
#include "common/motion.h"
#include "optimizer/run.h"
#include "symbolic/compile.h"

namespace spacetime::optimizer {

inline std::string file_text(const std::string& path) {
  std::ifstream in(std::string(SPACETIME_SOURCE_DIR "/") + path, std::ios::binary);
  EXPECT_TRUE(in) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

// The problem of a scene without mistakes.
inline Problem problem_of(const std::string& text) {
  symbolic::Compilation result = symbolic::compile(text);
  for (const Diagnostic& diagnostic : result.diagnostics) ADD_FAILURE() << render(diagnostic, "scene", text);
  return result.problem.value();
}

inline Motion run_scene(const std::string& text, const RunOptions& options = {}) {
  return run(problem_of(text), options);
}

// The scene with another number of uniform spans.
inline std::string with_spans(std::string text, int spans) {
  const auto from = text.find("bspline spans ") + std::string("bspline spans ").size();
  const auto to = text.find_first_not_of("0123456789", from);
  return text.replace(from, to - from, std::to_string(spans));
}

// A motion to start from: coefficients of all degrees of freedom, one after another.
inline Motion motion_of(const Problem& problem, std::span<const double> coefficients) {
  Motion motion;
  motion.start = problem.start;
  motion.end = problem.end;
  std::size_t first = 0;
  for (const Dof& dof : problem.dofs) {
    const auto own = coefficients.subspan(first, static_cast<std::size_t>(dof.basis.size()));
    motion.dofs.push_back({dof.name, dof.basis, {own.begin(), own.end()}});
    first += own.size();
  }
  EXPECT_EQ(first, coefficients.size());
  return motion;
}

inline std::vector<double> coefficients_of(const Motion& motion) {
  std::vector<double> all;
  for (const Trajectory& dof : motion.dofs) all.insert(all.end(), dof.coefficients.begin(), dof.coefficients.end());
  return all;
}

}  // namespace spacetime::optimizer
