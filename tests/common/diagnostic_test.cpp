#include "common/diagnostic.h"

#include <gtest/gtest.h>

namespace spacetime {
namespace {

constexpr auto text =
    "time [0, 2]\n"
    "constant g = 9.81\n"
    "\tconstrain\tgoal: arm.ell = 0\r\n"
    "let größe = länge + 1";

TEST(Diagnostic, ShowsTheLineAndMarksTheSpan) {
  EXPECT_EQ(render({{2, 14, 4}, "too heavy", {}}, "throw.scene", text),
            "throw.scene:2:14: error: too heavy\n"
            "constant g = 9.81\n"
            "             ^~~~\n");
}

TEST(Diagnostic, ShowsNotes) {
  EXPECT_EQ(render({{2, 10, 1}, "g is declared twice", {{{1, 1, 4}, "here first"}}}, "a", text),
            "a:2:10: error: g is declared twice\n"
            "constant g = 9.81\n"
            "         ^\n"
            "a:1:1: note: here first\n"
            "time [0, 2]\n"
            "^~~~\n");
}

TEST(Diagnostic, KeepsTabsAndDropsTheCarriageReturn) {
  EXPECT_EQ(render({{3, 18, 7}, "unknown", {}}, "a", text),
            "a:3:18: error: unknown\n"
            "\tconstrain\tgoal: arm.ell = 0\n"
            "\t         \t      ^~~~~~~\n");
}

TEST(Diagnostic, CountsCharactersNotBytes) {
  EXPECT_EQ(render({{4, 13, 5}, "unknown", {}}, "a", text),
            "a:4:13: error: unknown\n"
            "let größe = länge + 1\n"
            "            ^~~~~\n");
}

TEST(Diagnostic, MarksTheEndOfALine) {
  EXPECT_EQ(render({{1, 12, 1}, "something is missing", {}}, "a", text),
            "a:1:12: error: something is missing\n"
            "time [0, 2]\n"
            "           ^\n");
  EXPECT_EQ(render({{1, 10, 50}, "goes on", {}}, "a", text),  // a span beyond its line ends with it
            "a:1:10: error: goes on\n"
            "time [0, 2]\n"
            "         ^~\n");
}

TEST(Diagnostic, DoesWithoutAPlace) {
  EXPECT_EQ(render({{}, "is empty", {}}, "a", ""), "a: error: is empty\n");
  EXPECT_EQ(render({{9, 1, 1}, "is missing", {}}, "a", text), "a:9:1: error: is missing\n");
}

TEST(Diagnostic, CutsLongLinesAroundTheSpan) {
  const std::string line = std::string(500, 'x') + "WRONG" + std::string(500, 'y');
  EXPECT_EQ(render({{1, 501, 5}, "m", {}}, "a", line),
            "a:1:501: error: m\n"
            "..." +
                std::string(20, 'x') + "WRONG" + std::string(75, 'y') + "...\n" + std::string(23, ' ') + "^~~~~\n");
  EXPECT_EQ(render({{1, 1005, 1}, "m", {}}, "a", line),  // the last character
            "a:1:1005: error: m\n"
            "..." +
                std::string(100, 'y') + "\n" + std::string(102, ' ') + "^\n");
  EXPECT_EQ(render({{1, 1, 900}, "m", {}}, "a", line),
            "a:1:1: error: m\n" + std::string(100, 'x') + "...\n" + "^" + std::string(99, '~') + "\n");
}

TEST(Diagnostic, LetsNoControlCharactersThrough) {
  EXPECT_EQ(render({{1, 3, 1}, "m", {}}, "a", "a\x1b!b"), "a:1:3: error: m\na\uFFFD!b\n  ^\n");
}

// Any span on any bytes: no crash, whole lines.
TEST(Diagnostic, SurvivesNonsense) {
  const std::string bytes = "\xff\x80\x80\n\xc3\n\n\xf0\x9f\t\x00z";
  for (int line = -1; line < 8; ++line) {
    for (int column = -1; column < 8; ++column) {
      for (int length = -1; length < 9; length += 2) {
        EXPECT_EQ(render({{line, column, length}, "m", {}}, "a", bytes).back(), '\n');
      }
    }
  }
}

}  // namespace
}  // namespace spacetime
