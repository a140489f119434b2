// What is printed parses back to the nodes it was printed from, and says what the scene says.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <random>

#include "symbolic/query.h"
#include "symbolic/value.h"
#include "tests/symbolic/compiled.h"

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

}  // namespace
}  // namespace spacetime::symbolic
