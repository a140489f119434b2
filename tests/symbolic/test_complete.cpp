// What can be written where: scenes with a cursor |, and what is offered there and what is not.
#include "symbolic/complete.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>

#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {
namespace {

const std::string head = R"(time [0, 2]
constant g = 9.81   # gravity
parameter k = 2 in [0, 3]
trajectory bspline spans 8
dof x = 0.5
define soft(a) = a^2
creature arm {
  gravity (0, -g, 0)
  link upper { revolute shoulder; a 0.5; mass 2; rod }
  link fore { revolute elbow in [-2, 0]; a 0.4; mass 1 }
  point hand on fore (0, 0, 0)
}
let height = arm.hand.y
constrain goal: x = 1 at 2
minimize work: integral(x''^2)
)";

// The scene without its cursor, and where that is.
struct Marked {
  std::string text;
  int line = 1, column = 1;
};
Marked marked(std::string text) {
  const std::size_t at = text.find('|');
  EXPECT_NE(at, std::string::npos);
  text.erase(at, 1);
  const std::string front = text.substr(0, at);
  const std::size_t line_start = front.rfind('\n') == std::string::npos ? 0 : front.rfind('\n') + 1;
  return {text, 1 + static_cast<int>(std::ranges::count(front, '\n')), 1 + static_cast<int>(at - line_start)};
}

using Labels = std::set<std::string>;

Labels offered(const std::string& text) {
  const Marked scene = marked(text);
  Labels out;
  for (const Completion& one : complete(scene.text, scene.line, scene.column))
    EXPECT_TRUE(out.insert(one.label).second) << one.label << " is offered twice";
  return out;
}

struct Case {
  const char* text;
  Labels present, absent;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.text; }

class Complete : public testing::TestWithParam<Case> {};

TEST_P(Complete, OffersWhatFits) {
  const auto& [text, present, absent] = GetParam();
  const Labels labels = offered(head + text);
  for (const std::string& label : present) EXPECT_TRUE(labels.contains(label)) << label;
  for (const std::string& label : absent) EXPECT_FALSE(labels.contains(label)) << label;
}

