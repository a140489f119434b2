#include "symbolic/complete.h"

#include <algorithm>
#include <array>

#include "symbolic/compile.h"
#include "symbolic/functions.h"
#include "symbolic/lexer.h"
#include "symbolic/visible.h"
#include "symbolic/vocabulary.h"

namespace spacetime::symbolic {
namespace {

using Kind = Completion::Kind;

// The text in front of the cursor; all of it where the place lies behind its end.
std::string_view before(std::string_view text, int line, int column) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::size_t at = 0;
  for (int i = 1; i < line && at < text.size(); ++i) at = std::min(text.find('\n', at), text.size() - 1) + 1;
  const auto follows = [&] { return (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U; };  // within a character
  for (int i = 1; i < column && at < text.size() && text[at] != '\n'; ++i)
    for (++at; at < text.size() && follows();) ++at;
  return text.substr(0, at);
}

// Where the cursor is: the unfinished statement or item, and the blocks around it.
struct Place {
  std::vector<Token> tokens;             // of the statement, the word at the cursor left out
  std::string prefix;                    // that word's letters in front of the cursor
  std::vector<std::string_view> blocks;  // first words of those open: creature, link, script
  std::size_t start = 0;                 // bytes of text in front of the statement
  int depth = 0;                         // of ( ) and [ ] open in it
  bool in_comment = false;
};

Place place_in(std::string_view text) {
  std::vector<Diagnostic> ignored;
  const Lexed lexed = lex(text, ignored);
  const auto offset = [&](std::string_view part) { return static_cast<std::size_t>(part.data() - text.data()); };
  Place out;
  const auto begin = [&](std::size_t at) { out.tokens.clear(), out.start = at, out.depth = 0; };
  for (const Token& token : lexed.tokens) {
    const std::size_t end = offset(token.text) + token.text.size();
    switch (token.kind) {
      case TokenKind::end:
        continue;
      case TokenKind::line_end:
        // The one the lexer puts at the end of all texts ends nothing here.
        if (out.depth == 0 && !token.text.empty()) begin(end);
        continue;
      case TokenKind::semicolon:
        if (out.depth == 0) begin(end);
        continue;
      case TokenKind::left_brace:
        out.blocks.push_back(out.tokens.empty() ? token.text : out.tokens.front().text);
        begin(end);
        continue;
      case TokenKind::right_brace:
        if (!out.blocks.empty()) out.blocks.pop_back();
        begin(end);
        continue;
      default:
        break;
    }
    // A bracket left open in an earlier line takes no statement along.
    if (token.line_start && out.depth > 0 && begins_statement(token.text)) begin(offset(token.text));
    if (token.kind == TokenKind::left_paren || token.kind == TokenKind::left_bracket) ++out.depth;
    if (token.kind == TokenKind::right_paren || token.kind == TokenKind::right_bracket)
      out.depth = std::max(0, out.depth - 1);
    out.tokens.push_back(token);
  }
  if (!lexed.comments.empty()) {
    const std::string_view last = lexed.comments.back().text;
    out.in_comment = text.substr(offset(last)).find('\n') == std::string_view::npos;
  }
  if (!out.tokens.empty() && out.tokens.back().kind == TokenKind::name && text.ends_with(out.tokens.back().text) &&
      offset(out.tokens.back().text) + out.tokens.back().text.size() == text.size()) {
    out.prefix = out.tokens.back().text;
    out.tokens.pop_back();
  }
  return out;
}

class Completer {
 public:
  explicit Completer(std::string_view text) : place_(place_in(text)) {
    std::string known(text.substr(0, place_.start));
    for (std::size_t i = 0; i < place_.blocks.size(); ++i) known += "\n}";
    visible_ = visible_names(known);
  }

  std::vector<Completion> run() {
    if (!place_.in_comment) offer();
    return std::move(out_);
  }

 private:
  bool last_is(TokenKind kind) const { return !place_.tokens.empty() && place_.tokens.back().kind == kind; }
  bool last_is(std::string_view word) const { return last_is(TokenKind::name) && place_.tokens.back().text == word; }
  bool has(std::string_view word) const {
    return std::ranges::any_of(place_.tokens, [&](const Token& token) { return token.text == word; });
  }

  void add(Kind kind, std::string label, std::string detail, std::string insert = {}) {
    if (!label.starts_with(place_.prefix)) return;
    if (insert.empty()) insert = label;
    out_.push_back({kind, std::move(label), std::move(detail), std::move(insert)});
  }

  void add_word(const Word& word) {
    add(Kind::keyword, std::string(word.word), std::string(word.usage) + " - " + std::string(word.meaning));
  }

