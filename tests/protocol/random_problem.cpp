#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "tests/protocol/random_parts.h"

namespace spacetime::examples {
namespace {

class RandomProblem {
 public:
  explicit RandomProblem(std::uint32_t seed) : random_(seed) {}

  Problem make() {
    problem_.start = number_below(100) - 50.25;
    problem_.end = problem_.start + 0.1 + number_below(100);
    actions_ = number_below(8);
    repeat(4, [&] { add_constant(); });
    repeat(3, [&] { add_parameter(); });
    add_dof();
    repeat(3, [&] { add_dof(); });
    repeat(3, [&] { add_functional(); });
    repeat(4, [&] { add_constraint(); });
    repeat(3, [&] { add_term(); });
    add_replacements(problem_.constraints);
    add_replacements(problem_.objective);
    repeat(3, [&] { problem_.keyframes.push_back({instant(), keys(), place(), number_below(actions_ + 1)}); });
    repeat(3, [&] { add_plot(); });
    repeat(3, [&] { add_body(); });
    for (int i = 0; i < actions_; ++i) problem_.actions.push_back({action(), place()});
    return std::move(problem_);
  }

 private:
  int number_below(int bound) { return below(random_, bound); }
  bool toss() { return coin(random_); }
  Place place() { return {number_below(3), number_below(3)}; }
  template <class Each>
  void repeat(int bound, Each each) {
    for (int i = number_below(bound); i > 0; --i) each();
  }

  Quantity computed() {
    const auto program = random_program(random_, known_, number_below(5));
    const auto output = number_below(static_cast<int>(program.values.size()));
    return {0, add(problem_, program), output};
  }
  Quantity quantity() { return toss() ? number(random_number(random_)) : computed(); }
  Quantity not_negative() { return toss() ? number(std::abs(random_number(random_))) : computed(); }
  Quantity positive() { return toss() ? number(0.25 + number_below(9)) : computed(); }
  Quantity instant() {
    const double t = problem_.start + (problem_.end - problem_.start) * std::ldexp(static_cast<double>(random_()), -32);
    return toss() ? number(std::min(t, problem_.end)) : computed();
  }
  std::optional<Quantity> maybe(Quantity value) { return toss() ? std::optional(std::move(value)) : std::nullopt; }
  // Numbers in their order.
  std::pair<Quantity, Quantity> ordered(Quantity a, Quantity b) {
    if (a.program.empty() && b.program.empty() && a.number > b.number) std::swap(a, b);
    return {std::move(a), std::move(b)};
  }
  template <class Unknown>
  void bound(Unknown& unknown) {
    auto [lower, upper] = ordered(quantity(), quantity());
    if (toss()) unknown.lower = std::move(lower);
    if (toss()) unknown.upper = std::move(upper);
  }

  void add_constant() {
    const auto name = random_name(random_, "c", problem_.constants.size());
    problem_.constants.push_back({name, quantity(), place()});
    if (toss()) problem_.constants.back().frozen = place();
    known_.push_back(constant(name));
  }

  void add_parameter() {
    Parameter each{random_name(random_, "p", problem_.parameters.size()), quantity(), place()};
    bound(each);
    problem_.parameters.push_back(std::move(each));
  }

  void add_dof() {
    Dof each{random_name(random_, "q", problem_.dofs.size()),
             {random_knots(random_, problem_.start, problem_.end)},
             quantity(),
             place()};
    bound(each);
    problem_.dofs.push_back(std::move(each));
  }

  // A program over some of everything there is, maybe without time and trajectories.
  enum class Without { nothing, time };
  std::string statement(Without without) {
    auto inputs = known_;
    for (const auto& each : problem_.parameters) {
      if (toss()) inputs.push_back(parameter(each.name));
    }
    for (std::size_t i = 0; i < problem_.functionals.size(); ++i) {
      if (toss()) inputs.push_back(functional(static_cast<int>(i)));
    }
    if (without == Without::nothing) {
      for (const auto& each : problem_.dofs) {
        for (int d = 0; d < 3; ++d) {
          if (toss()) inputs.push_back(dof(each.name, d));
        }
      }
      if (toss()) inputs.push_back(time());
    }
    std::shuffle(inputs.begin(), inputs.end(), random_);
    return add(problem_, random_program(random_, std::move(inputs), number_below(40)));
  }
  int output_of(const std::string& program) {
    return number_below(static_cast<int>(problem_.programs.at(program).values.size()));
  }

