// Curves as drawings, as SVG and as pixels.
#include "gui/render/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/bspline.h"
#include "common/diagnostic.h"
#include "gui/render/palette.h"
#include "symbolic/compile.h"

namespace spacetime::gui {
namespace {

// q(t) = 2 + 3 t and others on [0, 2].
Motion motion_of(const std::vector<std::string>& names) {
  Motion motion;
  motion.start = 0, motion.end = 2;
  for (const std::string& name : names) {
    Trajectory dof{name, uniform_basis(0, 2, 4), {}};
    for (const double t : greville(dof.basis)) dof.coefficients.push_back(2 + 3 * t);
    motion.dofs.push_back(dof);
  }
  return motion;
}

const std::vector<double> times{0, 0.5, 2};

std::vector<std::string> labels(const std::vector<Curve>& curves) {
  std::vector<std::string> result;
  for (const Curve& curve : curves) result.push_back(curve.label);
  return result;
}
using Labels = std::vector<std::string>;

TEST(Curves, DegreesOfFreedomAndTheirDerivatives) {
  const Motion motion = motion_of({"x", "arm.a", "arm.b", "army.c"});
  const auto x = curves_of(motion, nullptr, "x", times);
  ASSERT_EQ(x.size(), 1U);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(x[0].values[i], 2 + 3 * times[i], 1e-12);
  EXPECT_NEAR(curves_of(motion, nullptr, "x'", times)[0].values[1], 3, 1e-12);
  EXPECT_NEAR(curves_of(motion, nullptr, "x''", times)[0].values[1], 0, 1e-10);
  EXPECT_EQ(labels(curves_of(motion, nullptr, "arm'", times)), (Labels{"arm.a'", "arm.b'"}));
  for (const char* wrong : {"", "y", "x'''", "x'y", "'", "arm.c"}) {
    EXPECT_THROW(curves_of(motion, nullptr, wrong, times), InputError) << wrong;
  }
}

TEST(Curves, NamedExpressionsOfTheProblemOrOfTheSamples) {
  const auto problem =
      symbolic::compile("time [0, 2]\ntrajectory bspline spans 4\ndof x\nlet pair = (x^2, x')\nlet both = x*x'\n")
          .problem;
  ASSERT_TRUE(problem);
  Motion motion = motion_of({"x"});
  const auto pair = curves_of(motion, &*problem, "pair", times);
  EXPECT_EQ(labels(pair), (Labels{"pair.x", "pair.y"}));
  EXPECT_NEAR(pair[0].values[1], 3.5 * 3.5, 1e-12);
  EXPECT_NEAR(pair[1].values[1], 3, 1e-12);
  EXPECT_NEAR(curves_of(motion, &*problem, "both", times)[0].values[2], 24, 1e-12);
  try {
    curves_of(motion, nullptr, "both", times);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--problem"), std::string::npos) << error.what();
  }
  motion.samples = Samples{{0, 1, 2}, {{"both", {{1}, {3}, {9}}}}, {}};
  EXPECT_NEAR(curves_of(motion, nullptr, "both", times)[0].values[1], 2, 1e-12);
}

TEST(Curves, AForceHasTheNamesOfItsDegreesOfFreedom) {
  Motion motion = motion_of({"arm.a", "arm.b", "x"});
  motion.samples = Samples{{0, 2}, {{"arm.force", {{1, 2}, {3, 4}}}}, {}};
  EXPECT_EQ(labels(curves_of(motion, nullptr, "arm.force", times)), (Labels{"arm.a.force", "arm.b.force"}));
}

TEST(Chart, TicksAreRoundAndInside) {
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks(-0.3, 1.2, 3), (std::vector<double>{0, 0.5, 1}));
  for (const double size : {1e-7, 3.3, 4e9}) {
    for (int count = 2; count < 12; ++count) {
      const auto marks = ticks(-0.3 * size, size, count);
      EXPECT_GE(marks.size(), static_cast<std::size_t>(count) / 3);
      EXPECT_LE(marks.size(), static_cast<std::size_t>(count) + 2);
      EXPECT_GE(marks.front(), -0.3001 * size);
      EXPECT_LE(marks.back(), 1.0001 * size);
    }
  }
}

Chart chart() {
  return {.times = {0, 1, 2}, .panels = {{{"up", {0, 5, 10}}, {"a<b&c", {10, 5, 0}}}, {{"flat", {3, 3, 3}}}}};
}

TEST(Chart, CurvesGoWhereTheirNumbersAre) {
  const Drawing drawing = draw(chart(), 600, 400);
  const auto colour = series_colour(Theme::light, 0);
  for (const auto& stroke : drawing.strokes) {
    if (!(stroke.colour == colour) || stroke.points.size() != 3) continue;
    // Evenly spaced in time, and straight, as the numbers are.
    EXPECT_NEAR(stroke.points[1].x, 0.5F * (stroke.points[0].x + stroke.points[2].x), 1e-3);
    EXPECT_NEAR(stroke.points[1].y, 0.5F * (stroke.points[0].y + stroke.points[2].y), 1e-3);
    for (const auto& point : stroke.points) {
      EXPECT_TRUE(point.x >= 0 && point.x <= 600 && point.y >= 0 && point.y <= 400);
    }
  }
  const auto word = [&](const std::string& text) {
    return std::ranges::any_of(drawing.words, [&](const auto& each) { return each.text == text; });
  };
  for (const char* text : {"up", "a<b&c", "flat", "time (s)", "0", "5", "10", "0.5", "2.0"})
    EXPECT_TRUE(word(text)) << text;
}

TEST(Chart, WhatIsNoNumberBreaksACurve) {
  Chart broken{.times = {0, 1, 2, 3, 4}, .panels = {{{"x", {0, 1, std::nan(""), 1, 0}}}}};
  const Drawing drawing = draw(broken, 600, 400);
  const auto colour = series_colour(Theme::light, 0);
  EXPECT_EQ(std::ranges::count_if(drawing.strokes, [&](const auto& s) { return s.colour == colour && s.width == 2; }),
            2);
  broken.panels = {{{"x", std::vector<double>(5, std::nan(""))}}};
  raster(draw(broken, 100, 80));  // nothing to draw, and no room for it
}

TEST(Chart, TheSvgIsWellFormed) {
  const std::string text = svg(draw(chart(), 600, 400));
  EXPECT_TRUE(text.starts_with("<svg "));
  EXPECT_TRUE(text.ends_with("</svg>\n"));
  EXPECT_NE(text.find(">a&lt;b&amp;c</text>"), std::string::npos);
  // Every element is closed: as many ends of elements as beginnings, and quotes in pairs.
  std::size_t opened = 0, closed = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    opened += text[i] == '<' && text[i + 1] != '/' ? 1 : 0;
    closed += (text[i] == '<' && text[i + 1] == '/') || (text[i] == '/' && text[i + 1] == '>') ? 1 : 0;
  }
  EXPECT_EQ(opened, closed);
  EXPECT_EQ(std::ranges::count(text, '"') % 2, 0);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(Chart, PixelsShowLinesAndWords) {
  Drawing drawing{.width = 120, .height = 60, .background = colour_of(0xffffff), .strokes = {}, .words = {}};
  drawing.strokes = {{{{10.5F, 10.5F}, {60.5F, 10.5F}, {60.5F, 40.5F}}, colour_of(0xff0000), 3}};
  const Image lines = raster(drawing);
  for (const auto& [x, y] : {std::pair{30, 10}, {60, 25}, {60, 11}}) {
    EXPECT_EQ(lines.at(x, y)[0], 255);
    EXPECT_EQ(lines.at(x, y)[1], 0);
  }
  EXPECT_EQ(lines.at(30, 13)[1], 255);
  drawing.strokes.clear();
  const auto ink = [&](Drawing::Anchor anchor) {  // the columns that a word covers
    drawing.words = {{"WWW", {60, 40}, 20, colour_of(0x000000), anchor}};
    const Image image = raster(drawing);
    int first = image.width, last = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (image.at(x, y)[0] < 128) first = std::min(first, x), last = std::max(last, x);
      }
    }
    return std::pair{first, last};
  };
  const auto [from, to] = ink(Drawing::Anchor::start);
  EXPECT_NEAR(from, 60, 2);
  EXPECT_NEAR(to - from, 59, 6);  // three letters of 0.99 em
  EXPECT_NEAR(ink(Drawing::Anchor::end).second, 60, 2);
  const auto [left, right] = ink(Drawing::Anchor::middle);
  EXPECT_NEAR(left + right, 120, 3);
}

}  // namespace
}  // namespace spacetime::gui
