// Scenes with one slip, which is reported once, where it is, in words that say what to do.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "symbolic/compile.h"

namespace spacetime::symbolic {

struct Wrong {
  std::string text;
  int line, column;
  std::string piece;  // of the message
};

inline const std::string time = "time [0, 2]\ntrajectory bspline spans 8\n";  // two lines
inline const std::string head = time + "dof x\n";                             // three

inline void expect_one(const Wrong& wrong) {
  const Compilation result = compile(wrong.text);
  EXPECT_FALSE(result.problem.has_value()) << wrong.text;
  std::string all;
  for (const Diagnostic& diagnostic : result.diagnostics) all += render(diagnostic, "scene", wrong.text);
  ASSERT_EQ(result.diagnostics.size(), 1U) << wrong.text << '\n' << all;
  const Diagnostic& diagnostic = result.diagnostics[0];
  EXPECT_EQ(diagnostic.span.line, wrong.line) << all;
  EXPECT_EQ(diagnostic.span.column, wrong.column) << all;
  EXPECT_NE(diagnostic.message.find(wrong.piece), std::string::npos) << all;
}

}  // namespace spacetime::symbolic
