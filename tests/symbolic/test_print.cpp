// What is printed parses back to the nodes it was printed from, and says what the scene says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <random>

#include "symbolic/query.h"
#include "symbolic/value.h"
#include "tests/symbolic/compiled.h"
#include "tests/symbolic/random_expression.h"

namespace spacetime::symbolic {
namespace {

std::vector<std::string> examples() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(SPACETIME_SOURCE_DIR "/examples"))
    if (entry.path().extension() == ".scene") out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

// The inputs that values depend on and that a derivative can be taken by, as they are written.
std::vector<std::string> variables(Understood& scene, const std::vector<Expr>& values) {
  std::vector<std::string> out;
  const Graph& graph = scene.model.graph;
  const auto needed = reachable(graph, values);
  for (std::uint32_t id = 0; id < needed.size(); ++id) {
    if (!needed[id] || graph.node({id}).kind != Graph::Kind::input) continue;
    const Input& input = graph.input_of({id});
    if (input.kind == InputKind::dof || input.kind == InputKind::constant || input.kind == InputKind::parameter)
      out.push_back(input.name + std::string(static_cast<std::size_t>(input.derivative), '\''));
  }
  return out;
}

// Values where a functional is worth what it is made of plus its time: enough to tell different ones apart.
std::vector<double> values_at(const Model& model, const std::vector<Expr>& of, std::map<std::string, double>& point,
                              std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.2, 1.8);
  const Graph& graph = model.graph;
  std::vector<double> inputs(graph.inputs().size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Input& input = graph.inputs()[i];
    if (input.kind == InputKind::functional) {
      const FunctionalUse& use = model.functionals[static_cast<std::size_t>(input.index)];
      std::vector<Expr> parts{use.integrand};
      if (use.from) parts.push_back(*use.from);
      for (const double value : evaluate<double>(graph, parts, inputs)) inputs[i] += value;
    } else {
      inputs[i] = point.try_emplace(input.name + "'" + std::to_string(input.derivative), uniform(random)).first->second;
    }
  }
  return evaluate<double>(graph, of, inputs);
}

// The same function of its inputs, whatever has been collected: at a few seeded points.
void expect_same_values(const Model& model, const std::vector<Expr>& x, const std::vector<Expr>& y,
                        const std::string& what) {
  std::mt19937_64 random(1);
  for (int sample = 0; sample < 3; ++sample) {
    std::map<std::string, double> point;
    const auto a = values_at(model, x, point, random), b = values_at(model, y, point, random);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!std::isfinite(a[i])) continue;
      EXPECT_NEAR(a[i], b[i], 1e-9 * (1 + std::fabs(a[i]))) << what << " component " << i;
    }
  }
}

std::vector<Expr> nodes_of(const Reading& reading) {
  std::vector<Expr> out;
  for (const std::size_t root : reading.roots) out.push_back(reading.items[root].expr);
  return out;
}

