#include "symbolic/query.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "common/nearest.h"
#include "symbolic/derivative.h"
#include "symbolic/expression.h"
#include "symbolic/functional.h"
#include "symbolic/names.h"
#include "symbolic/parse_expression.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"
#include "symbolic/statement.h"
#include "symbolic/value.h"

namespace spacetime::symbolic {
namespace {

using Values = std::vector<Expr>;

// What reading a question leaves behind in the scene's model is undone when it has been answered, but for the nodes
// that the answer is made of.
class Question {
 public:
  Question(Understood& scene, std::string_view text)
      : scene_(scene),
        text_(text),
        nodes_(scene.scene.nodes.size()),
        lets_(scene.model.lets.size()),
        symbols_(scene.model.symbols),
        functions_(scene.model.functions),
        work_(scene.model.work) {}
  ~Question() {
    Model& model = scene_.model;
    scene_.scene.nodes.resize(nodes_);
    model.lets.resize(lets_);
    model.symbols = std::move(symbols_);
    model.functions = std::move(functions_);
    model.work = work_;
    model.overworked = false;
    model.time_checks.clear();
    scene_.diagnostics.clear();
  }
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

  // The value of an expression, or of the last of some `let`s; nothing where there are mistakes.
  Values values();
  // The mistakes met, in words that need no more than the question itself.
  std::vector<Diagnostic> mistakes() const;

 private:
  void let(Parsing& p);
  bool has_failed() const { return !scene_.diagnostics.empty(); }

