#include "optimizer/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/diagnostic.h"
#include "optimizer/evaluation.h"
#include "tests/optimizer/evaluated.h"
#include "tests/optimizer/scenes.h"

namespace spacetime::optimizer {
namespace {

// Unknowns and rows each have a place of their own, and places are filled.
void expect_a_permutation(const Transcription& t, const Layout& layout) {
  std::vector<int> places = layout.of_unknown;
  places.insert(places.end(), layout.of_row.begin(), layout.of_row.end());
  ASSERT_EQ(static_cast<int>(places.size()), layout.size());
  ASSERT_EQ(places.size(), static_cast<std::size_t>(t.unknowns()) + t.rows.size());
  std::sort(places.begin(), places.end());
  for (std::size_t k = 0; k < places.size(); ++k) ASSERT_EQ(places[k], static_cast<int>(k));
}

TEST(Layout, TheBandDoesNotGrowWithTime) {
  for (const char* scene : {"examples/throw_eliminated.scene", "tests/golden/p92.scene"}) {
    const std::string text = file_text(scene);
    double least = 1e300, most = 0;
    for (const int spans : {64, 128, 512, 2048}) {
      const Problem problem = problem_of(with_spans(text, spans));
      const Transcription t = transcribe(problem);
      const Layout layout = arrange(t);
      expect_a_permutation(t, layout);
      const Pattern& pattern = *layout.pattern;
      EXPECT_EQ(pattern.m, 0);
      EXPECT_LE(pattern.width, 36) << scene;  // four coefficients of five degrees of freedom and the rows among them
      const double entries = pattern.width + static_cast<double>(pattern.far_entries()) / pattern.n;  // a row
      least = std::min(least, entries);
      most = std::max(most, entries);
    }
    EXPECT_LE(most - least, 6) << scene;
  }
}

TEST(Layout, TheBandHoldsFourCoefficientsOfEach) {
  // 3 degrees of freedom and no rows: a coefficient couples with those of 3 knots on either side.
  const Problem problem = problem_of(
      "time [0, 2]\ntrajectory bspline spans 64\ndof x\ndof y\ndof z\nminimize integral((x''*y'')^2 + (z''*y)^2)\n");
  const Transcription t = transcribe(problem);
  EXPECT_EQ(arrange(t).pattern->width, 11);
}

// Every row lies between the first and the last coefficient it touches, about as far from either.
TEST(Layout, RowsStandInTheMiddle) {
  const Problem problem = problem_of(file_text("tests/golden/p92.scene"));
  const Transcription t = transcribe(problem);
  const Layout layout = arrange(t);
  const std::vector<double> x(static_cast<std::size_t>(t.unknowns()), 0.1);
  Workspace workspace;
  Linearisation linear = start_linearisation(layout);
  linearise(t, layout, x, workspace, linear);
  const Eigen::MatrixXd dense = spacetime::optimizer::dense(linear.jacobian);
  for (std::size_t r = 0; r < t.rows.size(); ++r) {
    const int row = layout.of_row[r];
    int low = layout.size(), high = -1;
    for (const int u : layout.of_unknown) {
      const int i = std::max(u, row), j = std::min(u, row);
      if (dense(j, i) == 0) continue;
      low = std::min(low, u);
      high = std::max(high, u);
    }
    ASSERT_LE(low, high) << "row " << r;
    const bool at_an_end = high - low < 5;  // one coefficient, or two: there is no middle
    if (at_an_end) continue;
    EXPECT_LT(low, row) << "row " << r;
    EXPECT_LT(row, high) << "row " << r;
    EXPECT_LE(std::abs((row - low) - (high - row)), 12) << "row " << r;
  }
}

TEST(Layout, WhatCouplesDistantTimesStandsInTheBorder) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 32\ndof x\ndof y\n"
      "constrain sum: integral(x)*integral(y) = 1\nconstrain x = 0 at 0, 1\n"
      "minimize integral(x'^2 + y'^2) + (at(x, 0.25) - at(y, 0.75))^2\n");
  const Transcription t = transcribe(problem);
  const Layout layout = arrange(t);
  expect_a_permutation(t, layout);
  EXPECT_EQ(t.functionals(), 4);
  EXPECT_EQ(layout.pattern->m, 4 + 4 + 1);  // unknowns, their rows, and the relation between them
  EXPECT_EQ(layout.pattern->n, 70 + 2);
  EXPECT_LE(layout.pattern->width, 10);
}

TEST(Layout, RefusesAnEndlessBorder) {
  std::string text = "time [0, 1]\ntrajectory bspline spans 8\ndof x\nminimize at(x, 0)^2";
  for (int k = 1; k <= 600; ++k) text += " + (at(x, " + std::to_string(k) + "/601) - at(x, 1))^2";
  const Problem problem = problem_of(text + "\n");
  const Transcription t = transcribe(problem);
  EXPECT_THROW(arrange(t), InputError);
}

// A coarse curve beside a fine one costs a few long rows, not a band as wide as its spans.
TEST(Layout, ACoarseCurveDoesNotWidenTheBand) {
  for (const int coarse : {8, 64}) {
    const Problem problem = problem_of("time [0, 1]\ntrajectory bspline spans " + std::to_string(coarse) +
                                       "\ndof x\ntrajectory bspline spans 1024\ndof y\n"
                                       "constrain x = y over [0, 1] every 0.1\nconstrain x'' <= 1 over [0, 1]\n"
                                       "minimize integral((x'' - y'')^2)\n");
    const Transcription t = transcribe(problem);
    const Layout layout = arrange(t);
    expect_a_permutation(t, layout);
    const Pattern& pattern = *layout.pattern;
    EXPECT_EQ(pattern.m, 0);
    EXPECT_LE(pattern.width, 12);
    EXPECT_LE(pattern.far_entries(), 8 * 1024);  // four coarse coefficients everywhere, and what stands among them
    EXPECT_GE(pattern.sparse_rows(), coarse);
  }
}

TEST(Layout, OfBasesOfDifferentWidth) {
  const Problem problem = problem_of(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\ntrajectory bspline spans 32\ndof y\n"
      "constrain x = y over [0, 1] every 0.1\nminimize integral((x'' - y'')^2)\n");
  const Transcription t = transcribe(problem);
  const Layout layout = arrange(t);
  expect_a_permutation(t, layout);
  EXPECT_LE(layout.pattern->width, 40);
}

}  // namespace
}  // namespace spacetime::optimizer
