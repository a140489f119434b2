// The canonical layout: what it looks like, and that nothing but looks is touched.
#include "symbolic/format.h"

#include <gtest/gtest.h>

#include "symbolic/lexer.h"
#include "tests/symbolic/places.h"
#include "tests/symbolic/relaid.h"
#include "tests/symbolic/scene_texts.h"

namespace spacetime::symbolic {
namespace {

std::string formatted(const std::string& text) {
  const Formatted out = format(text);
  for (const Diagnostic& diagnostic : out.diagnostics) ADD_FAILURE() << render(diagnostic, "scene", text);
  return out.text.value_or("");
}

std::vector<std::string> comments(const std::string& text) {
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> out;
  for (const Comment& comment : lex(text, diagnostics).comments) out.emplace_back(comment.text);
  return out;
}

TEST(Format, SpacesStandAroundSumsAndRelationsOnly) {
  EXPECT_EQ(formatted("let a=-x ^ -2*( y+3 )/norm ( (x ,y) )- -b''.x"),
            "let a = -x^-2*(y + 3)/norm((x, y)) - -b''.x\n");
  EXPECT_EQ(formatted("let a = if ( not x>=1 and(y<2 or z<=-3),+a,b )"),
            "let a = if(not x >= 1 and (y < 2 or z <= -3), +a, b)\n");
  EXPECT_EQ(formatted("define f (a,b)=a-b"), "define f(a, b) = a - b\n");
  EXPECT_EQ(formatted("dof x=-1 in[ -pi ,2. ]"), "dof x = -1 in [-pi, 2.]\n");
  EXPECT_EQ(formatted("let a = 2 .x + 1e-3+.5"), "let a = 2 .x + 1e-3 + .5\n");
  EXPECT_EQ(formatted("window[0,1]of x ,arm . s"), "window [0, 1] of x, arm.s\n");
}

TEST(Format, ClausesAreSetOffAndNamesLikeThemAreNot) {
  EXPECT_EQ(formatted("constrain x=over at over ,2 weight weight when when>0"),
            "constrain x = over  at over, 2  weight weight  when when > 0\n");
  EXPECT_EQ(formatted("constrain over:at(x,1)=0 over [0,1]every 0.1"),
            "constrain over: at(x, 1) = 0  over [0, 1] every 0.1\n");
  EXPECT_EQ(formatted("weight a=3\nscope a at 1"), "weight a = 3\nscope a at 1\n");
}

TEST(Format, NeighboursStandInColumns) {
  EXPECT_EQ(formatted("constant a=1\nconstant bcd=2 # two\nconstant c=33 # three\n\nconstant efghi=3"),
            "constant a   = 1\nconstant bcd = 2   # two\nconstant c   = 33  # three\n\nconstant efghi = 3\n");
  EXPECT_EQ(formatted("constrain a: x=0 at 1\nconstrain bc: x'=1 weight 2 at 1\nconstrain x=2\nconstrain d:x=3 at 3"),
            "constrain a:  x = 0   at 1\nconstrain bc: x' = 1  weight 2  at 1\nconstrain x = 2\n"
            "constrain d:  x = 3   at 3\n");
  EXPECT_EQ(formatted("keyframe 0: x = 1\nkeyframe 0.5: x = 2"), "keyframe 0:   x = 1\nkeyframe 0.5: x = 2\n");
}

TEST(Format, ColumnsThatWouldTearLinesApartAreLeft) {
  const std::string sum(" + aaaa"), name(40, 'n');
  EXPECT_EQ(formatted("let a = 1\nlet " + name + " = 2"), "let a = 1\nlet " + name + " = 2\n");
}

TEST(Format, LinksStandOnALineWhereTheyFit) {
  EXPECT_EQ(
      formatted("creature a { gravity (0,-g,0)\nlink b {\n revolute c;a .5\nmass 2\n\n rod\n}; link de on b{fixed}}"),
      "creature a {\n  gravity (0, -g, 0)\n  link b       { revolute c; a .5; mass 2; rod }\n"
      "  link de on b { fixed }\n}\n");
  const std::string wide = "(12345678901234567890, 12345678901234567890, 12345678901234567890)";
  EXPECT_EQ(formatted("creature a { link b { revolute c axis " + wide + "; a 1;d 2;mass 2;com (0,0,1);box (1,2,3) } }"),
            "creature a {\n  link b {\n    revolute c axis " + wide +
                "; a 1; d 2\n    mass 2; com (0, 0, 1)\n    box (1, 2, 3)\n  }\n}\n");
}

TEST(Format, CommentsStayWithWhatTheyStandBy) {
  EXPECT_EQ(formatted("#head\n\n\n\n# a\ndof x;dof y# b \n  # c\n\ndof z"),
            "#head\n\n# a\ndof x\ndof y  # b\n# c\n\ndof z\n");
  EXPECT_EQ(
      formatted("creature a{# 1\n# 2\nlink b { # 3\nfixed # 4\n;a 1;d 2\n# 5\n} # 6\n\n# 7\n} # 8\n# 9"),
      "creature a {  # 1\n  # 2\n  link b {  # 3\n    fixed  # 4\n    a 1; d 2\n    # 5\n  }  # 6\n\n  # 7\n}  # 8\n"
      "# 9\n");
  EXPECT_EQ(formatted("let a = (1, # one\n\n # two\n\n # also two\n 2) + # more\n 3"),
            "let a = (1,  # one\n    # two\n    # also two\n    2) +  # more\n    3\n");
  EXPECT_EQ(formatted("dof x\n; # not of x\ndof y"), "dof x\n# not of x\ndof y\n");
}

TEST(Format, LongLinesBreakAtTheLoosestBonds) {
  const std::string thirty(30, 'a'), fifty(50, 'c'), sixty(60, 'b');
  EXPECT_EQ(formatted("constrain " + fifty + "*" + thirty + " + x = 1 at 0"),
            "constrain " + fifty + "*" + thirty + " + x =\n    1  at 0\n");
  EXPECT_EQ(formatted("constrain (" + sixty + ", 2) = (" + thirty + ", 2) at 0"),
            "constrain (" + sixty + ", 2) =\n    (" + thirty + ", 2)  at 0\n");
  EXPECT_EQ(formatted("let a = min(" + sixty + ", " + sixty + ")"), "let a = min(" + sixty + ",\n    " + sixty + ")\n");
  EXPECT_EQ(formatted("let a = (" + thirty + ", " + sixty + ", " + thirty + "-" + thirty + ", x)"),
            "let a = (" + thirty + ",\n    " + sixty + ",\n    " + thirty + " - " + thirty + ", x)\n");
  EXPECT_EQ(formatted("creature k {\nforce on p = (" + sixty + ", " + sixty + ", 1) }"),
            "creature k {\n  force on p = (" + sixty + ",\n      " + sixty + ", 1)\n}\n");
}

TEST(Format, OtherLineEndsAndMarksGo) {
  EXPECT_EQ(formatted("\xEF\xBB\xBF"
                      "dof x # a\r\n\r\n\r\ndof y"),
            "dof x  # a\n\ndof y\n");
}

TEST(Format, MistakesAreReportedAndNothingIsWritten) {
  const Formatted out = format("dof x\ndof = 3\nlet a = (1");
  EXPECT_FALSE(out.text.has_value());
  ASSERT_EQ(out.diagnostics.size(), 2U);
  EXPECT_EQ(out.diagnostics[0].span.line, 2);
}

TEST(Format, EveryBlockOfTheManualAndEveryExampleIsFormatted) {
  for (const std::string& block : manual_blocks()) EXPECT_EQ(formatted(block), block);
  for (const auto& [path, text] : scene_texts())
    if (path.starts_with("examples/")) {
      EXPECT_EQ(formatted(text), text) << path;
    }
}

TEST(Format, KeepsEveryScenesProblemAndComments) {
  const auto scenes = scene_texts();
  EXPECT_GT(scenes.size(), 30U);
  for (const auto& [path, text] : scenes) {
    SCOPED_TRACE(path + ":\n" + text);
    const std::string once = formatted(text);
    EXPECT_EQ(formatted(once), once);
    EXPECT_EQ(without_places(problem_of(once)), without_places(problem_of(text)));
    EXPECT_EQ(comments(once), comments(text));
  }
}

TEST(Format, ForgetsHowATextWasLaidOut) {
  for (const auto& [path, text] : scene_texts())
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const std::string other = relaid(text, seed);
      SCOPED_TRACE(path + ", seed " + std::to_string(seed) + ":\n" + other);
      EXPECT_EQ(formatted(other), formatted(text));
    }
}

TEST(Format, NewCommentsChangeNothingElse) {
  for (const auto& [path, text] : scene_texts())
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
      const std::string other = relaid(text, seed, true);
      SCOPED_TRACE(path + ", seed " + std::to_string(seed) + ":\n" + other);
      const std::string once = formatted(other);
      EXPECT_EQ(formatted(once), once);
      EXPECT_EQ(comments(once), comments(other));
      EXPECT_EQ(without_places(problem_of(once)), without_places(problem_of(text)));
    }
}

}  // namespace
}  // namespace spacetime::symbolic
