#include "symbolic/parse_statement.h"

namespace spacetime::symbolic {
namespace {

PathItem parse_path(Parsing& p) {
  PathItem out;
  out.through = p.in.accept_word("through");
  out.points = parse_list(p);
  if (p.in.accept_word("knots")) out.knots = parse_list(p);
  return out;
}

TravelItem parse_travel(Parsing& p) {
  TravelItem out;
  if (p.in.accept_word("constant")) return out;
  out.kind = p.in.accept_word("control") ? TravelItem::Kind::control : TravelItem::Kind::keys;
  out.points = parse_list(p);
  while (!p.in.failed()) {
    if (!out.relative && p.in.accept_word("relative"))
      out.relative = true;
    else if (!out.speed && p.in.accept_word("speed"))
      out.speed = parse_sum(p);
    else if (!out.knots && p.in.accept_word("knots"))
      out.knots = parse_list(p);
    else
      break;
  }
  return out;
}

OrientItem parse_orient(Parsing& p) {
  OrientItem out;
  if (p.in.accept_word("along")) {
    p.in.expect_word("up");
    out.up = parse_sum(p);
  } else {
    out.keys = parse_list(p);
  }
  return out;
}

void parse_item(Parsing& p, void* target) {
  auto& script = *static_cast<ScriptDeclaration*>(target);
  if (p.in.accept_word("path"))
    script.items.push_back(parse_path(p));
  else if (p.in.accept_word("travel"))
    script.items.push_back(parse_travel(p));
  else if (p.in.accept_word("orient"))
    script.items.push_back(parse_orient(p));
  else
    p.in.fail("'path', 'travel' or 'orient'");
}

}  // namespace

What parse_script(Parsing& p) {
  ScriptDeclaration out;
  out.name = parse_name(p, "the scripted body's name");
  out.damaged = parse_braces(p, "script " + out.name.text, parse_item, &out);
  return out;
}

}  // namespace spacetime::symbolic
