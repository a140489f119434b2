#include "symbolic/parse_expression.h"

#include <algorithm>
#include <array>
#include <optional>

namespace spacetime::symbolic {
namespace {

using Kind = Node::Kind;

NodeId missing(Parsing& p) {
  return add_node(p.scene, {Kind::missing, p.in.peek().span, p.in.peek().span, 0, {}, {}, 0});
}

Node node(Kind kind, Span span, Span mark, std::vector<NodeId> operands = {}) {
  return {kind, span, mark, 0, {}, std::move(operands), 0};
}

const Span& span_of(const Parsing& p, NodeId id) { return p.scene.nodes[id].span; }

NodeId binary(Parsing& p, Kind kind, const Span& mark, NodeId a, NodeId b) {
  return add_node(p.scene, node(kind, join(span_of(p, a), span_of(p, b)), mark, {a, b}));
}

// Counts a level of nesting for as long as it lives; fails where it is one too many.
class Level {
 public:
  explicit Level(Parsing& p) : p_(p) {
    if (++p_.depth > deepest_nesting)
      p_.in.fail(p_.in.peek().span, "expressions nest at most " + std::to_string(deepest_nesting) +
                                        " deep: give a part of this one a name with 'let'");
  }
  ~Level() { --p_.depth; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  Parsing& p_;
};

std::vector<NodeId> parse_arguments(Parsing& p, const Token& opened, TokenKind closing) {
  std::vector<NodeId> out;
  if (!p.in.at(closing)) do {
      out.push_back(parse_condition(p));
    } while (p.in.accept(TokenKind::comma));
  p.in.close(closing, opened);
  return out;
}

NodeId parse_parenthesised(Parsing& p) {
  const Level level(p);
  const Token opened = p.in.open(TokenKind::left_paren, "'('");
  if (p.in.failed()) return missing(p);
  if (p.in.at(TokenKind::right_paren)) {
    p.in.fail(opened.span, "empty parentheses: put a value between them");
    return missing(p);
  }
  const std::vector<NodeId> operands = parse_arguments(p, opened, TokenKind::right_paren);
  if (operands.size() == 1) return operands.front();
  const Span span = join(opened.span, p.in.previous().span);
  return add_node(p.scene, node(Kind::tuple, span, opened.span, operands));
}

NodeId parse_named(Parsing& p) {
  const Token name = p.in.take();
  Node out = node(Kind::name, name.span, name.span);
  out.text = name.text;
  if (p.in.at(TokenKind::left_paren)) {
    const Level level(p);
    const Token opened = p.in.open(TokenKind::left_paren, "'('");
    out.operands = parse_arguments(p, opened, TokenKind::right_paren);
    out.kind = Kind::call;
    out.span = join(name.span, p.in.previous().span);
  }
  return add_node(p.scene, std::move(out));
}

NodeId parse_primary(Parsing& p) {
  const Token& token = p.in.peek();
  if (p.in.failed()) return missing(p);
  if (token.kind == TokenKind::number) {
    Node out = node(Kind::number, token.span, token.span);
    out.number = p.in.take().number;
    return add_node(p.scene, std::move(out));
  }
  if (token.kind == TokenKind::left_paren) return parse_parenthesised(p);
  if (token.kind == TokenKind::name && !is_operator(token) && !p.in.at_statement()) return parse_named(p);
  if (token.kind == TokenKind::left_bracket)
    p.in.fail(token.span, "a list in [ ] cannot stand here: write a tuple with ( )");
  else if (p.in.at_statement() && is_operator(p.in.previous()))
    p.in.fail(token.span, "expected a value, found " + describe(token),
              {{p.in.previous().span, "a line that ends in " + describe(p.in.previous()) + " goes on"}});
  else
    p.in.fail("a value");
  return missing(p);
}

NodeId parse_postfix(Parsing& p) {
  NodeId out = parse_primary(p);
  while (!p.in.failed()) {
    const Span mark = p.in.peek().span;
    if (p.in.accept(TokenKind::prime)) {
      out = add_node(p.scene, node(Kind::prime, join(span_of(p, out), mark), mark, {out}));
    } else if (p.in.accept(TokenKind::dot)) {
      const Name name = parse_name(p, "a name after the dot");
      Node member = node(Kind::member, join(span_of(p, out), name.span), name.span, {out});
      member.text = name.text;
      out = add_node(p.scene, std::move(member));
    } else {
      break;
    }
  }
  return out;
}

NodeId parse_signed(Parsing& p);

NodeId parse_power(Parsing& p) {
  const NodeId base = parse_postfix(p);
  const Span mark = p.in.peek().span;
  if (!p.in.accept(TokenKind::caret)) return base;
  const Level level(p);
  return binary(p, Kind::power, mark, base, parse_signed(p));
}

NodeId parse_signed(Parsing& p) {
  const Span mark = p.in.peek().span;
  if (p.in.failed()) return missing(p);
  if (p.in.accept(TokenKind::minus)) {
    const Level level(p);
    const NodeId operand = parse_signed(p);
    return add_node(p.scene, node(Kind::negate, join(mark, span_of(p, operand)), mark, {operand}));
  }
  if (p.in.accept(TokenKind::plus)) {
    const Level level(p);
    return parse_signed(p);
  }
  return parse_power(p);
}

std::optional<Kind> product_kind(const Token& token) {
  if (token.kind == TokenKind::star) return Kind::multiply;
  if (token.kind == TokenKind::slash) return Kind::divide;
  return std::nullopt;
}

std::optional<Kind> sum_kind(const Token& token) {
  if (token.kind == TokenKind::plus) return Kind::add;
  if (token.kind == TokenKind::minus) return Kind::subtract;
  return std::nullopt;
}

std::optional<Kind> comparison_kind(const Token& token) {
  switch (token.kind) {
    case TokenKind::less:
      return Kind::less;
    case TokenKind::less_equal:
      return Kind::less_equal;
    case TokenKind::greater:
      return Kind::greater;
    case TokenKind::greater_equal:
      return Kind::greater_equal;
    default:
      return std::nullopt;
  }
}

template <class Operand, class KindOf>
NodeId parse_left(Parsing& p, Operand operand, KindOf kind_of) {
  NodeId out = operand(p);
  while (!p.in.failed()) {
    const auto kind = kind_of(p.in.peek());
    if (!kind) break;
    const Span mark = p.in.take().span;
    out = binary(p, *kind, mark, out, operand(p));
  }
  return out;
}

NodeId parse_product(Parsing& p) { return parse_left(p, parse_signed, product_kind); }

// a < b, or a <= b < c, which means a <= b and b < c.
NodeId parse_comparison(Parsing& p) {
  NodeId left = parse_sum(p);
  std::optional<NodeId> out;
  while (!p.in.failed()) {
    const auto kind = comparison_kind(p.in.peek());
    if (!kind) {
      if (p.in.at(TokenKind::equal) && p.depth > 0)
        p.in.fail(p.in.peek().span, "'=' cannot stand inside brackets: conditions are made with < <= > >=");
      break;
    }
    const Span mark = p.in.take().span;
    const NodeId right = parse_sum(p);
    const NodeId one = binary(p, *kind, mark, left, right);
    out = out ? binary(p, Kind::logical_and, mark, *out, one) : one;
    left = right;
  }
  return out.value_or(left);
}

NodeId parse_not(Parsing& p) {
  const Span mark = p.in.peek().span;
  if (!p.in.accept_word("not")) return parse_comparison(p);
  const Level level(p);
  const NodeId operand = p.in.failed() ? missing(p) : parse_not(p);
  return add_node(p.scene, node(Kind::logical_not, join(mark, span_of(p, operand)), mark, {operand}));
}

std::optional<Kind> and_kind(const Token& token) {
  return token.kind == TokenKind::name && token.text == "and" ? std::optional(Kind::logical_and) : std::nullopt;
}
std::optional<Kind> or_kind(const Token& token) {
  return token.kind == TokenKind::name && token.text == "or" ? std::optional(Kind::logical_or) : std::nullopt;
}

NodeId parse_and(Parsing& p) { return parse_left(p, parse_not, and_kind); }

}  // namespace

NodeId add_node(Scene& scene, Node node) {
  const auto id = static_cast<NodeId>(scene.nodes.size());
  node.first = id;
  for (const NodeId operand : node.operands) node.first = std::min(node.first, scene.nodes[operand].first);
  scene.nodes.push_back(std::move(node));
  return id;
}

Span join(const Span& a, const Span& b) {
  if (a.line != b.line || b.column < a.column) return a;
  return {a.line, a.column, std::max(a.length, b.column + b.length - a.column)};
}

NodeId parse_sum(Parsing& p) { return parse_left(p, parse_product, sum_kind); }

NodeId parse_condition(Parsing& p) { return parse_left(p, parse_and, or_kind); }

Interval parse_interval(Parsing& p) {
  const Token opened = p.in.open(TokenKind::left_bracket, "an interval such as [0, 1]");
  Interval out;
  out.from = parse_sum(p);
  p.in.expect(TokenKind::comma, "','");
  out.to = parse_sum(p);
  p.in.close(TokenKind::right_bracket, opened);
  out.span = join(opened.span, p.in.previous().span);
  return out;
}

NodeId parse_list(Parsing& p) {
  const Token opened = p.in.open(TokenKind::left_bracket, "a list in [ ]");
  if (p.in.failed()) return missing(p);
  std::vector<NodeId> operands = parse_arguments(p, opened, TokenKind::right_bracket);
  return add_node(p.scene, node(Kind::list, join(opened.span, p.in.previous().span), opened.span, std::move(operands)));
}

std::vector<NodeId> parse_sums(Parsing& p) {
  std::vector<NodeId> out;
  do {
    out.push_back(parse_sum(p));
  } while (p.in.accept(TokenKind::comma));
  return out;
}

Name parse_name(Parsing& p, std::string_view what, bool dotted) {
  const Token token = p.in.peek();
  if (!p.in.expect(TokenKind::name, what)) return {{}, token.span};
  Name out{std::string(token.text), token.span};
  while (dotted && p.in.accept(TokenKind::dot)) {
    const Token part = p.in.peek();
    if (!p.in.expect(TokenKind::name, "a name after the dot")) break;
    out.text.append(".").append(part.text);
    out.span = join(out.span, part.span);
  }
  return out;
}

std::vector<Name> parse_names(Parsing& p) {
  std::vector<Name> out;
  do {
    out.push_back(parse_name(p, "a name", true));
  } while (p.in.accept(TokenKind::comma));
  return out;
}

}  // namespace spacetime::symbolic
