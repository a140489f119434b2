// Scene text to tokens.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/diagnostic.h"

namespace spacetime::symbolic {

enum class TokenKind : std::uint8_t {
  end,
  line_end,
  semicolon,
  number,
  name,
  plus,
  minus,
  star,
  slash,
  caret,
  prime,
  dot,
  comma,
  colon,
  left_paren,
  right_paren,
  left_bracket,
  right_bracket,
  left_brace,
  right_brace,
  equal,
  less,
  less_equal,
  greater,
  greater_equal,
  bad,  // something that has been reported
};

struct Token {
  TokenKind kind = TokenKind::end;
  Span span;
  std::string_view text;  // of the scene
  double number = 0;
  bool line_start = false;  // the first token on its line
};

struct Comment {
  std::string_view text;   // of the scene, from its '#' on, without the spaces at its end
  int line = 0;            // as a span's
  std::size_t before = 0;  // the token that follows it
};

// Whether an expression must go on after such a token: binary operators, `=`, relations, the words and, or, not.
bool is_operator(const Token& token);

// The tokens of `text`, closed by an `end` token, and its comments.  Spaces are gone; line ends stand as tokens, except
// after an operator, a comma or a colon and where nothing but comments stood on the line.  A byte-order mark and CRLF
// are tolerated.  What is no text (invalid UTF-8, control characters) ends the list at once with one diagnostic and
// `is_text` false; other characters that mean nothing become `bad` tokens, with one diagnostic a line.
// The tokens point into `text`.
struct Lexed {
  std::vector<Token> tokens;
  std::vector<Comment> comments;
  bool is_text = true;
};
Lexed lex(std::string_view text, std::vector<Diagnostic>& diagnostics);

// How messages speak of a token: "'foo'", "the end of the line".
std::string describe(const Token& token);

}  // namespace spacetime::symbolic
