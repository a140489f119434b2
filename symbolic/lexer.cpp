#include "symbolic/lexer.h"

#include <charconv>
#include <cstdio>

#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// The bytes of the UTF-8 character at `i`; 0 where there is none (overlong forms and surrogates count as none).
std::size_t character_size(std::string_view text, std::size_t i) {
  auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned lead = byte(i);
  const std::size_t size = lead < 0x80                   ? 1
                           : lead >= 0xC2 && lead < 0xE0 ? 2
                           : lead >= 0xE0 && lead < 0xF0 ? 3
                           : lead >= 0xF0 && lead < 0xF5 ? 4
                                                         : 0;
  for (std::size_t k = 1; k < size; ++k)
    if ((byte(i + k) & 0xC0U) != 0x80U) return 0;
  const unsigned second = byte(i + 1);
  if (lead == 0xE0 && second < 0xA0) return 0;
  if (lead == 0xED && second >= 0xA0) return 0;
  if (lead == 0xF0 && second < 0x90) return 0;
  if (lead == 0xF4 && second >= 0x90) return 0;
  return size;
}

std::string advice(std::string_view character) {
  if (character == "!") return "'!' means nothing here; write 'not' for a negation";
  if (character == "&") return "'&' means nothing here; write 'and'";
  if (character == "|") return "'|' means nothing here; write 'or', or abs( ) for a magnitude";
  if (character == "?") return "'?' means nothing here; write if(condition, a, b)";
  if (character == "%") return "'%' means nothing here; write a percentage as a number, such as 0.05";
  if (character == "\"") return "texts in quotation marks are not part of the language; names stand without them";
  if (character == "\xE2\x89\xA4") return "write '<=' in place of this character";
  if (character == "\xE2\x89\xA5") return "write '>=' in place of this character";
  if (character == "\xCF\x80") return "write 'pi' in place of this character";
  if (character == "\xC2\xB2") return "write '^2' in place of this character";
  if (character == "\xC2\xB3") return "write '^3' in place of this character";
  if (character == "\xC2\xB7" || character == "\xC3\x97") return "write '*' in place of this character";
  if (character == "\xC2\xB0") return "angles are in radians; deg(30) converts";
  if (character == "\xE2\x88\x92") return "write '-' in place of this character";
  if (character == "\xE2\x80\x99" || character == "\xE2\x80\xB2") return "write ' in place of this character";
  return "the character " + quoted(character) +
         " means nothing here; names are made of the letters a-z and A-Z, digits and '_'";
}

class Lexer {
 public:
  Lexer(std::string_view text, std::vector<Diagnostic>& diagnostics) : text_(text), diagnostics_(diagnostics) {}

  Lexed run() {
    if (text_.starts_with("\xEF\xBB\xBF")) i_ = 3;
    while (out_.is_text && i_ < text_.size()) step();
    line_end(0);
    end();
    return std::move(out_);
  }

 private:
  char at(std::size_t ahead) const { return i_ + ahead < text_.size() ? text_[i_ + ahead] : '\0'; }

  Span here(std::size_t characters) const { return {line_, column_, static_cast<int>(characters ? characters : 1)}; }

  void push(TokenKind kind, std::size_t size) {
    out_.tokens.push_back({kind, here(size), text_.substr(i_, size), 0, line_start_});
    line_start_ = false;
    advance(size);
  }

  void advance(std::size_t bytes) { i_ += bytes, column_ += static_cast<int>(bytes); }

  void line_end(std::size_t size) {
    const bool silent = out_.tokens.empty() || is_operator(out_.tokens.back()) ||
                        out_.tokens.back().kind == TokenKind::comma || out_.tokens.back().kind == TokenKind::colon ||
                        out_.tokens.back().kind == TokenKind::line_end;
    if (!silent)
      push(TokenKind::line_end, size);
    else
      advance(size);
    ++line_, column_ = 1, line_start_ = true, bad_on_line_ = false;
  }

