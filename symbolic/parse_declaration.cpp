#include <array>
#include <utility>

#include "symbolic/parse_statement.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

What parse_time(Parsing& p) { return TimeDeclaration{parse_interval(p)}; }

What parse_constant(Parsing& p) {
  ConstantDeclaration out;
  out.name = parse_name(p, "the constant's name");
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_condition(p);
  return out;
}

What parse_parameter(Parsing& p) {
  ParameterDeclaration out;
  out.name = parse_name(p, "the parameter's name");
  p.in.expect(TokenKind::equal, "'=' and a start value");
  out.start = parse_sum(p);
  out.bounds = parse_bounds(p);
  return out;
}

What parse_trajectory(Parsing& p) {
  using Kind = TrajectoryDeclaration::Kind;
  TrajectoryDeclaration out;
  if (p.in.accept_word("bspline")) {
    if (p.in.accept_word("spans"))
      out.kind = Kind::spans, out.argument = parse_sum(p);
    else if (p.in.accept_word("knots"))
      out.kind = Kind::knots, out.argument = parse_list(p);
    else
      p.in.fail("'spans' and a number, or 'knots' and a list");
  } else if (p.in.accept_word("wavelet")) {
    p.in.expect_word("level");
    out.kind = Kind::wavelet, out.argument = parse_sum(p);
  } else {
    p.in.fail("'bspline' or 'wavelet'");
  }
  if (p.in.accept_word("for")) out.names = parse_names(p);
  return out;
}

What parse_dof(Parsing& p) {
  DofDeclaration out;
  out.name = parse_name(p, "the degree of freedom's name");
  if (p.in.accept(TokenKind::equal)) out.start = parse_sum(p);
  out.bounds = parse_bounds(p);
  return out;
}

What parse_let(Parsing& p) {
  LetDeclaration out;
  out.name = parse_name(p, "a name");
  p.in.expect(TokenKind::equal, p.in.at(TokenKind::left_paren) ? "'=' ('define' declares functions)" : "'='");
  out.value = parse_condition(p);
  return out;
}

What parse_define(Parsing& p) {
  DefineDeclaration out;
  out.name = parse_name(p, "the function's name");
  const Token opened = p.in.open(TokenKind::left_paren, "'(' and the function's arguments");
  do {
    out.parameters.push_back(parse_name(p, "an argument's name"));
  } while (p.in.accept(TokenKind::comma));
  p.in.close(TokenKind::right_paren, opened);
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_condition(p);
  return out;
}

What parse_eliminate(Parsing& p) {
  EliminateDeclaration out;
  out.dof = parse_name(p, "a degree of freedom", true);
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_condition(p);
  return out;
}

std::optional<Name> parse_label(Parsing& p) {
  if (!p.in.at(TokenKind::name) || p.in.next().kind != TokenKind::colon) return std::nullopt;
  Name out = parse_name(p, "a name");
  p.in.take();
  return out;
}

What parse_constrain(Parsing& p) {
  std::optional<Name> name = parse_label(p);
  ConstrainDeclaration out = parse_constraint(p, parse_sum(p));
  out.name = std::move(name);
  return out;
}

What parse_minimize(Parsing& p) {
  std::optional<Name> name = parse_label(p);
  const NodeId value = parse_sum(p);
  if (at_relation(p))
    p.in.fail(p.in.peek().span,
              "an objective is one number to be made small, not a relation: write 'constrain' for this");
  MinimizeDeclaration out = parse_objective(p, value);
  out.name = std::move(name);
  return out;
}

What parse_keyframe(Parsing& p) {
  KeyframeDeclaration out;
  out.time = parse_sum(p);
  p.in.expect(TokenKind::colon, "':' after the keyframe's time");
  out.keys = parse_assignments(p);
  return out;
}

std::optional<Relation::Kind> relation_kind(const Token& token) {
  switch (token.kind) {
    case TokenKind::equal:
      return Relation::Kind::equal;
    case TokenKind::less_equal:
      return Relation::Kind::less_equal;
    case TokenKind::greater_equal:
      return Relation::Kind::greater_equal;
    default:
      return std::nullopt;
  }
}

