#include <array>
#include <utility>

#include "symbolic/parse_statement.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

// "[word expression]", once.
bool option(Parsing& p, std::string_view word, std::optional<NodeId>& into) {
  const Span span = p.in.peek().span;
  if (!p.in.accept_word(word)) return false;
  if (into) p.in.fail(span, quoted(word) + " stands twice in this statement");
  into = parse_sum(p);
  return true;
}

bool of_names(Parsing& p, std::vector<Name>& names) {
  const Span span = p.in.peek().span;
  if (!p.in.accept_word("of")) return false;
  if (!names.empty()) p.in.fail(span, "'of' stands twice in this statement");
  names = parse_names(p);
  return true;
}

What parse_solve(Parsing& p) {
  SolveAction out;
  while (!p.in.failed()) {
    const Span span = p.in.peek().span;
    if (p.in.accept_word("method")) {
      if (out.method) p.in.fail(span, "'method' stands twice in this statement");
      out.method = parse_name(p, "a method: newton, sqp92 or bfgs");
      if (p.in.accept_word("linear")) out.conjugate_gradient = p.in.expect_word("cg");
    } else if (!option(p, "iterations", out.iterations) && !option(p, "tolerance", out.tolerance) &&
               !option(p, "starts", out.starts)) {
      break;
    }
  }
  return out;
}

What parse_iterate(Parsing& p) { return IterateAction{parse_sum(p)}; }

What parse_window(Parsing& p) {
  WindowAction out;
  if (p.in.accept_word("all")) return out;
  out.time = parse_interval(p);
  of_names(p, out.names);
  return out;
}

What parse_refine(Parsing& p) {
  RefineAction out;
  if (p.in.accept_word("auto")) {
    p.in.expect_word("tolerance");
    out.tolerance = parse_sum(p);
    return out;
  }
  out.time = parse_interval(p);
  while (!p.in.failed() && (of_names(p, out.names) || option(p, "times", out.times))) continue;
  return out;
}

What parse_shake(Parsing& p) {
  ShakeAction out;
  p.in.expect_word("amplitude");
  out.amplitude = parse_sum(p);
  while (!p.in.failed() && (of_names(p, out.names) || option(p, "seed", out.seed))) continue;
  return out;
}

What parse_filter(Parsing& p) {
  FilterAction out;
  p.in.expect_word("strength");
  out.strength = parse_sum(p);
  of_names(p, out.names);
  return out;
}

What parse_damp(Parsing& p) {
  DampAction out;
  out.limit = parse_sum(p);
  of_names(p, out.names);
  return out;
}

What parse_adapt(Parsing& p) {
  AdaptAction out;
  p.in.expect_word("tolerance");
  out.tolerance = parse_sum(p);
  option(p, "levels", out.levels);
  return out;
}

What parse_lock(Parsing& p) {
  p.in.expect_word("level");
  return LockAction{parse_sum(p)};
}

What parse_set(Parsing& p) {
  SetAction out;
  out.constant = parse_name(p, "a constant's name");
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_sum(p);
  return out;
}

What parse_weight_action(Parsing& p) {
  WeightAction out;
  out.name = parse_name(p, "the name of a constraint or objective term");
  p.in.expect(TokenKind::equal, "'='");
  out.weight.span = p.in.peek().span;
  bool infinite = false;
  const NodeId value = parse_weight_value(p, infinite);
  if (!infinite) out.weight.value = value;
  return out;
}

template <ToggleAction::Kind kind>
What parse_toggle(Parsing& p) {
  return ToggleAction{kind, parse_name(p, "the name of a constraint or objective term")};
}

What parse_replace(Parsing& p) {
  ReplaceAction out;
  out.name = parse_name(p, "the name of a constraint or objective term");
  p.in.expect(TokenKind::colon, "':' and what replaces it");
  const NodeId left = parse_sum(p);
  if (at_relation(p))
    out.by = parse_constraint(p, left);
  else
    out.by = parse_objective(p, left);
  return out;
}

What parse_scope_action(Parsing& p) {
  ScopeAction out;
  out.name = parse_name(p, "the name of a constraint");
  if (auto scope = parse_scope(p))
    out.scope = *scope;
  else
    p.in.fail("a scope: 'at' and times, or 'over' and an interval");
  return out;
}

What parse_bound(Parsing& p) {
  BoundAction out;
  out.dof = parse_name(p, "a degree of freedom", true);
  p.in.expect_word("in");
  out.bounds = parse_interval(p);
  return out;
}

What parse_key(Parsing& p) {
  KeyAction out;
  out.time = parse_sum(p);
  p.in.expect(TokenKind::colon, "':' after the key's time");
  out.keys = parse_assignments(p);
  return out;
}

What parse_control(Parsing& p) {
  ControlAction out;
  out.dof = parse_name(p, "a degree of freedom", true);
  out.index = parse_sum(p);
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_sum(p);
  return out;
}

What parse_reset(Parsing&) { return ResetAction{}; }

}  // namespace

StatementParser action_parser(std::string_view word) {
  using Toggle = ToggleAction::Kind;
  static constexpr std::array<std::pair<std::string_view, StatementParser>, 20> table{{
      {"solve", parse_solve},
      {"iterate", parse_iterate},
      {"window", parse_window},
      {"refine", parse_refine},
      {"shake", parse_shake},
      {"filter", parse_filter},
      {"damp", parse_damp},
      {"adapt", parse_adapt},
      {"lock", parse_lock},
      {"set", parse_set},
      {"weight", parse_weight_action},
      {"enable", parse_toggle<Toggle::enable>},
      {"disable", parse_toggle<Toggle::disable>},
      {"delete", parse_toggle<Toggle::remove>},
      {"replace", parse_replace},
      {"scope", parse_scope_action},
      {"bound", parse_bound},
      {"key", parse_key},
      {"control", parse_control},
      {"reset", parse_reset},
  }};
  for (const auto& [name, parser] : table)
    if (name == word) return parser;
  return nullptr;
}

}  // namespace spacetime::symbolic
