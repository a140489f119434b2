// Each line that the window writes is read by the real compiler as the action it is paired with, to the last bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "gui/words.h"
#include "symbolic/compile.h"

namespace spacetime::gui {
namespace {

const std::string scene =
    "time [0, 2]\ntrajectory bspline spans 8\nconstant k = 1\ndof x in [-10, 10]\ndof y\n"
    "constrain goal: x = k at 1\nminimize effort: integral(x''^2 + y''^2)\n";

// What the compiler makes of the line; nothing, and a failure, for a mistake.
std::string compiled(const std::string& line) {
  const auto result = symbolic::compile(scene + line + "\n");
  for (const Diagnostic& diagnostic : result.diagnostics) ADD_FAILURE() << line << ": " << diagnostic.message;
  if (!result.problem || result.problem->actions.empty()) return {};
  return json_of(result.problem->actions.back().action);
}

TEST(Words, AreReadAsTheActionsTheyArePairedWith) {
  std::mt19937_64 random(1992);
  std::uniform_real_distribution<double> between(-1, 1);
  std::uniform_int_distribution<int> exponent(-30, 20);
  const auto number = [&] { return std::ldexp(between(random), exponent(random)); };
  for (int round = 0; round < 30; ++round) {
    Solve solve;
    if (round % 2) solve.iterations = round;
    if (round % 3) solve.tolerance = std::abs(number());
    if (round % 5 == 1) solve.method = Solve::Method::bfgs;
    if (round % 5 == 2) solve.method = Solve::Method::sqp92;
    solve.linear_cg = solve.method == Solve::Method::sqp92 && round % 2;
    if (round % 4 == 3) solve.starts = round;
    const double low = -std::abs(number()), time = 1 + between(random), a = std::abs(number()), x = number(),
                 y = number();
    for (const Words& words : {set_words("k", number()),
                               weight_words("goal", a),
                               weight_words("goal", std::numeric_limits<double>::infinity()),
                               enable_words("goal"),
                               disable_words("effort"),
                               delete_words("goal"),
                               bound_words("x", low, a),
                               window_words(0.5 * time / 2, time / 2 + 1),
                               window_words(0.25, 0.25 + time, {"x", "y"}),
                               window_all_words(),
                               refine_words(0, time),
                               refine_words(0.125, 2, {"y"}, 3),
                               refine_auto_words(a),
                               shake_words(a, round),
                               shake_words(a, round, {"x"}),
                               filter_words(a),
                               filter_words(a, {"x", "y"}),
                               damp_words(a),
                               damp_words(a, {"y"}),
                               key_words(time, {{"x", x}, {"y", y}}),
                               control_words("x", 3, number()),
                               reset_words(),
                               solve_words(solve),
                               iterate_words(round)}) {
      EXPECT_EQ(compiled(words.line), words.action) << words.line;
    }
  }
}

TEST(Words, StatementsAreRestatedByLines) {
  EXPECT_NE(compiled(replace_line("goal", "x = 2 at 1.5")).find("\"replace\""), std::string::npos);
  EXPECT_NE(compiled(scope_line("goal", "over [0, 1] every 0.5")).find("\"scope\""), std::string::npos);
}

TEST(Words, NumbersReadBackBitForBit) {
  std::mt19937_64 random(1994);
  for (int i = 0; i < 10'000; ++i) {
    const double number = std::bit_cast<double>(random());
    if (!std::isfinite(number)) continue;
    EXPECT_EQ(std::strtod(number_text(number).c_str(), nullptr), number);
  }
}

TEST(Words, OnlyWhatIteratesIsWrittenFromTheLog) {
  EXPECT_EQ(iterating_line(R"({"action":"iterate","iterations":12})"), "iterate 12");
  EXPECT_EQ(iterating_line(R"({"action":"solve","iterations":988})"), "solve iterations 988");
  EXPECT_EQ(iterating_line(R"({"action":"reset"})"), "");
  EXPECT_TRUE(same_action(R"({"action":"solve","iterations":40})", R"({"action":"iterate","iterations":40})"));
  EXPECT_FALSE(same_action(R"({"action":"solve"})", R"({"action":"iterate","iterations":40})"));
  EXPECT_THROW(iterating_line(R"({"action":"dance"})"), InputError);
}

TEST(Words, AreShortenedToBeLookedAt) {
  EXPECT_EQ(brief("key 0.5: arm.elbow = -0.54681234567, x2 = 1e-17; set k12 = 123456"),
            "key 0.5: arm.elbow = -0.5468, x2 = 1e-17; set k12 = 123456");
  EXPECT_EQ(brief("control a.b 12 = 3.0000000000000004"), "control a.b 12 = 3");
  EXPECT_EQ(brief(""), "");
}

}  // namespace
}  // namespace spacetime::gui