void expect_reads_back(Understood& scene, const Answer& answer, const std::string& what) {
  ASSERT_TRUE(answer) << what << ": " << answer.diagnostics.front().message;
  const Reading reading = read(scene.model, answer.values);
  const std::string text = print_text(reading, names_for(scene, answer));
  const Answer again = query(scene, text);
  ASSERT_TRUE(again) << what << "\n" << text << render(again.diagnostics.front(), "text", text);
  EXPECT_EQ(again.values, nodes_of(reading)) << what << "\n" << text;
  expect_same_values(scene.model, answer.values, again.values, what);
  // A print of the print is the same.
  EXPECT_EQ(print_text(read(scene.model, again.values), names_for(scene, answer)), text) << what;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, EverythingAndItsDerivativesReadBack) {
  const auto scene = understand(file_text("examples/" + GetParam()));
  ASSERT_TRUE(scene->diagnostics.empty());
  const std::vector<Printable> all = printable(*scene);
  EXPECT_GT(all.size(), 1U);
  for (const Printable& printable : all) {
    expect_reads_back(*scene, query(*scene, printable.name), printable.name);
    for (const std::string& by : variables(*scene, printable.values)) {
      const Answer answer = query(*scene, printable.name, by);
      // The derivative of a functional by a curve is refused.
      if (!answer && scene->model.facts.has_functional(printable.values.front())) continue;
      expect_reads_back(*scene, answer, printable.name + " by " + by);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Examples, testing::ValuesIn(examples()),
                         [](const auto& example) { return example.param.substr(0, example.param.find('.')); });

// Small scenes of two degrees of freedom, a constant and a parameter.
std::unique_ptr<Understood> small(const std::string& lets) {
  auto out =
      understand("time [0, 1]\ntrajectory bspline spans 8\nconstant k = 3\nparameter p = 2\ndof x\ndof y\n" + lets);
  for (const Diagnostic& diagnostic : out->diagnostics) ADD_FAILURE() << diagnostic.message;
  return out;
}

std::string printed(Understood& scene, const std::string& what, const std::string& by = {}) {
  const Answer answer = query(scene, what, by);
  if (!answer) return answer.diagnostics.front().message;
  return print_text(read(scene.model, answer.values), names_for(scene, answer));
}

TEST(Print, PutsBracketsWhereTheLanguageNeedsThem) {
  const auto scene = small("");
  const std::vector<std::string> same{"-x^2",
                                      "1/x^2",
                                      "x^y^2",
                                      "(x^y)^2",
                                      "2^x",
                                      "(-x)^y",
                                      "x^(-y)",
                                      "-(x + y)",
                                      "1 - x^2 - y",
                                      "3*x^2 + 2*x + 1",
                                      "x*(y + 1)",
                                      "x/(3*y)",
                                      "x/3",
                                      "sin(x + pi/3)",
                                      "2*pi/5*sin(x)",
                                      "atan2(y, x)",
                                      "min(x, -y)",
                                      "max(x, 2)",
                                      "if(x < 1 and not (y < 2 or x <= y), x, y)",
                                      "if(x < 1 or y < 2 and x <= y, 1, 0)",
                                      "abs(x)",
                                      "2*t",
                                      "integral(x^2 + x*y)",
                                      "at(x'', k/6)",
                                      "x'*y'' - x''*y'",
                                      "1e-09*x",
                                      "e^x",
                                      "2/3",
                                      "x^2.5",
                                      "x^0.3",
                                      "tanh(x)/x",
                                      "integral(x, 0, k/6)",
                                      "k*p*x*y",
                                      "sqrt(x^2 + y^2)",
                                      "(x + y)^2*(x - y)/(x + 1)"};
  for (const std::string& text : same) EXPECT_EQ(printed(*scene, text), "let value = " + text + "\n");
  const std::vector<std::pair<std::string, std::string>> others{{"(-x)^2", "x^2"},
                                                                {"x/(y/k)", "k*x/y"},
                                                                {"x - (y - k)", "x - y + k"},
                                                                {"abs(x)'", "x'*sign(x)"},
                                                                {"x*y + x*k", "x*(y + k)"},
                                                                {"x*k - y*k + 0*x", "k*(x - y)"},
                                                                {"(x, 2*y)", "(x, 2*y)"},
                                                                {"x*x*x", "x^3"},
                                                                {"dot((x, y), (x, y))", "x^2 + y^2"},
                                                                {"deg(90)*x", "pi/2*x"},
                                                                {"-x - y", "-(x + y)"},
                                                                {"y - x + y", "2*y - x"},
                                                                {"cross((x, y, 0), (y, x, 0))", "(0, 0, x^2 - y^2)"}};
  for (const auto& [asked, said] : others) EXPECT_EQ(printed(*scene, asked), "let value = " + said + "\n");
}

TEST(Print, NamesWhatIsShared) {
  const auto scene = small("let s3 = x\nlet height = sin(x + 2*y)^2 + cos(x + 2*y)*sin(x + 2*y)\n");
  EXPECT_EQ(printed(*scene, "height"),
            "let s_1 = sin(x + 2*y)\n"
            "let height_value = cos(x + 2*y)*s_1 + s_1^2\n");
  EXPECT_EQ(printed(*scene, "height", "k"), "let height_by_k = 0\n");
}

TEST(Print, AThrowingArmsTorqueIsTextbookText) {
  const auto scene = understand(file_text("examples/throw.scene"));
  EXPECT_EQ(printed(*scene, "arm.elbow.force", "arm.elbow"),
            "let s1 = 0.5*arm.shoulder'^2 + g*cos(arm.shoulder)\n"
            "let s2 = 0.05*cos(arm.wrist) + 0.5\n"
            "let s3 = sin(arm.wrist)\n"
            "let s4 = 0.5*arm.shoulder'' + g*sin(arm.shoulder)\n"
            "let arm_elbow_force_by_arm_elbow = cos(arm.elbow)*(s1*s2 - 0.05*s3*s4) -\n"
            "    sin(arm.elbow)*(s4*s2 + 0.05*s3*s1)\n");
  EXPECT_EQ(printed(*scene, "ball.force"), "let ball_force = (0.2*ball.X'', 0.2*(ball.Y'' + g))\n");
}

TEST(Print, RandomExpressionsReadBack) {
  // Three degrees of freedom by the names that random expressions give them.
  const auto scene = understand("time [0, 1]\ntrajectory bspline spans 8\ndof x0\ndof x1\ndof x2\n");
  int read_back = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    RandomExpressions random(seed);
    RandomExpression e = random.make(scene->model.graph, 40, 3);
    const std::vector<Expr> values{e.expr.back()};
    // What has no value anywhere, such as log(-1), no scene may say.
    const auto needed = reachable(scene->model.graph, values);
    bool is_defined = true;
    for (std::uint32_t id = 0; id < needed.size(); ++id)
      is_defined = is_defined && !(needed[id] && scene->model.graph.is_undefined({id}));
    if (!is_defined) continue;
    ++read_back;
    const Reading reading = read(scene->model, values);
    const std::string text = print_text(reading, {"random", "s"});
    const Answer again = query(*scene, text);
    ASSERT_TRUE(again) << "seed " << seed << "\n" << text << render(again.diagnostics.front(), "text", text);
    EXPECT_EQ(again.values, nodes_of(reading)) << "seed " << seed << "\n" << text;
    std::vector<double> inputs(scene->model.graph.inputs().size());
    for (std::size_t i = 0; i < e.variables.size(); ++i)
      inputs[scene->model.graph.node(e.variables[i]).input] = e.point[i];
    const double was = evaluate<double>(scene->model.graph, values, inputs).front();
    const double is = evaluate<double>(scene->model.graph, again.values, inputs).front();
    EXPECT_NEAR(is, was, 1e-6 * (1 + std::fabs(was))) << "seed " << seed << "\n" << text;
  }
  EXPECT_GT(read_back, 40);
}

TEST(Print, DeepGraphsPrint) {
  const auto scene = small("");
  Graph& graph = scene->model.graph;
  const Expr x = scene->model.symbols.at("x").value.components[0], y = scene->model.symbols.at("y").value.components[0];
  Expr chain = x, sum = x;
  for (int i = 0; i < 30'000; ++i) {
    chain = i % 2 == 0 ? graph.sine(chain) : graph.multiply(chain, y);
    sum = graph.add(sum, graph.sine(graph.multiply(graph.number(i + 2), y)));
  }
  const std::vector<Expr> values{chain, sum};
  const Reading reading = read(scene->model, values);
  EXPECT_GT(reading.parts.size(), 1000U);
  const std::string text = print_text(reading, {"deep", "s"});
  const Answer again = query(*scene, text);
  ASSERT_TRUE(again) << again.diagnostics.front().message;
  EXPECT_EQ(again.values, nodes_of(reading));
  EXPECT_GT(print_latex(reading, "deep").size(), 500'000U);
  EXPECT_GT(print_dot(scene->model, values, "deep").size(), 500'000U);
}

TEST(Print, LatexIsBalanced) {
  for (const std::string& example : examples()) {
    const auto scene = understand(file_text("examples/" + example));
    for (const Printable& printable : printable(*scene)) {
      const std::string latex = print_latex(read(scene->model, printable.values), "name_of");
      int depth = 0, lefts = 0;
      for (std::size_t i = 0; i < latex.size(); ++i) {
        if (latex[i] == '{') ++depth;
        if (latex[i] == '}') --depth;
        EXPECT_GE(depth, 0);
        // An underscore is a subscript in braces, or escaped.
        const bool is_plain = latex[i] == '_' && latex[i - 1] != '\\' && latex[i + 1] != '{';
        EXPECT_FALSE(is_plain) << latex.substr(i - 5, 12);
        if (latex.compare(i, 5, "\\left") == 0) ++lefts;
        if (latex.compare(i, 6, "\\right") == 0) --lefts;
      }
      EXPECT_EQ(depth, 0) << printable.name;
      EXPECT_EQ(lefts, 0) << printable.name;
      EXPECT_NE(latex.find("\\end{aligned}\n\\]\n"), std::string::npos);
    }
  }
}

TEST(Print, DotEscapesQuotes) {
  const auto scene = small("");
  const Answer answer = query(*scene, "x'*2");
  const std::string dot = print_dot(scene->model, answer.values, "say \"x\"");
  EXPECT_TRUE(dot.starts_with("digraph \"say \\\"x\\\"\" {\n")) << dot;
  EXPECT_NE(dot.find("[label=\"x'\", shape=box]"), std::string::npos) << dot;
  EXPECT_NE(dot.find("[label=\"mul\"]"), std::string::npos) << dot;
}

TEST(Query, RefusesATextThatIsLargerThanAScene) {
  const auto scene = understand("time [0, 1]\n");
  const std::string most = "1" + std::string(largest_scene - 1, ' ');
  EXPECT_TRUE(query(*scene, most));
  for (const auto& [what, by] : {std::pair(most + " ", std::string()), std::pair(std::string("1"), most + " ")}) {
    const Answer answer = query(*scene, what, by);
    ASSERT_EQ(answer.diagnostics.size(), 1u);
    EXPECT_EQ(answer.diagnostics[0].message, "this is larger than 16 MiB: ask for less");
  }
}

TEST(Query, RefusesInWordsThatHelp) {
  const auto scene = understand(file_text("examples/throw.scene"));
  EXPECT_EQ(printed(*scene, "enrgy"), "the scene has no 'enrgy': did you mean 'energy'?");
  EXPECT_EQ(printed(*scene, "energy", "elbow"), "the scene has no 'elbow': did you mean 'arm.elbow'?");
  EXPECT_EQ(printed(*scene, "arm.forse"), "'arm' has no member 'forse': did you mean 'force'?");
  EXPECT_EQ(printed(*scene, "energy", "t"), "for the derivative in time write a prime behind the expression");
  EXPECT_EQ(printed(*scene, "energy", "arm.q").substr(0, 24), "a derivative is taken by");
  EXPECT_EQ(printed(*scene, "at(arm.hand.x, 1)", "arm.elbow").substr(0, 30), "this is made of integral( ) or");
  // A refusal leaves nothing behind.
  EXPECT_EQ(printed(*scene, "enrgy"), "the scene has no 'enrgy': did you mean 'energy'?");
  EXPECT_EQ(printed(*scene, "ball.X*2"), "let value = 2*ball.X\n");
}

TEST(Query, CountsWhatProgramsDo) {
  const auto scene = small("let z = x*y + sin(x)\n");
  const Sizes sizes = sizes_of(*scene, query(*scene, "z").values);
  EXPECT_EQ(sizes.nodes.shared, 5U);
  EXPECT_EQ(sizes.nodes.tree, 6);
  EXPECT_EQ(sizes.values, 2U);    // sin, multiply_add
  EXPECT_EQ(sizes.jacobian, 4U);  // and cos, cos + y
  EXPECT_GT(sizes.hessian, sizes.jacobian);
}

}  // namespace
}  // namespace spacetime::symbolic