  void add_functional() {
    Functional each{Functional::Kind::integral, statement(Without::nothing), 0, maybe(instant()), maybe(instant())};
    each.output = output_of(each.program);
    if (toss()) {
      each.kind = Functional::Kind::at;
      each.from = instant();
      each.to.reset();
    }
    problem_.functionals.push_back(std::move(each));
  }

  Scope scope(Scope::Kind kind) {
    Scope made;
    made.kind = kind;
    if (kind == Scope::Kind::times) {
      for (int k = 1 + number_below(3); k > 0; --k) made.times.push_back(instant());
    } else if (kind != Scope::Kind::once && kind != Scope::Kind::whole) {
      std::tie(made.from, made.to) = ordered(instant(), instant());
      if (kind == Scope::Kind::every) made.step = positive();
      if (kind == Scope::Kind::count) made.count = 2 + number_below(9);
    }
    return made;
  }

  void add_constraint() {
    Constraint each;
    each.name = random_name(random_, "constraint ", problem_.constraints.size());
    each.scope = scope(static_cast<Scope::Kind>(number_below(6)));
    const bool once = each.scope.kind == Scope::Kind::once;
    each.program = statement(once ? Without::time : Without::nothing);
    each.weight = maybe(not_negative());
    each.place = place();
    if (toss()) each.relation = Constraint::Relation::at_most;
    if (toss()) {
      // A condition has no multipliers, so no program with second derivatives.
      Program program;
      program.inputs = known_;
      if (!once) program.inputs.push_back(dof(problem_.dofs[0].name, number_below(3)));
      if (!problem_.parameters.empty()) program.inputs.push_back(parameter(problem_.parameters[0].name));
      program.numbers = {0.5};
      push(program, Op::less, 0, static_cast<int>(program.inputs.size()));
      program.values = {program.first_operation()};
      program.value_operations = program.jacobian_operations = 1;
      each.condition = Condition{add(problem_, std::move(program)), 0};
    }
    each.since = number_below(actions_ + 1);
    problem_.constraints.push_back(std::move(each));
  }

  void add_term() {
    Term term{random_name(random_, "objective ", problem_.objective.size()), quantity(), {}, place()};
    repeat(4, [&] {
      Piece piece;
      piece.kind = static_cast<Piece::Kind>(number_below(3));
      piece.program = statement(piece.kind == Piece::Kind::once ? Without::time : Without::nothing);
      piece.output = output_of(piece.program);
      if (piece.kind == Piece::Kind::integral) piece.from = maybe(instant());
      if (piece.kind == Piece::Kind::at) piece.from = instant();
      term.pieces.push_back(std::move(piece));
    });
    term.since = number_below(actions_ + 1);
    problem_.objective.push_back(std::move(term));
  }

  // Other statements under the names of some.
  template <class Statement>
  void add_replacements(std::vector<Statement>& list) {
    for (std::size_t i = 0, declared = list.size(); i < declared; ++i) {
      if (!toss()) continue;
      auto by = list[random_() % declared];
      by.name = list[i].name;
      by.replacement = true;
      list.push_back(std::move(by));
    }
  }

  std::vector<Key> keys() {
    std::vector<Key> made;
    for (const auto& each : problem_.dofs) {
      if (toss()) made.push_back({each.name, quantity()});
    }
    return made;
  }

  std::string sampled(int outputs) {
    Program program;
    program.inputs = {dof(problem_.dofs.front().name, number_below(3)), time()};
    for (int k = 0; k < outputs; ++k) program.values.push_back(number_below(2));
    return add(problem_, std::move(program));
  }

  void add_plot() {
    problem_.plots.push_back({random_name(random_, "plot", problem_.plots.size()), sampled(2), {number_below(2)}});
  }

  void add_body() {
    Body body{static_cast<Body::Shape>(number_below(4)),
              random_name(random_, "body", problem_.bodies.size()),
              {},
              sampled(12),
              std::vector<int>(12, 3)};
    const int sizes[] = {4, 1, 3, 0};
    for (int k = sizes[static_cast<int>(body.shape)]; k > 0; --k) body.size.push_back(quantity());
    problem_.bodies.push_back(std::move(body));
  }

