// Reading tokens one after another, with one report a statement: after the first mistake everything answers quietly
// until the statement loop has found the next place to go on from.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "symbolic/lexer.h"

namespace spacetime::symbolic {

class TokenReader {
 public:
  TokenReader(std::vector<Token> tokens, std::vector<Diagnostic>& diagnostics)
      : tokens_(std::move(tokens)), diagnostics_(diagnostics) {}

  const Token& peek() const { return tokens_[i_]; }
  const Token& next() const { return tokens_[i_ + 1 < tokens_.size() ? i_ + 1 : i_]; }
  const Token& previous() const { return tokens_[i_ > 0 ? i_ - 1 : 0]; }
  bool at(TokenKind kind) const { return peek().kind == kind; }
  bool at_word(std::string_view word) const { return at(TokenKind::name) && peek().text == word; }
  bool at_separator() const { return at(TokenKind::line_end) || at(TokenKind::semicolon) || at(TokenKind::end); }
  // Whether the token here is the first of its line and looks like the beginning of a statement.
  bool at_statement() const;

  const Token& take();
  bool accept(TokenKind kind);
  bool accept_word(std::string_view word);

  // Takes what must stand here, or fails with "expected `what`, found ...".
  bool expect(TokenKind kind, std::string_view what);
  bool expect_word(std::string_view word);

  // Brackets, inside which line ends do not count.  `close` fails with a note at the opening one.
  Token open(TokenKind kind, std::string_view what);
  bool close(TokenKind kind, const Token& opened);

  bool failed() const { return failed_; }
  void fail(std::string_view expected);  // "expected ..., found ..." here
  void fail(Span span, std::string message, std::vector<Diagnostic::Note> notes = {});

  void give_up() { failed_ = true; }  // fails without a report
  void go_on() { failed_ = false; }   // after a report that costs nothing that follows

  // On to the next token of this kind in the same statement's line; false, and nothing done, where there is none.
  bool skip_to(TokenKind kind);

  // Where a `}` came too early, what it left behind stands here: on behind the `}` that was to come, if that is near
  // and one of `words` or another `}` follows it; else false, and nothing done.
  bool skip_left_behind(std::span<const std::string_view> words);

  // After a mistake: on to the next separator outside brackets, to the `}` of the block this is in, or to the
  // beginning of a statement, and ready to report again.
  void recover();

 private:
  void skip_line_ends();

  std::vector<Token> tokens_;
  std::vector<Diagnostic>& diagnostics_;
  std::size_t i_ = 0;
  int brackets_ = 0;
  bool failed_ = false;
};

}  // namespace spacetime::symbolic
