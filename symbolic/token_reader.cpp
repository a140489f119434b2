#include "symbolic/token_reader.h"

#include <algorithm>

#include "symbolic/quoted.h"
#include "symbolic/vocabulary.h"

namespace spacetime::symbolic {

bool TokenReader::at_statement() const {
  const Token& token = peek();
  if (token.kind != TokenKind::name || !token.line_start) return false;
  if (!begins_statement(token.text)) return false;
  // The words are no reserved names: what follows tells a statement from a name that begins a continued line.
  switch (next().kind) {
    case TokenKind::name:
      return !is_operator(next());
    case TokenKind::number:
    case TokenKind::left_bracket:
      return true;
    case TokenKind::line_end:
    case TokenKind::semicolon:
    case TokenKind::end:
      return token.text == "solve" || token.text == "reset";
    default:
      return false;
  }
}

void TokenReader::skip_line_ends() {
  while (brackets_ > 0 && at(TokenKind::line_end)) ++i_;
}

const Token& TokenReader::take() {
  const Token& token = tokens_[i_];
  if (token.kind != TokenKind::end) ++i_;
  skip_line_ends();
  return token;
}

bool TokenReader::accept(TokenKind kind) {
  if (failed_ || !at(kind)) return false;
  take();
  return true;
}

bool TokenReader::accept_word(std::string_view word) {
  if (failed_ || !at_word(word)) return false;
  take();
  return true;
}

bool TokenReader::expect(TokenKind kind, std::string_view what) {
  if (accept(kind)) return true;
  fail(what);
  return false;
}

bool TokenReader::expect_word(std::string_view word) {
  if (accept_word(word)) return true;
  fail(quoted(word));
  return false;
}

Token TokenReader::open(TokenKind kind, std::string_view what) {
  const Token token = peek();
  if (!failed_ && at(kind)) {
    ++brackets_;
    take();
  } else {
    fail(what);
  }
  return token;
}

bool TokenReader::close(TokenKind kind, const Token& opened) {
  if (failed_) return false;
  if (at(kind)) {
    --brackets_;
    take();
    return true;
  }
  const std::string bracket = kind == TokenKind::right_paren ? "')'" : "']'";
  if (at(TokenKind::bad)) return fail(""), false;
  fail(peek().span, "expected ',' or " + bracket + ", found " + describe(peek()),
       {{opened.span, "to close this " + describe(opened)}});
  return false;
}

void TokenReader::fail(std::string_view expected) {
  if (at(TokenKind::bad))
    failed_ = true;  // reported by the lexer
  else
    fail(peek().span, "expected " + std::string(expected) + ", found " + describe(peek()));
}

void TokenReader::fail(Span span, std::string message, std::vector<Diagnostic::Note> notes) {
  if (!failed_) diagnostics_.push_back({span, std::move(message), std::move(notes)});
  failed_ = true;
}

bool TokenReader::skip_to(TokenKind kind) {
  for (std::size_t i = i_; i < tokens_.size(); ++i) {
    const TokenKind here = tokens_[i].kind;
    if (here == kind) return i_ = i, true;
    if (here == TokenKind::line_end || here == TokenKind::semicolon || here == TokenKind::end) return false;
  }
  return false;
}

bool TokenReader::skip_left_behind(std::span<const std::string_view> words) {
  constexpr std::size_t farthest = 200;  // tokens: more than a link is made of
  std::size_t i = i_;
  for (; tokens_[i].kind != TokenKind::right_brace; ++i)
    if (tokens_[i].kind == TokenKind::end || tokens_[i].kind == TokenKind::left_brace || i - i_ > farthest)
      return false;
  std::size_t behind = i + 1;
  while (tokens_[behind].kind == TokenKind::line_end || tokens_[behind].kind == TokenKind::semicolon) ++behind;
  const Token& next = tokens_[behind];
  const bool is_item = next.kind == TokenKind::name && std::ranges::find(words, next.text) != words.end();
  if (!is_item && next.kind != TokenKind::right_brace) return false;
  i_ = i + 1;
  return true;
}

void TokenReader::recover() {
  brackets_ = 0;
  failed_ = false;
  int depth = 0;  // of brackets of any kind opened while skipping
  for (; !at(TokenKind::end) && !at_statement(); ++i_) {
    switch (peek().kind) {
      case TokenKind::left_paren:
      case TokenKind::left_bracket:
      case TokenKind::left_brace:
        ++depth;
        break;
      case TokenKind::right_brace:
        if (depth == 0) return;
        [[fallthrough]];
      case TokenKind::right_paren:
      case TokenKind::right_bracket:
        depth = std::max(0, depth - 1);
        break;
      case TokenKind::line_end:
      case TokenKind::semicolon:
        if (depth == 0) return;
        break;
      default:
        break;
    }
  }
}

}  // namespace spacetime::symbolic