  // Right behind the last word: that is where something is missing, however many empty lines follow.
  void end() {
    push(TokenKind::end, 0);
    const auto before = [&](std::size_t back) -> const Token& { return out_.tokens[out_.tokens.size() - back]; };
    std::size_t back = 2;
    while (back <= out_.tokens.size() && before(back).kind == TokenKind::line_end) ++back;
    if (back > out_.tokens.size()) return;
    const Span last = before(back).span;
    out_.tokens.back().span = {last.line, last.column + last.length, 1};
  }

  void not_text(const std::string& message) {
    diagnostics_.push_back({here(1), message, {}});
    out_.is_text = false;
  }

  void step() {
    const char c = at(0);
    if (c == '\n') return line_end(1);
    if (c == '\r' && at(1) == '\n') return line_end(2);
    if (c == ' ' || c == '\t') return advance(1);
    if (c == '#') return comment();
    if (is_letter(c)) return word();
    if (is_digit(c) || (c == '.' && is_digit(at(1)))) return number();
    if (c == '/' && (at(1) == '/' || at(1) == '*')) {
      two("'" + std::string(text_.substr(i_, 2)) + "' means nothing here; a comment begins with '#'");
      return comment();
    }
    const auto [kind, size] = punctuation();
    if (kind != TokenKind::bad) return push(kind, size);
    other();
  }

  void comment() {
    const std::size_t start = i_;
    while (i_ < text_.size() && at(0) != '\n' && !(at(0) == '\r' && at(1) == '\n')) {
      const std::size_t size = checked_size();
      if (size == 0) return;
      i_ += size, ++column_;
    }
    std::string_view text = text_.substr(start, i_ - start);
    text = text.substr(0, text.find_last_not_of(" \t") + 1);
    out_.comments.push_back({text, line_, out_.tokens.size()});
  }

  // The size of the character here, or 0 after saying that it is none.
  std::size_t checked_size() {
    const std::size_t size = character_size(text_, i_);
    const auto byte = static_cast<unsigned char>(at(0));
    char code[8];
    std::snprintf(code, sizeof code, "%02X", byte);
    if (size == 0)
      not_text(std::string("the byte 0x") + code + " is not valid UTF-8: a scene is plain text in UTF-8");
    else if (byte == '\r')
      not_text("a carriage return without a line feed: end lines with LF or CRLF");
    else if ((byte < 0x20 && byte != '\t') || byte == 0x7F)
      not_text(std::string("the control character U+00") + code + ": a scene is plain text");
    else
      return size;
    return 0;
  }

  void word() {
    std::size_t size = 1;
    while (is_letter(at(size)) || is_digit(at(size))) ++size;
    push(TokenKind::name, size);
  }

  // Decimal forms as in C++: 2, 2., .5, 1e-3.
  void number() {
    std::size_t size = 0;
    while (is_digit(at(size))) ++size;
    if (at(size) == '.') {
      ++size;
      while (is_digit(at(size))) ++size;
    }
    if (at(size) == 'e' || at(size) == 'E') {
      const std::size_t sign = at(size + 1) == '+' || at(size + 1) == '-' ? 1 : 0;
      if (is_digit(at(size + 1 + sign))) {
        size += 2 + sign;
        while (is_digit(at(size))) ++size;
      }
    }
    if (is_letter(at(size)) || at(size) == '.') return run_on(size);
    double value = 0;
    const auto result = std::from_chars(text_.data() + i_, text_.data() + i_ + size, value);
    if (result.ec != std::errc{}) {
      report(here(size), "the number " + std::string(text_.substr(i_, size)) + " is outside the range of numbers");
      return push(TokenKind::bad, size);
    }
    push(TokenKind::number, size);
    out_.tokens.back().number = value;
  }