  // Names of these kinds, dotted ones among them.
  void add_names(std::initializer_list<Kind> kinds) {
    for (const Visible& one : visible_)
      if (std::ranges::find(kinds, one.kind) != kinds.end())
        add(one.kind, one.name, one.declaration, one.kind == Kind::function ? one.name + "(" : one.name);
  }

  void offer() {
    if (last_is(TokenKind::dot)) return members();
    if (place_.tokens.empty()) return beginnings();
    const std::string_view owner = place_.tokens.front().text;
    if (place_.tokens.size() == 1) {
      if (is_one(owner, {"constant", "parameter", "dof", "let", "define", "creature", "script", "link", "point",
                         "revolute", "prismatic"}))
        return;  // a new name
      if (is_one(owner, {"enable", "disable", "delete", "weight", "replace"}))
        return add_names({Kind::constraint, Kind::term});
      if (owner == "scope") return add_names({Kind::constraint});
      if (owner == "set") return add_names({Kind::constant});
      if (is_one(owner, {"bound", "control", "eliminate"})) return add_names({Kind::dof});
    }
    if (lists_names()) return add_names({Kind::dof, Kind::creature});
    if (last_is("on")) return bodies(owner);
    if (last_is("method")) return clauses(owner, {"newton", "sqp92", "bfgs"});
    const bool ended = value_ended();
    if (place_.depth == 0) clauses(owner, {});
    if (!ended && takes_value(owner)) values(owner);
  }

  static bool is_one(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
  }

  // The members of what stands in front of the dot.
  void members() {
    std::string whole;  // "arm.elbow."
    for (std::size_t i = place_.tokens.size(); i-- > 0;) {
      const Token& token = place_.tokens[i];
      const bool dot = token.kind == TokenKind::dot, alternates = whole.empty() || dot != whole.starts_with('.');
      if ((!dot && token.kind != TokenKind::name) || !alternates) break;
      whole.insert(0, token.text);
    }
    const std::string name = whole.substr(0, whole.size() - 1);
    const auto found = std::ranges::find(visible_, name, &Visible::name);
    const Kind kind = found == visible_.end() ? Kind::let : found->kind;
    if (kind == Kind::creature) return creature_members(whole);
    if (kind == Kind::script) {
      add(Kind::member, "q", "rotation (w, x, y, z)");
      add(Kind::member, "omega", "angular velocity in world axes");
      add(Kind::member, "alpha", "angular acceleration in world axes");
    }
    if (kind == Kind::dof && name.find('.') != std::string::npos)
      add(Kind::member, "force", "the generalised force: what a motor must supply");
    if (kind == Kind::dof || kind == Kind::constant || kind == Kind::parameter) return;  // single numbers
    for (const char* component : {"x", "y", "z"}) add(Kind::member, component, "a component");
  }

  void creature_members(const std::string& whole) {
    for (const Visible& one : visible_)
      if (one.name.starts_with(whole)) add(one.kind, one.name.substr(whole.size()), one.declaration);
    add(Kind::member, "q", "all degrees of freedom, in order");
    add(Kind::member, "force", "generalised forces: what motors must supply");
    add(Kind::member, "com", "centre of mass");
    add(Kind::member, "kinetic", "kinetic energy");
    add(Kind::member, "potential", "potential energy");
  }

  void beginnings() {
    const bool inside = !place_.blocks.empty();
    for (const Word& word : vocabulary())
      if (inside ? word.kind == Word::Kind::item && word.of == place_.blocks.back()
                 : word.kind == Word::Kind::declaration || word.kind == Word::Kind::action)
        add_word(word);
  }

  // Inside "of arm, x" and "for x".
  bool lists_names() const {
    std::size_t i = place_.tokens.size();
    if (i == 0 || place_.depth > 0) return false;
    if (!last_is(TokenKind::comma) && !last_is("of") && !last_is("for")) return false;
    for (; i-- > 1;) {
      const Token& token = place_.tokens[i];
      if (token.text == "of" || token.text == "for") return true;
      if (token.kind != TokenKind::name && token.kind != TokenKind::dot && token.kind != TokenKind::comma) return false;
    }
    return false;
  }

  // Links or points of the creature this is in, without its name.
  void bodies(std::string_view owner) {
    const Kind kind = owner == "force" ? Kind::point : Kind::link;
    const auto creature =
        std::find_if(visible_.rbegin(), visible_.rend(), [](const Visible& one) { return one.kind == Kind::creature; });
    if (creature == visible_.rend()) return;
    for (const Visible& one : visible_)
      if (one.kind == kind && one.name.starts_with(creature->name + "."))
        add(kind, one.name.substr(creature->name.size() + 1), one.declaration);
    if (owner == "link") clauses(owner, {"ground"});
  }