  Understood& scene_;
  std::string_view text_;
  std::size_t nodes_, lets_;
  decltype(Model::symbols) symbols_;
  decltype(Model::functions) functions_;
  double work_;
};

void Question::let(Parsing& p) {
  LetDeclaration out;
  out.name = parse_name(p, "a name");
  p.in.expect(TokenKind::equal, "'='");
  out.value = parse_condition(p);
  if (!p.in.failed() && !p.in.at_separator()) p.in.fail("the end of the statement");
  if (!p.in.failed()) elaborate_let(scene_.model, out);
}

Values Question::values() {
  Model& model = scene_.model;
  Lexed lexed = lex(text_, scene_.diagnostics);
  if (has_failed()) return {};
  Parsing p{TokenReader(std::move(lexed.tokens), scene_.diagnostics), scene_.scene};
  const auto skip = [&] {
    while (p.in.accept(TokenKind::line_end) || p.in.accept(TokenKind::semicolon)) continue;
  };
  skip();
  bool declared = false;
  while (!has_failed() && p.in.at_word("let") && p.in.next().kind == TokenKind::name) {
    p.in.take();
    let(p);
    declared = true;
    skip();
  }
  if (has_failed()) return {};
  if (declared && p.in.at(TokenKind::end)) {
    check_times(model);
    return has_failed() ? Values{} : model.lets.back().second;
  }
  const NodeId root = parse_condition(p);
  skip();
  if (!p.in.failed() && !p.in.at(TokenKind::end)) p.in.fail("the end of the expression");
  if (p.in.failed()) return {};
  auto values = elaborate_numbers(model, root, "an expression");
  check_times(model);
  return values && !has_failed() ? *values : Values{};
}

std::vector<Diagnostic> Question::mistakes() const {
  std::vector<Diagnostic> out = scene_.diagnostics;
  for (Diagnostic& diagnostic : out) diagnostic.notes.clear();  // they point into the scene
  if (out.empty()) out.push_back({{1, 1, 1}, "this has no value", {}});
  return out;
}

bool is_part_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '\'' || c == ' ';
}

// A name's letters, so that it can be declared: arm.elbow'' becomes arm_elbow_ddot.
std::string plain(std::string_view name) {
  std::string out;
  std::size_t primes = 0;
  for (const char c : name) {
    if (c == '\'')
      ++primes;
    else
      out += c == '.' || c == ' ' ? '_' : c;
  }
  if (primes > 0) out += "_" + std::string(primes, 'd') + "ot";
  return out;
}

constexpr std::size_t longest_part_of_name = 40;  // so that two and what joins them make a name

std::string plain_or(std::string_view text, std::string_view otherwise) {
  const bool is_name = !text.empty() && std::ranges::all_of(text, is_part_of_name) &&
                       text.size() <= longest_part_of_name &&
                       std::isalpha(static_cast<unsigned char>(text.front())) != 0;
  return is_name ? plain(text) : std::string(otherwise);
}

const Stated* stated(const Model& model, std::string_view name) {
  for (const Stated& candidate : model.stated)
    if (candidate.name == name || (candidate.is_constraint ? "constraint " : "objective ") + candidate.name == name)
      return &candidate;
  return nullptr;
}

// An objective term that is one integral is read as its integrand.
Answer answer_of(const Model& model, const Stated& stated) {
  Answer out;
  out.values = stated.values;
  out.name = plain_or(stated.name, "statement");
  if (stated.is_constraint) {
    out.name += "_residual";
    out.what = stated.relation == Constraint::Relation::equal ? "constraint: this = 0" : "constraint: this <= 0";
    return out;
  }
  out.what = "objective term";
  const Graph& graph = model.graph;
  const Expr e = out.values.front();
  if (graph.node(e).kind != Graph::Kind::input || graph.input_of(e).kind != InputKind::functional) return out;
  const FunctionalUse& use = model.functionals[static_cast<std::size_t>(graph.input_of(e).index)];
  if (use.kind != Functional::Kind::integral) return out;
  out.values = {use.integrand};
  out.name += "_integrand";
  out.what = "objective term: its integrand";
  return out;
}

// What the name alone means, where it means something else than the expression made of it would.
std::optional<Answer> named(const Model& model, std::string_view what) {
  const auto constant = std::ranges::find(model.constants, what, &std::pair<std::string, Expr>::first);
  if (constant != model.constants.end()) return Answer{{constant->second}, plain(what), "constant", {}, {}};
  if (const Stated* found = model.symbols.contains(what) ? nullptr : stated(model, what))
    return answer_of(model, *found);
  return std::nullopt;
}

Answer refused(std::string_view asked, std::string message) {
  Answer out;
  out.asked = asked;
  out.diagnostics.push_back({{1, 1, static_cast<int>(std::max<std::size_t>(1, asked.size()))}, std::move(message), {}});
  return out;
}

Answer expression(Understood& scene, std::string_view what) {
  Answer out;
  out.name = plain_or(what, "value");
  out.what = "expression";
  Question question(scene, what);
  out.values = question.values();
  if (!out.values.empty()) return out;
  out.diagnostics = question.mistakes();
  out.asked = what;
  return out;
}

// A name that nothing has, in the scene or among its statements.
bool is_unknown(const Model& model, std::string_view what) {
  const bool is_name = !what.empty() && what.front() != ' ' && std::ranges::all_of(what, is_part_of_name);
  const std::string_view head = what.substr(0, what.find_first_of(".' "));
  return is_name && std::isdigit(static_cast<unsigned char>(what.front())) == 0 && !is_reserved(head) &&
         !model.symbols.contains(head);
}

std::string unknown(const Model& model, std::string_view what) {
  std::vector<std::string> names = known_names(model);
  for (const Stated& candidate : model.stated) names.push_back(candidate.name);
  return "the scene has no " + quoted(what) +
         suggestion(what, names, "ask for a name that it declares, or for an expression");
}

// The input that a derivative is taken by.
Answer variable(Understood& scene, std::string_view by) {
  if (is_unknown(scene.model, by)) return refused(by, unknown(scene.model, by));
  Answer out = expression(scene, by);
  if (!out) return out;
  const Graph& graph = scene.model.graph;
  const bool one = out.values.size() == 1 && graph.node(out.values[0]).kind == Graph::Kind::input;
  const InputKind kind = one ? graph.input_of(out.values[0]).kind : InputKind::time;
  if (kind == InputKind::dof || kind == InputKind::constant || kind == InputKind::parameter) return out;
  if (one && kind == InputKind::time)
    return refused(by, "for the derivative in time write a prime behind the expression");
  return refused(by,
                 "a derivative is taken by a degree of freedom, a derivative of one, a constant or a parameter, "
                 "and this is none of them");
}

// The partial derivatives of values by one input.  Those of functionals are functionals of derivatives; nothing where
// there is none, because times depend on the input, or it is a curve and no number.
std::optional<Values> derivatives(Model& model, const Values& values, Expr by) {
  const bool is_curve = model.graph.input_of(by).kind == InputKind::dof;
  std::map<Expr, Expr> rates{{by, model.graph.number(1)}};
  const auto total = [&](const Values& of) {
    Values inputs;
    for (const auto& [input, rate] : rates) inputs.push_back(input);
    Values out(of.size());
    for (const Entry& entry : jacobian(model.graph, of, inputs)) {
      Expr& sum = out[static_cast<std::size_t>(entry.row)];
      const Expr rate = rates.at(inputs[static_cast<std::size_t>(entry.column)]);
      sum = model.graph.add(sum, model.graph.multiply(entry.value, rate));
    }
    return out;
  };
  for (const int k : all_functionals_in(model, values)) {
    FunctionalUse use = model.functionals[static_cast<std::size_t>(k)];
    Values times;
    if (use.from) times.push_back(*use.from);
    if (use.to) times.push_back(*use.to);
    for (const Expr rate : total(times))
      if (rate != Expr{}) return std::nullopt;
    use.integrand = total({use.integrand}).front();
    if (use.integrand == Expr{}) continue;
    if (is_curve) return std::nullopt;
    rates[input_of(model, k)] = functional(model, use);
  }
  return total(values);
}

}  // namespace

std::unique_ptr<Understood> understand(std::string_view text) {
  auto out = std::make_unique<Understood>();
  out->model.emits = false;
  out->scene = parse_scene(text, out->diagnostics);
  if (!out->scene.statements.empty()) elaborate_scene(out->model);
  out->model.time_checks.clear();
  out->model.interval_checks.clear();
  out->model.work = 0;
  put_in_order(out->diagnostics);
  return out;
}

Answer query(Understood& scene, std::string_view what, std::string_view by) {
  if (!scene.diagnostics.empty()) return refused(what, "the scene has mistakes");
  if (std::max(what.size(), by.size()) > largest_scene) return refused({}, "this is larger than 16 MiB: ask for less");
  Answer out = named(scene.model, what).value_or(Answer{});
  if (out.values.empty()) {
    if (is_unknown(scene.model, what)) return refused(what, unknown(scene.model, what));
    out = expression(scene, what);
  }
  if (!out || by.empty()) return out;
  const Answer input = variable(scene, by);
  if (!input) return input;
  auto by_input = derivatives(scene.model, out.values, input.values.front());
  if (!by_input)
    return refused(by, "this is made of integral( ) or at( ), which has no derivative by " + quoted(by) +
                           ": ask for that of what stands inside");
  out.values = std::move(*by_input);
  out.name += "_by_" + input.name;
  out.what += ", differentiated by " + std::string(by);
  return out;
}

}  // namespace spacetime::symbolic
