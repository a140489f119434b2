#include "symbolic/spacing.h"

#include <map>
#include <string>
#include <utility>

namespace spacetime::symbolic {
namespace {

using Position = std::pair<int, int>;
Position position_of(const Span& span) { return {span.line, span.column}; }

std::map<Position, Role> roles_in(const Scene& scene) {
  std::map<Position, Role> out;
  for (const Node& node : scene.nodes) {
    if (node.kind == Node::Kind::call) out[position_of(node.mark)] = Role::call;
    if (node.kind == Node::Kind::name || node.kind == Node::Kind::member) out[position_of(node.mark)] = Role::operand;
    // Between two values: everything else that looks like it is a sign.
    if (node.kind == Node::Kind::add || node.kind == Node::Kind::subtract) out[position_of(node.mark)] = Role::plain;
  }
  for (const Statement& statement : scene.statements)
    if (const auto* define = std::get_if<DefineDeclaration>(&statement.what))
      out[position_of(define->name.span)] = Role::call;
  return out;
}

bool is_open(TokenKind kind) { return kind == TokenKind::left_paren || kind == TokenKind::left_bracket; }
bool is_close(TokenKind kind) { return kind == TokenKind::right_paren || kind == TokenKind::right_bracket; }

bool begins_clause(const Token& token) {
  return token.kind == TokenKind::name &&
         (token.text == "at" || token.text == "over" || token.text == "when" || token.text == "weight");
}

bool has_clauses(const Token& word) {
  return word.text == "constrain" || word.text == "minimize" || word.text == "replace";
}

// Marks the words that begin clauses, which may be names of anything elsewhere.
void mark_clauses(std::vector<Piece>& pieces) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    Piece& piece = pieces[i];
    const bool label = i + 1 < pieces.size() && pieces[i + 1].token.kind == TokenKind::colon;
    if (is_separator(piece))
      first = i + 1;
    else if (i > first && has_clauses(pieces[first].token) && piece.role == Role::plain && piece.depth == 0 && !label &&
             begins_clause(piece.token))
      piece.role = Role::clause;
  }
}

bool is_word(const Piece& piece) { return piece.token.kind == TokenKind::name && is_operator(piece.token); }

// Operators that stand close to what they join.
bool is_tight(const Piece& piece) {
  switch (piece.token.kind) {
    case TokenKind::star:
    case TokenKind::slash:
    case TokenKind::caret:
    case TokenKind::dot:
      return true;
    default:
      return piece.role == Role::sign;
  }
}

}  // namespace

bool is_separator(const Piece& piece) {
  return piece.token.kind == TokenKind::line_end || piece.token.kind == TokenKind::semicolon;
}

Pieces pieces_of(const std::vector<Token>& tokens, const Scene& scene) {
  const std::map<Position, Role> roles = roles_in(scene);
  Pieces out;
  int depth = 0;
  for (const Token& token : tokens) {
    out.kept.push_back(out.pieces.size());
    if (token.kind == TokenKind::end || (depth > 0 && token.kind == TokenKind::line_end)) continue;
    if (is_close(token.kind)) --depth;
    const bool can_be_sign = token.kind == TokenKind::plus || token.kind == TokenKind::minus;
    const auto known = roles.find(position_of(token.span));
    const Role role = known != roles.end() ? known->second : can_be_sign ? Role::sign : Role::plain;
    out.pieces.push_back({token, role, depth});
    if (is_open(token.kind)) ++depth;
  }
  mark_clauses(out.pieces);
  return out;
}

std::size_t gap(const Piece& left, const Piece& right) {
  const TokenKind kind = right.token.kind;
  if (right.role == Role::clause) return 2;
  if (left.token.kind == TokenKind::number && kind == TokenKind::dot) return 1;  // 2 .x is not 2.x
  if (is_open(left.token.kind) || is_close(kind) || is_tight(left)) return 0;
  if (kind == TokenKind::comma || kind == TokenKind::colon || kind == TokenKind::semicolon || kind == TokenKind::prime)
    return 0;
  if (is_tight(right) && right.role != Role::sign) return 0;
  return kind == TokenKind::left_paren && left.role == Role::call ? 0 : 1;
}

std::size_t width(std::span<const Piece> pieces) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    out += (i > 0 ? gap(pieces[i - 1], pieces[i]) : 0) + pieces[i].token.text.size();
  return out;
}

std::string joined(std::span<const Piece> pieces) {
  std::string out;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    out.append(i > 0 ? gap(pieces[i - 1], pieces[i]) : 0, ' ').append(pieces[i].token.text);
  return out;
}

std::optional<int> bond(const Piece& left) {
  enum Bond { listing, relating, either, both, adding, multiplying, bonds };
  std::optional<int> out;
  switch (left.token.kind) {
    case TokenKind::comma:
      out = listing;
      break;
    case TokenKind::equal:
    case TokenKind::less:
    case TokenKind::less_equal:
    case TokenKind::greater:
    case TokenKind::greater_equal:
      out = relating;
      break;
    case TokenKind::plus:
    case TokenKind::minus:
      if (left.role != Role::sign) out = adding;
      break;
    case TokenKind::star:
    case TokenKind::slash:
      out = multiplying;
      break;
    default:
      if (is_word(left) && left.token.text != "not") out = left.token.text == "or" ? either : both;
  }
  if (out) *out += left.depth * bonds;
  return out;
}

}  // namespace spacetime::symbolic
