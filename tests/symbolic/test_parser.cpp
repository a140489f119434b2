#include <gtest/gtest.h>

#include <string>

#include "symbolic/parser.h"

namespace spacetime::symbolic {
namespace {

// An expression with every operation in brackets.
std::string show(const Scene& scene, NodeId id) {
  using Kind = Node::Kind;
  const Node& node = scene.nodes[id];
  const auto list = [&](const std::string& open, const std::string& between, const std::string& close) {
    std::string out = open;
    for (std::size_t i = 0; i < node.operands.size(); ++i)
      out += (i > 0 ? between : "") + show(scene, node.operands[i]);
    return out + close;
  };
  switch (node.kind) {
    case Kind::missing:
      return "?";
    case Kind::number:
      return std::to_string(static_cast<int>(node.number));
    case Kind::name:
      return node.text;
    case Kind::member:
      return list("", "", "") + "." + node.text;
    case Kind::prime:
      return list("", "", "") + "'";
    case Kind::negate:
      return list("(-", "", ")");
    case Kind::add:
      return list("(", "+", ")");
    case Kind::subtract:
      return list("(", "-", ")");
    case Kind::multiply:
      return list("(", "*", ")");
    case Kind::divide:
      return list("(", "/", ")");
    case Kind::power:
      return list("(", "^", ")");
    case Kind::call:
      return node.text + list("(", ",", ")");
    case Kind::tuple:
      return list("<", ",", ">");
    case Kind::list:
      return list("[", ",", "]");
    case Kind::less:
      return list("(", " < ", ")");
    case Kind::less_equal:
      return list("(", " <= ", ")");
    case Kind::greater:
      return list("(", " > ", ")");
    case Kind::greater_equal:
      return list("(", " >= ", ")");
    case Kind::logical_and:
      return list("(", " and ", ")");
    case Kind::logical_or:
      return list("(", " or ", ")");
    case Kind::logical_not:
      return list("(not ", "", ")");
  }
  return "";
}

Scene good(std::string_view text) {
  std::vector<Diagnostic> diagnostics;
  Scene scene = parse(text, diagnostics);
  for (const Diagnostic& diagnostic : diagnostics) ADD_FAILURE() << render(diagnostic, "scene", text);
  return scene;
}

template <class T>
const T& only(const Scene& scene) {
  EXPECT_EQ(scene.statements.size(), 1U);
  return std::get<T>(scene.statements.at(0).what);
}

std::string shown(const std::string& expression) {
  const Scene scene = good("let y = " + expression);
  return show(scene, only<LetDeclaration>(scene).value);
}

TEST(Parser, BindsAsMathematicsDoes) {
  EXPECT_EQ(shown("a + b*c"), "(a+(b*c))");
  EXPECT_EQ(shown("a - b - c"), "((a-b)-c)");
  EXPECT_EQ(shown("a/b/c"), "((a/b)/c)");
  EXPECT_EQ(shown("a^b^c"), "(a^(b^c))");
  EXPECT_EQ(shown("-x^2"), "(-(x^2))");
  EXPECT_EQ(shown("2^-x"), "(2^(-x))");
  EXPECT_EQ(shown("2^-x^3"), "(2^(-(x^3)))");
  EXPECT_EQ(shown("-a*b"), "((-a)*b)");
  EXPECT_EQ(shown("a*-b"), "(a*(-b))");
  EXPECT_EQ(shown("x'^2"), "(x'^2)");
  EXPECT_EQ(shown("x''.y'"), "x''.y'");
  EXPECT_EQ(shown("(a + b)'"), "(a+b)'");
  EXPECT_EQ(shown("+a - -b"), "(a-(-b))");
}

TEST(Parser, ConditionsBindLooserThanSums) {
  EXPECT_EQ(shown("if(a + 1 < b and not c > d or e <= f, 1, 2)"),
            "if(((((a+1) < b) and (not (c > d))) or (e <= f)),1,2)");
  EXPECT_EQ(shown("if(0 <= t < 1, a, b)"), "if(((0 <= t) and (t < 1)),a,b)");
  EXPECT_EQ(shown("if((a < b) and (c < d or e < f), 1, 2)"), "if(((a < b) and ((c < d) or (e < f))),1,2)");
}

TEST(Parser, ParenthesesMakeTuples) {
  EXPECT_EQ(shown("(a)"), "a");
  EXPECT_EQ(shown("(a, (b, c), f(d, e))"), "<a,<b,c>,f(d,e)>");
  EXPECT_EQ(shown("(a,\n b,\n\n c)"), "<a,b,c>");
}

TEST(Parser, NodesStandInPostOrder) {
  const Scene scene = good("let y = a*(b + c)'\nlet z = f(y, (1, 2))");
  for (NodeId id = 0; id < scene.nodes.size(); ++id) {
    EXPECT_LE(scene.nodes[id].first, id);
    for (const NodeId operand : scene.nodes[id].operands) {
      EXPECT_LT(operand, id);
      EXPECT_GE(operand, scene.nodes[id].first);
    }
  }
}

TEST(Parser, SpansCoverExpressions) {
  const Scene scene = good("let y = a*(b + c)");
  const Node& node = scene.nodes[only<LetDeclaration>(scene).value];
  EXPECT_EQ(node.span.column, 9);
  EXPECT_EQ(node.mark, (Span{1, 10, 1}));
}

TEST(Parser, StatementsEndAtLineEndsAndSemicolons) {
  EXPECT_EQ(good("dof a; dof b\ndof c;;\n;dof d # dof e").statements.size(), 4U);
}

TEST(Parser, ReadsEveryDeclaration) {
  const Scene scene = good(R"(time [0, 2]
constant g = 9.81
parameter m = 1 in [0, 2]
trajectory bspline spans 24
trajectory bspline knots [0, 1, 2] for x, arm.elbow
trajectory wavelet level 6 for arm
dof x = 1 in [-1, 1]
let h = sin(x)
define f(a, b) = a*b
eliminate arm.elbow = 2*x
creature arm {
  gravity (0, -g, 0)
  link upper { revolute shoulder = 1 in [0, 2]; offset -pi/2; a 0.5; mass 2.0; rod }
  link fore on upper {
    prismatic X axis (1, 0, 0) origin (0, 0, 1)
    mass 1; com (0, 0, 0); inertia (1, 2, 3, 0, 0, 0)
    box (1, 1, 1)
  }
  link last on ground { fixed; a 1; alpha 1; d 1; theta 1; rod (1, 0, 0); capsule 0.1 }
  point hand on fore (0, 0, 0)
  force on hand = (0, x, 0)
}
script hoop {
  path through [(0, 0, 0), (1, 0, 0)] knots [0, 1]
  travel [(0, 0), (1, 1)] relative speed (0, 1); orient along up (0, 1, 0)
}
script ball { path [(0, 0, 0)]; travel control [(0, 0)] knots [0, 1]; orient [(0, (1, 0, 0, 0))] }
script slow { travel constant }
constrain rest: (arm.q, arm.q') = 0 at 0, 2 when t < 1 weight 3
constrain -1 <= x <= 1 over [0, 2] every 0.1 weight inf
constrain x >= 0 over [0, 2] count 5
constrain x = 0 weight 2 over [0, 2]
minimize energy: integral(x''^2) weight 2
keyframe 0.8: x = 1, arm.elbow = -0.8
)");
  EXPECT_EQ(scene.statements.size(), 20U);
  const auto& creature = std::get<CreatureDeclaration>(scene.statements[10].what);
  EXPECT_EQ(creature.items.size(), 6U);
  EXPECT_EQ(std::get<LinkDeclaration>(creature.items[2]).items.size(), 7U);
  EXPECT_EQ(std::get<TrajectoryDeclaration>(scene.statements[4].what).names[1].text, "arm.elbow");
  const auto& chain = std::get<ConstrainDeclaration>(scene.statements[15].what);
  EXPECT_TRUE(chain.relation.third.has_value());
  ASSERT_TRUE(chain.weight.has_value());
  EXPECT_FALSE(chain.weight->value.has_value());
}

TEST(Parser, ReadsEveryAction) {
  const Scene scene = good(R"(solve
solve method sqp92 linear cg iterations 10 tolerance 1e-6 starts 3
iterate 5
window [0, 1] of x, arm
window all
refine [0, 1] of x times 2
refine auto tolerance 1e-3
shake amplitude 0.1 seed 3 of x
filter strength 0.5 of x
damp 0.3 of arm.elbow
adapt tolerance 1e-3 levels 2
lock level 3
set g = 1.62
weight goal = 3
weight goal = inf
enable goal; disable goal; delete goal
replace goal: x = 3 at 1
replace energy: integral(x) weight 2
scope goal at 0, 1
scope goal over [0, 1] every 0.1
bound arm.elbow in [-1, 1]
key 0.5: x = 1, y = 2
control x 3 = 0.5
reset
)");
  EXPECT_EQ(scene.statements.size(), 26U);
  EXPECT_TRUE(std::holds_alternative<ConstrainDeclaration>(std::get<ReplaceAction>(scene.statements[18].what).by));
  EXPECT_TRUE(std::holds_alternative<MinimizeDeclaration>(std::get<ReplaceAction>(scene.statements[19].what).by));
}

TEST(Parser, KeywordsMayBeNames) {
  const Scene scene =
      good("constant weight = 2\nlet time = weight + at(x,\n weight)\nconstrain time = weight weight weight");
  EXPECT_EQ(scene.statements.size(), 3U);
}

TEST(Parser, OneSlipIsOneReportAndCostsOneStatement) {
  for (const std::string slip :
       {"let y = (a + b", "let y = a +* b", "let y = a b", "let y 3", "constrain x", "minimise integral(x)",
        "let y = f(a, [b)", "time 0, 1", "creature c { link { fixed } }", "dof 3", "let y = 2 @ 3"}) {
    std::vector<Diagnostic> diagnostics;
    const Scene scene = parse("dof a\n" + slip + "\ndof b\nsolve\n", diagnostics);
    EXPECT_EQ(diagnostics.size(), 1U) << slip;
    ASSERT_GE(scene.statements.size(), 3U) << slip;
    EXPECT_TRUE(std::holds_alternative<SolveAction>(scene.statements.back().what)) << slip;
    EXPECT_TRUE(std::holds_alternative<DofDeclaration>(scene.statements[scene.statements.size() - 2].what)) << slip;
  }
}

TEST(Parser, NestingHasALimitAndNoOverflow) {
  for (const std::string open : {"(", "f(", "-", "not ", "2^", "((((", "if(a<b,"}) {
    std::string text = "let y = ";
    for (int i = 0; i < 100000; ++i) text += open;
    std::vector<Diagnostic> diagnostics;
    parse(text + "\ndof x\n", diagnostics);
    ASSERT_EQ(diagnostics.size(), 1U) << open;
    EXPECT_NE(diagnostics[0].message.find("256 deep"), std::string::npos) << open;
  }
  std::vector<Diagnostic> diagnostics;
  parse("let y = " + std::string(250, '(') + "1" + std::string(250, ')'), diagnostics);
  EXPECT_TRUE(diagnostics.empty());
}

TEST(Parser, LongSumsAndManyPrimesAreNoNesting) {
  std::string sum = "let y = 1", primes = "let z = x";
  for (int i = 0; i < 100000; ++i) sum += "+1", primes += '\'';
  EXPECT_EQ(good(sum + "\n" + primes).statements.size(), 2U);
}

TEST(Parser, EveryCutOfASceneEndsWell) {
  const std::string text =
      "time [0, 2]\ncreature arm {\n link a { revolute q; a 1 }\n}\nconstrain r: (arm.q, 1) = 0 at 0, 2\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    std::vector<Diagnostic> diagnostics;
    parse(text.substr(0, size), diagnostics);
    EXPECT_LE(diagnostics.size(), 2U) << text.substr(0, size);
  }
}

}  // namespace
}  // namespace spacetime::symbolic