Relation parse_relation(Parsing& p, NodeId left) {
  Relation out;
  out.left = left;
  out.span = p.in.peek().span;
  if (p.in.at(TokenKind::less) || p.in.at(TokenKind::greater))
    p.in.fail(out.span, "a relation holds its bound: write " + std::string(p.in.at(TokenKind::less) ? "'<='" : "'>='"));
  const auto kind = relation_kind(p.in.peek());
  if (!kind) {
    p.in.fail("a relation: '=', '<=' or '>='");
    return out;
  }
  p.in.take();
  out.kind = *kind;
  out.right = parse_sum(p);
  if (at_relation(p)) {
    const Span second = p.in.peek().span;
    if (relation_kind(p.in.peek()) != kind || *kind == Relation::Kind::equal)
      p.in.fail(second, "a chain has the form 'lo <= x <= hi': write anything else as two constraints");
    p.in.take();
    out.third = parse_sum(p);
  }
  if (at_relation(p)) p.in.fail(p.in.peek().span, "a chain has two relations at most: 'lo <= x <= hi'");
  return out;
}

// Clauses may come in any order, each once.
bool once(Parsing& p, bool seen) {
  if (seen) p.in.fail(p.in.peek().span, quoted(p.in.peek().text) + " stands twice in this statement");
  return !p.in.failed();
}

}  // namespace

StatementParser declaration_parser(std::string_view word) {
  static constexpr std::array<std::pair<std::string_view, StatementParser>, 13> table{{
      {"time", parse_time},
      {"constant", parse_constant},
      {"parameter", parse_parameter},
      {"trajectory", parse_trajectory},
      {"dof", parse_dof},
      {"let", parse_let},
      {"define", parse_define},
      {"eliminate", parse_eliminate},
      {"creature", parse_creature},
      {"script", parse_script},
      {"constrain", parse_constrain},
      {"minimize", parse_minimize},
      {"keyframe", parse_keyframe},
  }};
  for (const auto& [name, parser] : table)
    if (name == word) return parser;
  return nullptr;
}

bool at_relation(const Parsing& p) {
  return relation_kind(p.in.peek()) || p.in.at(TokenKind::less) || p.in.at(TokenKind::greater);
}

ConstrainDeclaration parse_constraint(Parsing& p, NodeId left) {
  ConstrainDeclaration out;
  out.relation = parse_relation(p, left);
  while (!p.in.failed()) {
    if (p.in.at_word("at") || p.in.at_word("over")) {
      if (once(p, out.scope.has_value())) out.scope = parse_scope(p);
    } else if (p.in.at_word("when")) {
      if (!once(p, out.when.has_value())) break;
      p.in.take();
      out.when = parse_condition(p);
    } else if (p.in.at_word("weight")) {
      if (once(p, out.weight.has_value())) out.weight = parse_weight(p);
    } else {
      break;
    }
  }
  return out;
}

MinimizeDeclaration parse_objective(Parsing& p, NodeId value) {
  MinimizeDeclaration out;
  out.value = value;
  if (p.in.at_word("at") || p.in.at_word("over") || p.in.at_word("when"))
    p.in.fail(p.in.peek().span, "an objective has no " + quoted(p.in.peek().text) +
                                    ": its times stand inside integral( , a, b) or at( , time)");
  out.weight = parse_weight(p);
  return out;
}

std::optional<ScopeClause> parse_scope(Parsing& p) {
  using Kind = ScopeClause::Kind;
  ScopeClause out;
  out.span = p.in.peek().span;
  if (p.in.accept_word("at")) {
    if (p.in.at(TokenKind::left_bracket))
      p.in.fail(p.in.peek().span, "'at' takes times, such as 'at 0, 1': write 'over' in front of an interval");
    out.times = parse_sums(p);
    return out;
  }
  if (!p.in.accept_word("over")) return std::nullopt;
  out.kind = Kind::knots;
  out.interval = parse_interval(p);
  if (p.in.accept_word("every"))
    out.kind = Kind::every, out.argument = parse_sum(p);
  else if (p.in.accept_word("count"))
    out.kind = Kind::count, out.argument = parse_sum(p);
  return out;
}

std::optional<WeightClause> parse_weight(Parsing& p) {
  WeightClause out;
  out.span = p.in.peek().span;
  if (!p.in.accept_word("weight")) return std::nullopt;
  bool infinite = false;
  const NodeId value = parse_weight_value(p, infinite);
  if (!infinite) out.value = value;
  return out;
}

NodeId parse_weight_value(Parsing& p, bool& infinite) {
  infinite = p.in.accept_word("inf");
  return infinite ? 0 : parse_sum(p);
}

std::vector<Assignment> parse_assignments(Parsing& p) {
  std::vector<Assignment> out;
  do {
    Assignment one;
    one.target = parse_sum(p);
    p.in.expect(TokenKind::equal, "'=' and a value");
    one.value = parse_sum(p);
    out.push_back(one);
  } while (p.in.accept(TokenKind::comma));
  return out;
}

std::optional<Interval> parse_bounds(Parsing& p) {
  if (!p.in.accept_word("in")) return std::nullopt;
  return parse_interval(p);
}

}  // namespace spacetime::symbolic