  // Whether what stands in front of the cursor is a whole value, so that an operator or a clause could follow.
  bool value_ended() const {
    const Token& last = place_.tokens.back();
    switch (last.kind) {
      case TokenKind::number:
      case TokenKind::prime:
      case TokenKind::right_paren:
      case TokenKind::right_bracket:
        return true;
      case TokenKind::name:
        return place_.tokens.size() > 1 && !is_operator(last) && !is_clause(last.text);
      default:
        return false;
    }
  }

  bool is_clause(std::string_view text) const {
    return std::ranges::any_of(vocabulary(), [&](const Word& word) {
      return word.kind == Word::Kind::clause && word.word == text && belongs_to(word, place_.tokens.front().text);
    });
  }

  // Words that can go on with the statement: those asked for, or, where nothing else must come first, all that fit.
  void clauses(std::string_view owner, std::initializer_list<std::string_view> asked) {
    const bool begun = place_.tokens.size() == 1;
    if (asked.size() == 0 && !begun && !value_ended() && !is_clause(place_.tokens.back().text)) return;
    for (const Word& word : vocabulary()) {
      if (word.kind != Word::Kind::clause || !belongs_to(word, owner)) continue;
      if (asked.size() > 0 ? is_one(word.word, asked) : fits(owner, word.word, begun)) add_word(word);
    }
  }

  bool fits(std::string_view owner, std::string_view word, bool begun) const {
    if (has(word) || is_one(word, {"newton", "sqp92", "bfgs", "ground"})) return false;
    if (word == "inf") return last_is("weight") || (owner == "weight" && last_is(TokenKind::equal));
    if (word == "every" || word == "count") return has("over") && !has("every") && !has("count");
    if (word == "cg") return last_is("linear");
    if (word == "linear") return last_is("sqp92");
    if (word == "spans" || word == "level") return last_is(word == "spans" ? "bspline" : "wavelet") || owner == "lock";
    if (word == "bspline" || word == "wavelet" || word == "all" || word == "auto") return begun;
    if (word == "at" || word == "over") return !has("at") && !has("over") && (value_ended() || owner == "scope");
    if (is_one(owner, {"constrain", "minimize", "replace"})) return value_ended();
    if (owner == "trajectory" && word == "knots") return last_is("bspline");
    return begun || value_ended();
  }

  // Whether an expression can stand here, and not only words.
  bool takes_value(std::string_view owner) const {
    if (place_.depth > 0 || place_.tokens.size() > 1) return !last_is("over") && !last_is("bspline");
    return is_one(owner, {"constrain", "minimize", "keyframe", "key", "iterate", "damp"}) || !begins_statement(owner);
  }

  void values(std::string_view owner) {
    if (owner == "define")
      for (std::size_t i = 2; i + 1 < place_.tokens.size() && place_.tokens[i].kind != TokenKind::equal; ++i)
        if (place_.tokens[i].kind == TokenKind::name)
          add(Kind::argument, std::string(place_.tokens[i].text), "an argument of this function");
    for (const Visible& one : visible_) {
      if (one.kind == Kind::constraint || one.kind == Kind::term) continue;
      if (one.name.find('.') != std::string::npos && place_.prefix.empty()) continue;  // behind their creature's dot
      add(one.kind, one.name, one.declaration, one.kind == Kind::function ? one.name + "(" : one.name);
    }
    for (const std::string& name : function_names())
      add(Kind::function, name, std::string(function_named(name)->usage), name + "(");
    add(Kind::constant, "pi", "3.14159..., exact");
    add(Kind::constant, "e", "2.71828...");
    add(Kind::constant, "t", "the time, in seconds");
  }

  Place place_;
  std::vector<Visible> visible_;
  std::vector<Completion> out_;
};

}  // namespace

std::string_view name_of(Completion::Kind kind) {
  static constexpr std::array<std::string_view, 14> names{"keyword", "function", "constant",   "parameter", "dof",
                                                          "let",     "argument", "creature",   "script",    "link",
                                                          "point",   "member",   "constraint", "term"};
  return names.at(static_cast<std::size_t>(kind));
}

std::vector<Completion> complete(std::string_view text, int line, int column) {
  if (text.size() > largest_scene) return {};
  return Completer(before(text, line, column)).run();
}

std::optional<Completion> describe(std::string_view text, int line, int column) {
  if (text.size() > largest_scene) return std::nullopt;
  std::vector<Diagnostic> ignored;
  for (const Token& token : lex(text, ignored).tokens) {
    const Span& span = token.span;
    if (token.kind != TokenKind::name || span.line != line || column < span.column ||
        column > span.column + span.length)
      continue;
    for (Completion& one : complete(text, line, span.column + span.length))
      if (one.label == token.text) return std::move(one);
  }
  return std::nullopt;
}

}  // namespace spacetime::symbolic
