// A scene laid out anew at random: other spaces, line breaks and separators, the same tokens, comments and paragraphs.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "symbolic/lexer.h"

namespace spacetime::symbolic {

class Relayer {
 public:
  // With `comments`, also new comments where a line may end.
  Relayer(std::string_view text, std::uint32_t seed, bool comments) : random_(seed), new_comments_(comments) {
    std::vector<Diagnostic> diagnostics;
    lexed_ = lex(text, diagnostics);
    EXPECT_TRUE(diagnostics.empty());
  }

  std::string run() {
    while (lexed_.tokens[i_].kind != TokenKind::end) {
      if (is_separator(i_) && depth_ == 0)
        separate();
      else if (lexed_.tokens[i_].kind == TokenKind::line_end)
        ++i_;
      else
        put_token();
    }
    put_comments();
    return out_;
  }

 private:
  int roll(int faces) { return static_cast<int>(random_() % static_cast<std::uint32_t>(faces)); }
  bool is_separator(std::size_t i) const {
    return lexed_.tokens[i].kind == TokenKind::line_end || lexed_.tokens[i].kind == TokenKind::semicolon;
  }
  std::string spaces() { return std::string(static_cast<std::size_t>(roll(3)), roll(5) == 0 ? '\t' : ' '); }

  // Down to a line, keeping whether there is a paragraph in between.
  void go_to_line(int line) {
    if (line <= line_ || out_.empty()) return;
    out_ += '\n';
    if (line - line_ > 1) out_ += std::string(static_cast<std::size_t>(1 + roll(3)), '\n');
    out_ += spaces();
  }

  bool put_comments() {
    bool any = false;
    for (; comment_ < lexed_.comments.size() && lexed_.comments[comment_].before <= i_; ++comment_, any = true) {
      go_to_line(lexed_.comments[comment_].line);
      out_.append(spaces()).append(lexed_.comments[comment_].text);
      line_ = lexed_.comments[comment_].line;
    }
    return any;
  }

  void comment_anew() {
    if (!new_comments_ || roll(6) > 0) return;
    if (roll(2) == 0) out_ += '\n';
    out_ += spaces() + "# new " + std::to_string(roll(100)) + "\n";
  }

  void separate() {
    while (is_separator(i_)) ++i_;
    const bool ends = lexed_.tokens[i_].kind == TokenKind::end;
    const int next = lexed_.tokens[i_].span.line;
    const bool commented = put_comments();
    if (ends) {
      out_ += '\n';
    } else if (commented || next - line_ > 1) {
      go_to_line(std::max(next, line_ + 1));
    } else {
      static constexpr const char* separators[]{"\n", "; ", " ;\n", ";;\n", "\n  "};
      out_ += separators[roll(5)];
    }
    line_ = next;
    comment_anew();
  }

  void put_token() {
    const Token& token = lexed_.tokens[i_];
    if (put_comments()) out_ += '\n';
    const bool wordy = token.kind == TokenKind::name || token.kind == TokenKind::number || token.kind == TokenKind::dot;
    out_ += wordy && !out_.empty() ? " " + spaces() : spaces();
    if (token.kind == TokenKind::right_paren || token.kind == TokenKind::right_bracket) --depth_;
    if (token.kind == TokenKind::left_paren || token.kind == TokenKind::left_bracket) ++depth_;
    out_ += token.text;
    line_ = token.span.line;
    ++i_;
    const bool goes_on = is_operator(token) || token.kind == TokenKind::comma || token.kind == TokenKind::colon;
    if ((goes_on || depth_ > 0) && !commented_here()) {
      if (roll(8) == 0) out_ += "\n" + spaces();
      comment_anew();
    }
  }

  bool commented_here() const {
    return comment_ < lexed_.comments.size() && lexed_.comments[comment_].before <= i_ + 1;
  }

  std::mt19937 random_;
  bool new_comments_;
  Lexed lexed_;
  std::string out_;
  std::size_t i_ = 0, comment_ = 0;
  int depth_ = 0, line_ = 0;
};

inline std::string relaid(std::string_view text, std::uint32_t seed, bool comments = false) {
  return Relayer(text, seed, comments).run();
}

}  // namespace spacetime::symbolic