  const Dof& some_dof() { return problem_.dofs[random_() % problem_.dofs.size()]; }
  DofNames some_dofs() {
    DofNames names;
    repeat(3, [&] { names.push_back(some_dof().name); });
    return names;
  }
  std::optional<Interval> some_interval() {
    if (toss()) return std::nullopt;
    const auto [from, to] = ordered(instant(), instant());
    return Interval{from, to};
  }
  std::optional<int> some_count() { return toss() ? std::optional(number_below(9)) : std::nullopt; }
  // The name of a constraint or a term that has taken effect by the next action, if there is one.
  template <class Statement>
  std::optional<std::string> some_name(const std::vector<Statement>& list) {
    if (list.empty()) return std::nullopt;
    const auto& chosen = list[random_() % list.size()];
    const auto declared = std::find_if(list.begin(), list.end(), [&](const auto& s) { return s.name == chosen.name; });
    if (declared->since > static_cast<int>(problem_.actions.size())) return std::nullopt;
    return chosen.name;
  }
  // Where something replaces what has this name.
  template <class Statement>
  std::optional<int> replacement_of(const std::vector<Statement>& list, const std::string& name) {
    const auto by = [&](const auto& each) { return each.replacement && each.name == name; };
    const auto found = std::find_if(list.begin(), list.end(), by);
    return found == list.end() ? std::nullopt : std::optional(static_cast<int>(found - list.begin()));
  }

  Action action() {
    const auto made = action(number_below(static_cast<int>(std::variant_size_v<Action>)));
    return made ? *made : Reset{};
  }

  // The action of that place among Action's alternatives, if this problem can have it.
  std::optional<Action> action(int which) {
    const bool of_constraint = toss();
    const auto name = of_constraint ? some_name(problem_.constraints) : some_name(problem_.objective);
    const auto names = action_names();
    const auto word = names[static_cast<std::size_t>(which)];
    const auto& dof = some_dof();
    if (word == "solve") {
      Solve solve{some_count(), 1e-3 / (1 + number_below(99)), static_cast<Solve::Method>(number_below(3)), false, 1};
      solve.linear_cg = solve.method == Solve::Method::sqp92 && toss();
      if (toss()) solve.starts = 1 + number_below(9);
      if (toss()) solve.tolerance = Solve{}.tolerance;
      return solve;
    }
    if (word == "iterate") return Iterate{number_below(9)};
    if (word == "window") return Window{some_interval(), some_dofs()};
    if (word == "refine") {
      Refine refine{some_interval(), some_dofs(), 1 + number_below(3), {}};
      if (!refine.interval) refine.automatic = maybe(positive());
      return refine;
    }
    if (word == "shake") return Shake{not_negative(), some_count(), some_dofs()};
    if (word == "filter") return Smooth{not_negative(), some_dofs()};
    if (word == "damp") return Damp{positive(), some_dofs()};
    if (word == "adapt") return Adapt{positive(), some_count()};
    if (word == "lock") return Lock{number_below(9)};
    if (word == "bound") {
      const auto [lower, upper] = ordered(quantity(), quantity());
      return Bound{dof.name, lower, upper};
    }
    if (word == "key") return PullKeys{instant(), keys()};
    if (word == "control") return Control{dof.name, number_below(dof.basis.size()), quantity()};
    if (word == "set" && !problem_.constants.empty()) {
      const auto& constant = problem_.constants[random_() % problem_.constants.size()];
      if (!constant.frozen) return SetConstant{constant.name, quantity()};
    }
    if (!name) return std::nullopt;
    if (word == "weight") return SetWeight{*name, of_constraint ? maybe(not_negative()) : std::optional(quantity())};
    if (word == "enable") return Enable{*name};
    if (word == "disable") return Disable{*name};
    if (word == "delete") return Delete{*name};
    if (word == "scope" && of_constraint) {
      return Rescope{*name, scope(static_cast<Scope::Kind>(1 + number_below(5)))};
    }
    if (word == "replace") {
      const auto with =
          of_constraint ? replacement_of(problem_.constraints, *name) : replacement_of(problem_.objective, *name);
      if (with) return Replace{*name, *with};
    }
    return std::nullopt;
  }

  std::mt19937 random_;
  Problem problem_;
  std::vector<Input> known_;  // constants declared so far
  int actions_ = 0;           // how many there will be
};

}  // namespace

Problem random_problem(std::uint32_t seed) { return RandomProblem(seed).make(); }

}  // namespace spacetime::examples