  void run_on(std::size_t size) {
    const std::string digits(text_.substr(i_, size));
    std::size_t more = size;
    while (is_letter(at(more)) || is_digit(at(more)) || at(more) == '.') ++more;
    const std::string rest(text_.substr(i_ + size, more - size));
    report(here(more), is_letter(rest[0]) && rest[0] != 'e' && rest[0] != 'E'
                           ? "a number runs into a name: write " + digits + "*" + rest + " for a product"
                           : quoted(digits + rest) + " is not a number: write it as 2, 2.5, .5 or 1e-3");
    push(TokenKind::bad, more);
  }

  std::pair<TokenKind, std::size_t> punctuation() const {
    const bool then_equal = at(1) == '=';
    switch (at(0)) {
      case ';':
        return {TokenKind::semicolon, 1};
      case '+':
        return {TokenKind::plus, 1};
      case '-':
        return {TokenKind::minus, 1};
      case '*':
        return {at(1) == '*' ? TokenKind::bad : TokenKind::star, 1};
      case '/':
        return {TokenKind::slash, 1};
      case '^':
        return {TokenKind::caret, 1};
      case '\'':
        return {TokenKind::prime, 1};
      case '.':
        return {TokenKind::dot, 1};
      case ',':
        return {TokenKind::comma, 1};
      case ':':
        return {TokenKind::colon, 1};
      case '(':
        return {TokenKind::left_paren, 1};
      case ')':
        return {TokenKind::right_paren, 1};
      case '[':
        return {TokenKind::left_bracket, 1};
      case ']':
        return {TokenKind::right_bracket, 1};
      case '{':
        return {TokenKind::left_brace, 1};
      case '}':
        return {TokenKind::right_brace, 1};
      case '=':
        return {then_equal ? TokenKind::bad : TokenKind::equal, 1};
      case '<':
        return {then_equal ? TokenKind::less_equal : TokenKind::less, then_equal ? 2U : 1U};
      case '>':
        return {then_equal ? TokenKind::greater_equal : TokenKind::greater, then_equal ? 2U : 1U};
      default:
        return {TokenKind::bad, 0};
    }
  }

  void other() {
    if (text_.substr(i_).starts_with("==")) return two("'==' means nothing here; write a single '='");
    if (text_.substr(i_).starts_with("!=")) return two("'!=' means nothing here; relations are made with = <= >=");
    if (text_.substr(i_).starts_with("**")) return two("'**' means nothing here; write '^' for a power");
    const std::size_t size = checked_size();
    if (size == 0) return;
    report(here(1), advice(text_.substr(i_, size)));
    push(TokenKind::bad, size);
    column_ -= static_cast<int>(size) - 1;
    out_.tokens.back().span.length = 1;
  }

  void two(const std::string& message) {
    report(here(2), message);
    push(TokenKind::bad, 2);
  }

  void report(Span span, std::string message) {
    if (!bad_on_line_) diagnostics_.push_back({span, std::move(message), {}});
    bad_on_line_ = true;
  }

  std::string_view text_;
  std::vector<Diagnostic>& diagnostics_;
  Lexed out_;
  std::size_t i_ = 0;
  int line_ = 1, column_ = 1;
  bool line_start_ = true, bad_on_line_ = false;
};

}  // namespace

bool is_operator(const Token& token) {
  switch (token.kind) {
    case TokenKind::plus:
    case TokenKind::minus:
    case TokenKind::star:
    case TokenKind::slash:
    case TokenKind::caret:
    case TokenKind::equal:
    case TokenKind::less:
    case TokenKind::less_equal:
    case TokenKind::greater:
    case TokenKind::greater_equal:
      return true;
    case TokenKind::name:
      return token.text == "and" || token.text == "or" || token.text == "not";
    default:
      return false;
  }
}

Lexed lex(std::string_view text, std::vector<Diagnostic>& diagnostics) { return Lexer(text, diagnostics).run(); }

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::end:
      return "the end of the text";
    case TokenKind::line_end:
      return "the end of the line";
    default:
      return quoted(token.text);
  }
}

}  // namespace spacetime::symbolic
