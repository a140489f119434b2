// The words of the language are those the parser takes, and those the editors' grammar knows.
#include "symbolic/vocabulary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "symbolic/functions.h"
#include "symbolic/parse_statement.h"
#include "symbolic/parser.h"
#include "symbolic/spacing.h"
#include "tests/symbolic/scene_texts.h"
#include "tests/symbolic/textmate.h"

namespace spacetime::symbolic {
namespace {

using Words = std::set<std::string>;
using Kind = Word::Kind;

Words words(std::initializer_list<Kind> kinds) {
  Words out;
  for (const Word& word : vocabulary())
    if (std::ranges::find(kinds, word.kind) != kinds.end()) out.emplace(word.word);
  return out;
}

Words found(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  Words out;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) out.insert((*i)[1]);
  return out;
}

// Words between | in a pattern of the grammar.
Words alternatives(const std::string& pattern) { return found(pattern, "\\b([a-z][a-z0-9]+|a|d)\\b"); }

nlohmann::json grammar() { return nlohmann::json::parse(file_text("symbolic/editor/spacetime.tmLanguage.json")); }

TEST(Vocabulary, IsWhatTheParserTakes) {
  std::string parser;
  for (const char* part : {"declaration", "creature", "script", "action"})
    parser += file_text(std::string("symbolic/parse_") + part + ".cpp");
  EXPECT_EQ(found(parser, R"re(\{"(\w+)", parse_)re"), words({Kind::declaration, Kind::action}));
  Words taken = found(parser, R"re(_word\("(\w+)"\))re");
  taken.merge(found(parser, R"re(option\(p, "(\w+)")re"));
  taken.merge(found(parser, R"re(\{"(\w+)", Kind::)re"));
  for (const char* method : {"newton", "sqp92", "bfgs", "ground"}) taken.emplace(method);  // read as names
  EXPECT_EQ(taken, words({Kind::item, Kind::clause}));
  for (const Word& word : vocabulary()) {
    const bool statement = word.kind == Kind::declaration || word.kind == Kind::action;
    EXPECT_EQ(statement, word.of.empty()) << word.word;
    EXPECT_TRUE(word.usage.starts_with(word.word)) << word.word;
    EXPECT_EQ(begins_statement(word.word), declaration_parser(word.word) || action_parser(word.word)) << word.word;
  }
}

TEST(Vocabulary, OwnersAreStatementsAndItems) {
  const Words owners = words({Kind::declaration, Kind::action, Kind::item});
  for (const Word& word : vocabulary())
    for (const std::string& owner : found(std::string(word.of), "(\\w+)")) {
      EXPECT_TRUE(owners.contains(owner)) << word.word << " of " << owner;
      EXPECT_TRUE(belongs_to(word, owner));
    }
  EXPECT_FALSE(belongs_to(vocabulary().front(), "dof"));
}

TEST(Grammar, KnowsTheWordsOfTheLanguage) {
  const nlohmann::json all = grammar(), rules = all.at("repository");
  EXPECT_EQ(alternatives(rules.at("statement").at("match").get<std::string>()),
            words({Kind::declaration, Kind::action}));
  const auto items = [](std::string_view owner) {
    Words out;
    for (const Word& word : vocabulary())
      if (word.kind == Kind::item && word.of == owner) out.emplace(word.word);
    return out;
  };
  for (const std::string owner : {"creature", "link", "script"}) {
    const std::string rule = owner + "-item";
    EXPECT_EQ(alternatives(rules.at(rule).at("match").get<std::string>()), items(owner));
  }
  const Words grammars = found(std::regex_replace(all.dump(), std::regex(R"(\\\\b)"), " "), "\\b([a-z][a-z0-9]*)\\b");
  for (const Word& word : vocabulary()) EXPECT_TRUE(grammars.contains(std::string(word.word))) << word.word;
  Words functions;
  for (const std::string& name : function_names()) functions.insert(name);
  EXPECT_EQ(alternatives(rules.at("function").at("match").get<std::string>()), functions);
}

// What a token should be called, from the tree and the vocabulary; empty where the grammar may choose.
std::string expected(const std::vector<Piece>& pieces, std::size_t i, std::size_t first) {
  const Piece& piece = pieces[i];
  const std::string text(piece.token.text);
  if (piece.token.kind == TokenKind::number) return "constant.numeric";
  if (is_operator(piece.token) || piece.token.kind == TokenKind::prime) return "keyword.operator";
  if (piece.token.kind != TokenKind::name) return "punctuation";
  if (i == first && begins_statement(text)) return action_parser(text) ? "keyword.control" : "keyword.declaration";
  if (piece.role == Role::call && function_named(text)) return "support.function";
  if (piece.role == Role::operand) return text == "pi" || text == "e" || text == "t" ? "constant.language" : "variable";
  if (piece.role == Role::clause) return "keyword.other";
  const std::string owner(pieces[first].token.text);
  const bool named = i == first + 1 && Words{"constant", "parameter", "dof",   "let",      "define",
                                             "creature", "link",      "point", "revolute", "prismatic"}
                                           .contains(owner);
  if (named) return "entity.name";
  if (pieces[i + 1].token.kind == TokenKind::colon && piece.depth == 0) return "entity.name";
  return {};
}

// Where an item of this word stands; empty for statements.
std::string_view block_of(std::string_view item) {
  for (const Word& word : vocabulary())
    if (word.kind == Kind::item && word.word == item) return word.of;
  return {};
}

TEST(Grammar, ClassifiesEveryTokenOfTheScenes) {
  const nlohmann::json rules = grammar();
  TextMate editor(rules);
  for (const auto& [path, text] : scene_texts()) {
    if (path.starts_with("tests/") && !path.ends_with(".scene")) continue;
    SCOPED_TRACE(path);
    const std::vector<std::string> scopes = editor.scopes(text);
    std::vector<std::size_t> lines{0};
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') lines.push_back(i + 1);
    std::vector<Diagnostic> diagnostics;
    const Scene scene = parse(text, diagnostics);
    const Lexed lexed = lex(text, diagnostics);
    const std::vector<Piece> pieces = pieces_of(lexed.tokens, scene).pieces;
    std::size_t first = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Token& token = pieces[i].token;
      if (is_separator(pieces[i]) || token.kind == TokenKind::left_brace || token.kind == TokenKind::right_brace) {
        first = i + 1;
        continue;
      }
      const std::size_t at = static_cast<std::size_t>(token.text.data() - text.data());
      const std::string should = expected(pieces, i, first);
      EXPECT_TRUE(scopes[at].starts_with(should)) << token.span.line << ":" << token.span.column << " '" << token.text
                                                  << "' is " << scopes[at] << ", not " << should;
      // Clauses, items and words of actions: keywords, unless they are names.
      const std::string_view owner = pieces[first].token.text, block = block_of(owner);
      const bool known = std::ranges::any_of(vocabulary(), [&](const Word& word) {
        const bool item = word.kind == Kind::item && word.of == block;
        return word.word == token.text && (item || (i > first && belongs_to(word, owner)));
      });
      if (should.empty() && token.kind == TokenKind::name) {
        EXPECT_EQ(scopes[at].starts_with("keyword"), known)
            << token.span.line << ":" << token.span.column << " '" << token.text << "' is " << scopes[at];
      }
    }
    for (const Comment& comment : lexed.comments)
      EXPECT_TRUE(scopes[static_cast<std::size_t>(comment.text.data() - text.data())].starts_with("comment"))
          << comment.text;
  }
}

TEST(Grammar, IsAnExtensionThatPointsAtItsFiles) {
  const auto extension = nlohmann::json::parse(file_text("symbolic/editor/package.json"));
  const auto& language = extension.at("contributes").at("languages").at(0);
  const auto& entry = extension.at("contributes").at("grammars").at(0);
  EXPECT_EQ(entry.at("scopeName"), grammar().at("scopeName"));
  EXPECT_EQ(entry.at("language"), language.at("id"));
  for (const std::string& file : {entry.at("path").get<std::string>(), language.at("configuration").get<std::string>()})
    EXPECT_FALSE(nlohmann::json::parse(file_text("symbolic/editor/" + file)).empty());
}

}  // namespace
}  // namespace spacetime::symbolic
