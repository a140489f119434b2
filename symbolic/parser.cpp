#include "symbolic/parser.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "common/nearest.h"
#include "symbolic/parse_statement.h"
#include "symbolic/quoted.h"
#include "symbolic/vocabulary.h"

namespace spacetime::symbolic {
namespace {

void unknown_statement(Parsing& p, const Token& word) {
  if (word.kind == TokenKind::bad) return p.in.give_up();  // reported by the lexer
  if (word.kind != TokenKind::name)
    return p.in.fail(word.span, "expected a statement such as 'dof', 'constrain' or 'solve', found " + describe(word));
  if (p.in.peek().kind == TokenKind::equal)
    return p.in.fail(word.span, "a statement begins with what it is: write 'constant " + std::string(word.text) +
                                    " = ...', 'let ...' or 'dof ...'");
  const auto is_clause = [&](const Word& known) { return known.kind == Word::Kind::clause && known.word == word.text; };
  if (std::ranges::any_of(vocabulary(), is_clause))
    return p.in.fail(word.span,
                     quoted(word.text) + " does not begin a statement: write it on the line of the one it belongs to");
  std::vector<std::string> words;
  for (const Word& known : vocabulary())
    if (begins_statement(known.word)) words.emplace_back(known.word);
  p.in.fail(word.span, "there is no statement " + quoted(word.text) +
                           suggestion(word.text, words, "begin with a word such as 'dof', 'constrain' or 'solve'"));
}

// What stands behind a whole statement on its line.
void refuse_rest(Parsing& p) {
  const Token& found = p.in.peek();
  if (found.kind == TokenKind::bad) return p.in.fail("");
  std::string advice = "begin a new line, or write ';'";
  if (found.kind == TokenKind::comma)
    advice = "decimals have a point, a tuple stands in ( ), and each declaration has a line of its own";
  else if (found.kind == TokenKind::name || found.kind == TokenKind::number || found.kind == TokenKind::left_paren)
    advice = "a product needs '*', an argument ( ), a new statement a new line or ';'";
  else if (found.kind == TokenKind::right_paren || found.kind == TokenKind::right_bracket)
    advice = "it closes nothing, take it away";
  p.in.fail(found.span, "expected the end of the statement, found " + describe(found) + ": " + advice);
}

// What a statement would declare if it turns out to be damaged: the word behind the first, where that says so or is
// misspelt in front of '=' or '{'.
std::optional<Name> declared_name(const Parsing& p, const Token& word) {
  static constexpr std::array<std::string_view, 7> declaring{"constant", "parameter", "dof",   "let",
                                                             "define",   "creature",  "script"};
  if (!p.in.at(TokenKind::name)) return std::nullopt;
  const bool declares = std::find(declaring.begin(), declaring.end(), word.text) != declaring.end();
  const bool misspelt = p.in.next().kind == TokenKind::equal || p.in.next().kind == TokenKind::left_brace;
  if (!declares && (declaration_parser(word.text) || action_parser(word.text) || !misspelt)) return std::nullopt;
  return Name{std::string(p.in.peek().text), p.in.peek().span};
}

// "goal" in `constrain goal: ...`.
std::optional<Name> label(const Parsing& p, const Token& word) {
  if (action_parser(word.text) || !p.in.at(TokenKind::name) || p.in.next().kind != TokenKind::colon)
    return std::nullopt;
  return Name{std::string(p.in.peek().text), p.in.peek().span};
}

Statement parse_statement(Parsing& p) {
  const Token word = p.in.take();
  Statement out;
  out.span = word.span;
  out.word = word.text;
  const std::optional<Name> declared = declared_name(p, word), named = label(p, word);
  StatementParser parser = word.kind == TokenKind::name ? declaration_parser(word.text) : nullptr;
  if (!parser && word.kind == TokenKind::name) parser = action_parser(word.text);
  if (parser)
    out.what = parser(p);
  else
    unknown_statement(p, word);
  if (!p.in.failed() && !p.in.at_separator()) refuse_rest(p);
  if (p.in.failed()) out.what = Damaged{declared, named};
  return out;
}

}  // namespace

bool refuse_leading_operator(Parsing& p) {
  const Token& token = p.in.peek();
  if (!is_operator(token)) return false;
  p.in.fail(token.span, token.line_start ? "a line cannot begin with " + describe(token) +
                                               ": put it at the end of the line before, so that that line goes on"
                                         : "a statement cannot begin with " + describe(token));
  return true;
}

bool parse_braces(Parsing& p, std::string_view owner, void (*item)(Parsing&, void*), void* target,
                  std::span<const std::string_view> outer) {
  const Token opened = p.in.peek();
  if (p.in.failed()) return true;
  bool damaged = false;
  if (!p.in.accept(TokenKind::left_brace)) {
    p.in.fail("'{'");
    p.in.go_on();  // from where it stands on this line, or as if it stood here
    if (p.in.skip_to(TokenKind::left_brace)) p.in.take();
    damaged = true;
  }
  while (true) {
    while (p.in.accept(TokenKind::line_end) || p.in.accept(TokenKind::semicolon)) continue;
    if (p.in.accept(TokenKind::right_brace)) return damaged;
    const bool lost = p.in.at(TokenKind::end) || p.in.at_statement();
    const bool left = p.in.at(TokenKind::name) && p.in.peek().line_start &&
                      std::find(outer.begin(), outer.end(), p.in.peek().text) != outer.end();
    if (lost || left) {
      if (opened.kind == TokenKind::left_brace)
        p.in.fail(p.in.peek().span,
                  "expected '}' to close " + quoted(std::string(owner) + " {") + ", found " + describe(p.in.peek()),
                  {{opened.span, "it is opened here"}});
      if (left)
        p.in.go_on();
      else
        p.in.give_up();
      return true;
    }
    if (!refuse_leading_operator(p)) item(p, target);
    const bool ended = p.in.at_separator() || p.in.at(TokenKind::right_brace) || p.in.peek().line_start;
    if (!p.in.failed() && !ended) p.in.fail("the end of the item (a line end, ';' or '}')");
    if (!p.in.failed()) continue;
    damaged = true;
    p.in.recover();
    if (p.in.at(TokenKind::end) || p.in.at_statement()) {  // what is lost takes the closing brace along
      p.in.give_up();
      return true;
    }
  }
}

namespace {
// Items of a creature that stand outside one: a '}' came too early.  The first of a row is reported.
bool at_stray_item(const Parsing& p) {
  const std::string_view word = p.in.peek().text;
  return p.in.at(TokenKind::name) && (p.in.next().kind == TokenKind::name || word == "gravity") &&
         std::find(creature_words.begin(), creature_words.end(), word) != creature_words.end();
}
}  // namespace

Scene parse(std::string_view text, std::vector<Diagnostic>& diagnostics) {
  Scene scene;
  Lexed lexed = lex(text, diagnostics);
  if (!lexed.is_text) return scene;
  Parsing p{TokenReader(std::move(lexed.tokens), diagnostics), scene};
  bool straying = false;
  while (true) {
    while (p.in.accept(TokenKind::line_end) || p.in.accept(TokenKind::semicolon)) continue;
    if (p.in.at(TokenKind::end)) return scene;
    const char* first = p.in.peek().text.data();
    const std::size_t statements = scene.statements.size();
    if (at_stray_item(p)) {
      if (!straying)
        p.in.fail(p.in.peek().span,
                  quoted(p.in.peek().text) + " can stand only inside 'creature { }': is a '}' too early?");
      p.in.give_up();
      straying = true;
      for (Statement& statement : scene.statements)
        if (auto* creature = std::get_if<CreatureDeclaration>(&statement.what)) creature->damaged = true;
    } else if (straying && p.in.accept(TokenKind::right_brace)) {
      straying = false;
    } else if (refuse_leading_operator(p)) {
      p.in.take();
    } else {
      scene.statements.push_back(parse_statement(p));
    }
    if (p.in.failed()) {
      p.in.recover();
      if (p.in.at(TokenKind::right_brace)) {  // the end of a block that has been given up
        p.in.take();
        straying = false;
      }
    }
    if (scene.statements.size() == statements) continue;
    const std::string_view last = p.in.previous().text;
    Statement& statement = scene.statements.back();
    statement.begin = static_cast<std::size_t>(first - text.data());
    statement.end = static_cast<std::size_t>(last.data() + last.size() - text.data());
    // What was given up may have ended with line ends.
    while (statement.end > statement.begin && std::isspace(static_cast<unsigned char>(text[statement.end - 1])))
      --statement.end;
  }
}

}  // namespace spacetime::symbolic
