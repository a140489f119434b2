#include <array>
#include <string>
#include <utility>

#include "symbolic/parse_statement.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

using Kind = LinkItem::Kind;

struct Word {
  std::string_view word;
  Kind kind;
  bool geometry;  // may follow the joint, or another of them, without a separator
};
constexpr std::array<Word, 17> words{{{"revolute", Kind::revolute, false},
                                      {"prismatic", Kind::prismatic, false},
                                      {"fixed", Kind::fixed, false},
                                      {"offset", Kind::offset, true},
                                      {"a", Kind::a, true},
                                      {"alpha", Kind::alpha, true},
                                      {"d", Kind::d, true},
                                      {"theta", Kind::theta, true},
                                      {"axis", Kind::axis, true},
                                      {"origin", Kind::origin, true},
                                      {"mass", Kind::mass, false},
                                      {"com", Kind::com, false},
                                      {"inertia", Kind::inertia, false},
                                      {"rod", Kind::rod, false},
                                      {"capsule", Kind::capsule, false},
                                      {"sphere", Kind::sphere, false},
                                      {"box", Kind::box, false}}};

const Word* link_word(const Token& token) {
  if (token.kind == TokenKind::name)
    for (const Word& word : words)
      if (word.word == token.text) return &word;
  return nullptr;
}

bool is_joint(Kind kind) { return kind == Kind::revolute || kind == Kind::prismatic || kind == Kind::fixed; }

LinkItem parse_one(Parsing& p, const Word& word) {
  LinkItem out;
  out.kind = word.kind;
  out.span = p.in.take().span;
  if (word.kind == Kind::fixed) return out;
  if (is_joint(word.kind)) {
    out.dof = parse_name(p, "the degree of freedom's name");
    if (p.in.accept(TokenKind::equal)) out.value = parse_sum(p);
    out.bounds = parse_bounds(p);
    return out;
  }
  const bool bare_rod = word.kind == Kind::rod && (p.in.at_separator() || p.in.at(TokenKind::right_brace));
  if (!bare_rod) out.value = parse_sum(p);
  return out;
}

void parse_link_item(Parsing& p, void* target) {
  auto& link = *static_cast<LinkDeclaration*>(target);
  const Word* word = link_word(p.in.peek());
  if (!word) {
    return p.in.fail(
        "a joint (revolute, prismatic, fixed), its geometry (offset, a, alpha, d, theta, axis, origin), a "
        "mass (mass, com, inertia, rod) or a shape (capsule, sphere, box)");
  }
  // "prismatic X axis (1, 0, 0)": what says how the joint sits may stand in one item with it.
  bool goes_on = true;
  while (word && goes_on && !p.in.failed()) {
    link.items.push_back(parse_one(p, *word));
    goes_on = word->geometry || is_joint(word->kind);
    word = link_word(p.in.peek());
    goes_on = goes_on && word && word->geometry;
  }
  if (p.in.failed() && !link.items.empty() && !is_joint(link.items.back().kind)) link.items.pop_back();
}

struct Target {
  CreatureDeclaration& creature;
  bool damaged = false;
};

LinkDeclaration parse_link(Parsing& p, bool& damaged) {
  LinkDeclaration out;
  out.name = parse_name(p, "the link's name");
  if (p.in.accept_word("on")) out.parent = parse_name(p, "the parent link's name, or 'ground'");
  out.damaged = parse_braces(p, "link " + out.name.text, parse_link_item, &out, creature_words);
  damaged = damaged || out.damaged;
  return out;
}

// A link's '}' came too early: one report for all that it left behind.
void refuse_left_behind(Parsing& p, Target& target) {
  p.in.fail(p.in.peek().span, quoted(p.in.peek().text) + " can stand only inside 'link { }': is a '}' too early?");
  target.damaged = true;
  auto& items = target.creature.items;
  if (auto* link = items.empty() ? nullptr : std::get_if<LinkDeclaration>(&items.back())) link->damaged = true;
  if (p.in.skip_left_behind(creature_words)) p.in.go_on();
}

void parse_item(Parsing& p, void* opaque) {
  auto& target = *static_cast<Target*>(opaque);
  auto& items = target.creature.items;
  const Span span = p.in.peek().span;
  if (link_word(p.in.peek())) return refuse_left_behind(p, target);
  if (p.in.accept_word("gravity")) {
    items.push_back(GravityDeclaration{parse_sum(p), span});
  } else if (p.in.accept_word("link")) {
    items.push_back(parse_link(p, target.damaged));
    const bool goes_on = p.in.at(TokenKind::name) && !p.in.peek().line_start;
    if (goes_on && !p.in.failed()) refuse_left_behind(p, target);
  } else if (p.in.accept_word("point")) {
    PointDeclaration point;
    point.name = parse_name(p, "the point's name");
    p.in.expect_word("on");
    point.link = parse_name(p, "a link's name");
    point.position = parse_sum(p);
    if (!p.in.failed()) items.push_back(point);
  } else if (p.in.accept_word("force")) {
    ForceDeclaration force;
    p.in.expect_word("on");
    force.point = parse_name(p, "a point's name");
    p.in.expect(TokenKind::equal, "'='");
    force.value = parse_sum(p);
    items.push_back(force);
  } else {
    p.in.fail("'link', 'point', 'gravity' or 'force'");
  }
}

}  // namespace

What parse_creature(Parsing& p) {
  CreatureDeclaration out;
  out.name = parse_name(p, "the creature's name");
  Target target{out};
  const bool lost = parse_braces(p, "creature " + out.name.text, parse_item, &target);
  out.damaged = lost || target.damaged;
  return out;
}

}  // namespace spacetime::symbolic
