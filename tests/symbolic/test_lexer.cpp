#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "symbolic/lexer.h"

namespace spacetime::symbolic {
namespace {

struct Result {
  std::vector<Token> tokens;
  std::vector<Diagnostic> diagnostics;
  bool is_text = true;
};

Result run(std::string_view text) {
  Result out;
  Lexed lexed = lex(text, out.diagnostics);
  out.tokens = std::move(lexed.tokens);
  out.is_text = lexed.is_text;
  return out;
}

// The tokens' texts, with | for a line end.
std::string words(std::string_view text) {
  const Result result = run(text);
  EXPECT_TRUE(result.diagnostics.empty()) << text;
  std::string out;
  for (const Token& token : result.tokens)
    if (token.kind == TokenKind::line_end)
      out += "| ";
    else if (token.kind != TokenKind::end)
      out += std::string(token.text) + ' ';
  return out;
}

TEST(Lexer, SplitsNamesNumbersAndOperators) {
  EXPECT_EQ(words("a<=b>=c<d>e=f"), "a <= b >= c < d > e = f | ");
  EXPECT_EQ(words("arm.elbow'' ^-2"), "arm . elbow ' ' ^ - 2 | ");
  EXPECT_EQ(words("x_1 Y2 _z"), "x_1 Y2 _z | ");
}

TEST(Lexer, KeepsCommentsWithWhatFollowsThem) {
  std::vector<Diagnostic> diagnostics;
  const Lexed lexed = lex("#\xC3\xA4 \ndof x # b\t\r\n# c\n+ # d", diagnostics);
  ASSERT_EQ(lexed.comments.size(), 4U);
  const std::vector<Comment> expected{{"#\xC3\xA4", 1, 0}, {"# b", 2, 2}, {"# c", 3, 3}, {"# d", 4, 4}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(lexed.comments[i].text, expected[i].text);
    EXPECT_EQ(lexed.comments[i].line, expected[i].line);
    EXPECT_EQ(lexed.comments[i].before, expected[i].before);
  }
}

TEST(Lexer, ReadsNumbersAsCppDoes) {
  for (const auto& [text, value] :
       std::vector<std::pair<std::string, double>>{{"2", 2},
                                                   {"2.", 2},
                                                   {"2.5", 2.5},
                                                   {".5", 0.5},
                                                   {"1e-3", 1e-3},
                                                   {"1E+3", 1000},
                                                   {"2.e2", 200},
                                                   {".5e1", 5},
                                                   {"0.1", 0.1},
                                                   {"007", 7},
                                                   {"1.7976931348623157e308", 1.7976931348623157e308}}) {
    const Result result = run(text);
    ASSERT_EQ(result.tokens[0].kind, TokenKind::number) << text;
    EXPECT_EQ(result.tokens[0].number, value) << text;
  }
}

TEST(Lexer, RefusesWhatIsNoNumber) {
  for (const std::string text : {"1e", "1..2", "1.2.3", "0x10", "2x", "1e400", "1e-400", "1_000", "3e5e"}) {
    const Result result = run(text);
    ASSERT_EQ(result.diagnostics.size(), 1U) << text;
    EXPECT_EQ(result.diagnostics[0].span, (Span{1, 1, static_cast<int>(text.size())})) << text;
    EXPECT_EQ(result.tokens[0].kind, TokenKind::bad) << text;
  }
}

TEST(Lexer, CommentsAndBlankLinesLeaveNoTrace) {
  EXPECT_EQ(words("# one\n\n  # two\na # three\n\n\nb\n"), "a | b | ");
  EXPECT_EQ(words(""), "");
  EXPECT_EQ(words("# only"), "");
}

TEST(Lexer, LinesThatEndInAnOperatorOrCommaGoOn) {
  EXPECT_EQ(words("a +\nb"), "a + b | ");
  EXPECT_EQ(words("a, # why\n\n b"), "a , b | ");
  EXPECT_EQ(words("a and\nb"), "a and b | ");
  EXPECT_EQ(words("a =\nb\nc"), "a = b | c | ");
  EXPECT_EQ(words("x'\ny"), "x ' | y | ");
}

TEST(Lexer, KeepsLineEndsInsideBracketsForTheParserToJudge) { EXPECT_EQ(words("(a\nb)"), "( a | b ) | "); }

TEST(Lexer, ToleratesByteOrderMarkAndCrlf) {
  EXPECT_EQ(words("\xEF\xBB\xBF"
                  "a\r\nb\r\n"),
            "a | b | ");
  EXPECT_EQ(run("\xEF\xBB\xBF"
                "a")
                .tokens[0]
                .span,
            (Span{1, 1, 1}));
}

TEST(Lexer, CountsColumnsInCharacters) {
  // Two bytes for each letter of the comment, three for the sign on the last line.
  const Result result = run("a # \xC3\xA4\xC3\xB6 \n\tb \xE2\x89\xA4 c");
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].span, (Span{2, 4, 1}));
  EXPECT_NE(result.diagnostics[0].message.find("'<='"), std::string::npos);
  EXPECT_EQ(result.tokens[2].span, (Span{2, 2, 1}));  // b
  EXPECT_EQ(result.tokens[4].span, (Span{2, 6, 1}));  // c
}

TEST(Lexer, OneReportALineForCharactersThatMeanNothing) {
  EXPECT_EQ(run("a @ b $ c").diagnostics.size(), 1U);
  EXPECT_EQ(run("a @ b\n$ c").diagnostics.size(), 2U);
  EXPECT_EQ(run("a == b").diagnostics.size(), 1U);
}

TEST(Lexer, RefusesBytesThatAreNoText) {
  const std::vector<std::string> bad{"a\n b\xFF",
                                     "a\n b\xC3",
                                     "a\n b\xC0\x80",
                                     "a\n b\xED\xA0\x80",
                                     "a\n b\xF4\x90\x80\x80",
                                     "a\n b\xE0\x80\x80",
                                     std::string("a\n b\0c", 6),
                                     "a\n b\x1B[0m",
                                     "a\n b\rc"};
  for (const std::string& text : bad) {
    const Result result = run(text);
    EXPECT_FALSE(result.is_text);
    ASSERT_EQ(result.diagnostics.size(), 1U);
    EXPECT_EQ(result.diagnostics[0].span, (Span{2, 3, 1}));
  }
  EXPECT_FALSE(run("# in a comment too \xFF").is_text);
}

TEST(Lexer, EveryCutOfAValidTextEndsWell) {
  const std::string text = "let \xC3\xA9 = 1.5e-3*(a' + b.c) # \xE2\x82\xAC\r\n{ [ ] } <= and";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const Result result = run(std::string_view(text).substr(0, size));
    ASSERT_FALSE(result.tokens.empty());
    EXPECT_EQ(result.tokens.back().kind, TokenKind::end);
  }
}

}  // namespace
}  // namespace spacetime::symbolic