INSTANTIATE_TEST_SUITE_P(
    Places, Complete,
    testing::Values(
        Case{"|", {"time", "dof", "constrain", "solve", "reset"}, {"x", "sin", "revolute", "over"}},
        Case{"con|", {"constant", "constrain", "control"}, {"dof", "count"}},
        Case{"solve; w|", {"window", "weight"}, {"when"}}, Case{"dof |", {}, {"x", "dof", "sin"}},
        Case{"constrain arm.|", {"shoulder", "elbow", "hand", "upper", "fore", "q", "force", "com"}, {"x", "sin"}},
        Case{"constrain arm.h|", {"hand"}, {"elbow", "q", "height"}},
        Case{"constrain 2*(x + arm.elbow.|", {"force"}, {"x", "hand"}}, Case{"let p = x.|", {}, {"x", "force"}},
        Case{"let p = arm.hand.|", {"x", "y", "z"}, {"force", "hand"}},
        Case{"window [0, 1] of |", {"x", "arm", "arm.elbow"}, {"k", "g", "height", "sin"}},
        Case{"shake amplitude 0.1 of x, |", {"arm"}, {"g"}}, Case{"enable |", {"goal", "work"}, {"x", "g"}},
        Case{"scope |", {"goal"}, {"work"}}, Case{"scope goal |", {"at", "over"}, {"when", "x"}},
        Case{"set |", {"g"}, {"k", "x", "pi"}}, Case{"bound arm.|", {"elbow"}, {"sin"}},
        Case{"let q = x + |", {"x", "g", "k", "arm", "height", "sin", "soft", "pi", "t", "if"}, {"goal", "over"}},
        Case{"let q = hei|", {"height"}, {"x"}}, Case{"let q = min(x, |", {"x", "max"}, {"at 2", "over"}},
        Case{"define f(uu, vv) = uu + |", {"uu", "vv", "x"}, {}},
        Case{"constrain x = 1 |", {"at", "over", "when", "weight"}, {"every", "count", "x", "inf"}},
        Case{"constrain x = 1 over [0, 2] |", {"every", "count", "when", "weight"}, {"at", "over", "x"}},
        Case{"constrain x = 1 over [0, 2] every |", {"g", "sqrt"}, {"every", "count"}},
        Case{"constrain x = 1 at 2 weight |", {"inf", "g"}, {"weight"}},
        Case{"minimize integral(x) |", {"weight"}, {"at", "over", "when"}},
        Case{"solve |", {"method", "iterations", "tolerance", "starts"}, {"x", "newton", "linear"}},
        Case{"solve method |", {"newton", "sqp92", "bfgs"}, {"method", "x"}},
        Case{"solve iterations 3 |", {"tolerance", "method"}, {"iterations"}},
        Case{"trajectory |", {"bspline", "wavelet"}, {"spans", "level", "x"}},
        Case{"trajectory bspline |", {"spans", "knots"}, {"wavelet", "x", "level"}},
        Case{"dof z = 1 |", {"in"}, {"x", "at"}},
        Case{"creature b {\n  |", {"link", "point", "gravity", "force"}, {"dof", "mass"}},
        Case{"creature b {\n  link one { fixed }\n  link two on |", {"one", "ground"}, {"upper", "two"}},
        Case{"creature b {\n  link one { |", {"revolute", "mass", "rod"}, {"link", "dof"}},
        Case{"creature b {\n  link one { fixed; mass |", {"g", "k"}, {"revolute"}},
        Case{"creature b {\n  link one { fixed }\n  point tip on one (0,0,0)\n  force on |", {"tip"}, {"one", "hand"}},
        // Unfinished and wrong text in front.
        Case{"let q = (1 + \nconstrain |", {"x", "g"}, {"over"}},
        Case{"dof = 3 3\nlet wrong = ) (\nlet q = |", {"x", "wrong"}, {}}, Case{"# arm.|", {}, {"elbow", "x"}},
        Case{"let q = x # all of |", {}, {"x", "sin"}}, Case{"let q = | + later\nlet later = 3", {"x"}, {"later"}}));

TEST(Completion, SaysWhatThingsAre) {
  const Marked scene = marked(head + "let q = |");
  const auto all = complete(scene.text, scene.line, scene.column);
  const auto of = [&](const std::string& label) { return *std::ranges::find(all, label, &Completion::label); };
  EXPECT_EQ(of("g").kind, Completion::Kind::constant);
  EXPECT_EQ(of("g").detail, "constant g = 9.81");
  EXPECT_EQ(of("soft").detail, "define soft(a) = a^2");
  EXPECT_EQ(of("soft").insert, "soft(");
  EXPECT_EQ(of("atan2").detail, "atan2(y, x)");
  EXPECT_EQ(of("arm").kind, Completion::Kind::creature);
  EXPECT_EQ(name_of(of("height").kind), "let");
}

TEST(Completion, DescribesTheNameUnderTheCursor) {
  const Marked on_elbow = marked(head + "let q = arm.el|bow + 1"), on_sin = marked("let q = s|in(2)");
  EXPECT_EQ(describe(on_elbow.text, on_elbow.line, on_elbow.column).value().detail, "revolute elbow in [-2, 0]");
  EXPECT_EQ(describe(on_sin.text, on_sin.line, on_sin.column).value().detail, "sin(x)");
  EXPECT_FALSE(describe("let q = 3 +", 1, 11).has_value());
}

// Wherever the cursor stands, in a text cut off anywhere.
TEST(Completion, BearsEveryCursor) {
  const std::string text = "\xEF\xBB\xBF# \xC3\xA4\r\n" + file_text("examples/throw.scene") + "} ) ] { ( \x01";
  int line = 1, column = 1;
  for (const char c : text) {
    complete(text, line, column);
    if (c == '\n')
      ++line, column = 1;
    else
      ++column;
  }
  for (const auto& [l, c] : {std::pair{0, 0}, {-3, 5}, {1, 100000}, {100000, 1}}) complete(text, l, c);
  EXPECT_TRUE(complete("", 1, 1).size() > 20);
}

}  // namespace
}  // namespace spacetime::symbolic
