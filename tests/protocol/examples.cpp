#include "tests/protocol/examples.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace spacetime::examples {
namespace {

int below(std::mt19937& random, int bound) { return static_cast<int>(random() % static_cast<unsigned>(bound)); }
bool coin(std::mt19937& random) { return below(random, 2) == 0; }

Input dof(std::string name, int derivative) { return {InputKind::dof, std::move(name), 0, derivative}; }
Input constant(std::string name) { return {InputKind::constant, std::move(name), 0, 0}; }
Input functional(int index) { return {InputKind::functional, {}, index, 0}; }
Input multiplier(int index) { return {InputKind::multiplier, {}, index, 0}; }
Input time() { return {InputKind::time, {}, 0, 0}; }

void push(Program& program, Op op, std::int32_t a, std::int32_t b = 0, std::int32_t c = 0) {
  program.op.push_back(op);
  program.a.push_back(a);
  program.b.push_back(b);
  program.c.push_back(c);
}

// Marks all operations as needed for the values.
Program values_only(Program program, std::vector<std::int32_t> values) {
  program.values = std::move(values);
  program.value_operations = program.jacobian_operations = static_cast<std::int32_t>(program.op.size());
  return program;
}

// 2 * name
Program twice(const std::string& name) {
  Program program;
  program.inputs = {constant(name)};
  program.numbers = {2};
  push(program, Op::multiply, 0, 1);
  return values_only(std::move(program), {2});
}

// sin(q) - t, with its Jacobian cos(q) and, for the multiplier m, the Hessian -m sin(q)
Program sine_minus_time(const std::string& name) {
  Program program;
  program.inputs = {dof(name, 0), time(), multiplier(0)};
  push(program, Op::sine, 0);         // 3
  push(program, Op::subtract, 3, 1);  // 4
  push(program, Op::cosine, 0);       // 5
  push(program, Op::multiply, 2, 3);  // 6
  push(program, Op::negate, 6);       // 7
  program.values = {4};
  program.jacobian = {{0, 0, 5}};
  program.hessian = {{0, 0, 7}};
  program.value_operations = 2;
  program.jacobian_operations = 3;
  return program;
}

// (f, f * g) of functionals, no trajectories
Program product_of_functionals(int f, int g) {
  Program program;
  program.inputs = {functional(f), functional(g)};
  push(program, Op::multiply, 0, 1);
  program.values = {0, 2};
  program.jacobian = {{0, 0, 2}, {1, 0, 1}, {1, 1, 0}};
  program.value_operations = program.jacobian_operations = 1;
  return program;
}

// q'^2 + f
Program square_plus_functional(const std::string& name, int f) {
  Program program;
  program.inputs = {dof(name, 1), functional(f)};
  push(program, Op::multiply_add, 0, 0, 1);
  return values_only(std::move(program), {2});
}

Program pose(const std::string& name) {
  Program program;
  program.inputs = {dof(name, 0)};
  program.numbers = {0, 1};
  push(program, Op::cosine, 0);  // 3
  push(program, Op::sine, 0);    // 4
  push(program, Op::negate, 4);  // 5
  return values_only(std::move(program), {3, 5, 1, 1, 4, 3, 1, 1, 1, 1, 2, 1});
}

Quantity number(double value) { return {value, {}, 0}; }

std::vector<double> random_knots(std::mt19937& random, double start, double end) {
  std::vector<double> inner;
  for (int i = below(random, 6); i > 0; --i)
    inner.push_back(start + (end - start) * std::ldexp(static_cast<double>(random()), -32));
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  std::erase_if(inner, [&](double t) { return t <= start || t >= end; });
  std::vector<double> knots(4, start);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), 4, end);
  return knots;
}

// Names that a writer must escape, and names in other scripts, now and then.
std::string random_name(std::mt19937& random, const char* prefix, std::size_t index) {
  static const char* const oddities[] = {"", "", "", ".x", " \"q\"", "\\", "/~", "ä€😀"};
  return prefix + std::to_string(index) + oddities[random() % std::size(oddities)];
}

Place random_place(std::mt19937& random) { return {below(random, 3), below(random, 3)}; }

}  // namespace

std::string add(Problem& problem, Program program) {
  auto key = hash(program);
  problem.programs.emplace(key, std::move(program));
  return key;
}

Problem rich_problem() {
  Problem problem;
  problem.start = 0;
  problem.end = 2;
  const auto twice_g = add(problem, twice("g"));
  const auto constraint = add(problem, sine_minus_time("arm.elbow"));
  const auto product = add(problem, product_of_functionals(0, 1));
  const auto square = add(problem, square_plus_functional("arm.elbow", 0));
  const auto pose_program = add(problem, pose("arm.elbow"));
  problem.constants = {{"g", number(9.81), {2, 10}}, {"h", {0, twice_g, 0}, {3, 10}}};
  problem.dofs = {{"arm.elbow", {{0, 0, 0, 0, 0.5, 1.25, 2, 2, 2, 2}}, number(0.1), {5, 3}},
                  {"ball.X", {{0, 0, 0, 0, 2, 2, 2, 2}}, {0, twice_g, 0}, {}}};
  problem.functionals = {{Functional::Kind::integral, constraint, 0, number(0), {{0, twice_g, 0}}},
                         {Functional::Kind::at, square, 0, number(1.5), {}},
                         {Functional::Kind::integral, square, 0, {}, {}}};
  using Kind = Scope::Kind;
  const auto scope = [&](Kind kind) {
    Scope result;
    result.kind = kind;
    if (kind == Kind::times) result.times = {number(0), {0, twice_g, 0}};
    if (kind == Kind::every || kind == Kind::count || kind == Kind::knots) {
      result.from = number(0.5);
      result.to = {0, twice_g, 0};
    }
    if (kind == Kind::every) result.step = number(0.05);
    if (kind == Kind::count) result.count = 11;
    return result;
  };
  problem.constraints = {{"rest", constraint, scope(Kind::times), {}, {9, 1}},
                         {"held", constraint, scope(Kind::every), {}, {10, 1}},
                         {"constraint 3", constraint, scope(Kind::count), number(2.5), {11, 1}},
                         {"constraint 4", constraint, scope(Kind::knots), {{0, twice_g, 0}}, {}},
                         {"total", product, scope(Kind::once), {}, {12, 1}},
                         {"always", constraint, scope(Kind::whole), {}, {13, 1}}};
  problem.objective = {{"energy",
                        number(1),
                        {{Piece::Kind::integral, square, 0, {}, {}},
                         {Piece::Kind::integral, square, 0, number(0.25), number(1)},
                         {Piece::Kind::at, square, 0, number(2), {}},
                         {Piece::Kind::once, product, 1, {}, {}}},
                        {14, 1}},
                       {"objective 2", {0, twice_g, 0}, {}, {}}};
  problem.keyframes = {{number(0.8), {{"arm.elbow", number(-0.8)}, {"ball.X", {0, twice_g, 0}}}, {16, 1}},
                       {{0, twice_g, 0}, {}, {}}};
  problem.plots = {{"swing", square, {0}}, {"pair \"of\" two\\", product, {1, 0}}};
  std::vector<int> outputs(12);
  std::iota(outputs.begin(), outputs.end(), 0);
  using Shape = Body::Shape;
  problem.bodies = {{Shape::capsule, "upper", {number(0.04), number(0.5), number(0), number(0)}, pose_program, outputs},
                    {Shape::sphere, "ball", {{0, twice_g, 0}}, pose_program, outputs},
                    {Shape::box, "crate", {number(1), number(2), number(3)}, pose_program, outputs},
                    {Shape::none, "frame", {}, pose_program, outputs}};
  problem.actions = {{Iterate{0}, {20, 1}}, {Solve{100, 1e-6}, {21, 1}}, {Solve{}, {22, 1}}, {Iterate{5}, {}}};
  return problem;
}

Motion rich_motion() {
  Motion motion;
  motion.start = 0;
  motion.end = 2;
  motion.status = Status::converged;
  motion.message = "Converged: every constraint is kept and nothing near is better.";
  motion.iterations = 61;
  motion.seconds = {0.25, 0.125, 0.0625};
  motion.objective = 5.596;
  motion.terms = {{"energy", 5.5}, {"calm", 0.096}};
  motion.violation = 3e-12;
  motion.violations = {{"goal", 3e-12, 1.6, 27}, {"total", 0, {}, 12}};
  motion.dofs = {{"arm.shoulder", {{0, 0, 0, 0, 0.5, 2, 2, 2, 2}}, {0, 0.1, -0.25, 1e-17, 3}},
                 {"ball.X", {{0, 0, 0, 0, 2, 2, 2, 2}}, {1, 2, 3, 4}}};
  motion.constants = {{"release", 1}, {"g", 9.81}};
  motion.parameters = {{"speed", 2.5}, {"aim", -0.125}};
  motion.record = {{0, 7.5, 0.25, 1, 0, 0, 0.03125}, {1, 5.596, 3e-12, 4e-9, 0.5, 1e-3, 0.25}};
  motion.samples = Samples{{0, 1, 2},
                           {{"hand", {{1, 2}, {3, 4}, {5, 6}}}, {"swing", {{0}, {0.5}, {1}}}},
                           {{"upper", std::vector<std::vector<double>>(3, std::vector<double>(12, 0.5))}}};
  return motion;
}

double random_number(std::mt19937& random) {
  using Limits = std::numeric_limits<double>;
  switch (below(random, 10)) {
    case 0:
      return coin(random) ? 0.0 : -0.0;
    case 1:
      return coin(random) ? Limits::denorm_min() : -Limits::min() / 3;
    case 2:
      return coin(random) ? Limits::max() : 1e308;
    case 3:
      return below(random, 2000) - 1000;
    case 4:
      return std::ldexp(below(random, 1000), below(random, 80));  // integers, most beyond 64 bits
    case 5:
      return below(random, 2000) / 100.0;
    default:
      break;
  }
  for (;;) {
    const auto bits = std::uint64_t{random()} << 32 | random();
    if (const auto value = std::bit_cast<double>(bits); std::isfinite(value)) return value;
  }
}

Program random_program(std::mt19937& random, std::vector<Input> inputs, int operations) {
  Program program;
  std::vector<int> unknowns;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (is_unknown(inputs[i].kind)) unknowns.push_back(static_cast<int>(i));
  }
  program.inputs = std::move(inputs);
  const auto values = 1 + below(random, 3);
  const bool second = !unknowns.empty() && coin(random);
  if (second) {
    for (int i = 0; i < values; ++i) program.inputs.push_back(multiplier(i));
  }
  program.numbers.push_back(random_number(random));
  for (int i = below(random, 4); i > 0; --i) program.numbers.push_back(random_number(random));
  for (int i = 0; i < operations; ++i) {
    const auto own = program.value_count();
    const auto op = static_cast<Op>(below(random, op_count));
    std::int32_t operands[3] = {0, 0, 0};
    for (int k = 0; k < info(op).arity; ++k) operands[k] = below(random, own);
    push(program, op, operands[0], operands[1], operands[2]);
  }
  program.value_operations = below(random, operations + 1);
  program.jacobian_operations = program.value_operations + below(random, operations + 1 - program.value_operations);
  const auto first = program.first_operation();
  for (int i = 0; i < values; ++i) program.values.push_back(below(random, first + program.value_operations));
  for (int row = 0; row < values; ++row) {
    for (const int input : unknowns) {
      if (coin(random)) program.jacobian.push_back({row, input, below(random, first + program.jacobian_operations)});
    }
  }
  for (const int row : unknowns) {
    for (const int column : unknowns) {
      if (second && column <= row && coin(random)) {
        program.hessian.push_back({row, column, below(random, program.value_count())});
      }
    }
  }
  return program;
}

Problem random_problem(std::uint32_t seed) {
  std::mt19937 random(seed);
  Problem problem;
  problem.start = below(random, 100) - 50.25;
  problem.end = problem.start + 0.1 + below(random, 100);
  std::vector<Input> known;  // constants declared so far
  const auto quantity = [&]() -> Quantity {
    if (coin(random)) return number(random_number(random));
    const auto program = random_program(random, known, below(random, 5));
    const auto output = below(random, static_cast<int>(program.values.size()));
    return {0, add(problem, program), output};
  };
  const auto optional = [&]() { return coin(random) ? std::optional(quantity()) : std::nullopt; };
  for (int i = below(random, 4); i > 0; --i) {
    const auto name = random_name(random, "c", problem.constants.size());
    auto value = quantity();
    problem.constants.push_back({name, std::move(value), random_place(random)});
    known.push_back(constant(name));
  }
  for (int i = 1 + below(random, 3); i > 0; --i) {
    auto start = quantity();
    problem.dofs.push_back({random_name(random, "q", problem.dofs.size()),
                            {random_knots(random, problem.start, problem.end)},
                            std::move(start),
                            random_place(random)});
  }
  // Inputs of a statement: some of everything there is; `timeless` without time and trajectories.
  const auto statement = [&](bool timeless) {
    auto inputs = known;
    for (std::size_t i = 0; i < problem.functionals.size(); ++i) {
      if (coin(random)) inputs.push_back(functional(static_cast<int>(i)));
    }
    if (!timeless) {
      for (const auto& each : problem.dofs) {
        for (int d = 0; d < 3; ++d) {
          if (coin(random)) inputs.push_back(dof(each.name, d));
        }
      }
      if (coin(random)) inputs.push_back(time());
    }
    std::shuffle(inputs.begin(), inputs.end(), random);
    return random_program(random, std::move(inputs), below(random, 40));
  };
  for (int i = below(random, 3); i > 0; --i) {
    const auto program = statement(false);
    Functional each{Functional::Kind::integral, add(problem, program), 0, optional(), optional()};
    each.output = below(random, static_cast<int>(program.values.size()));
    if (coin(random)) {
      each.kind = Functional::Kind::at;
      each.from = quantity();
      each.to.reset();
    }
    problem.functionals.push_back(std::move(each));
  }
  for (int i = below(random, 4); i > 0; --i) {
    Scope scope;
    scope.kind = static_cast<Scope::Kind>(below(random, 6));
    if (scope.kind == Scope::Kind::times) {
      for (int k = 1 + below(random, 3); k > 0; --k) scope.times.push_back(quantity());
    } else if (scope.kind != Scope::Kind::once && scope.kind != Scope::Kind::whole) {
      scope.from = number(problem.start);
      scope.to = number(problem.end);
      if (scope.kind == Scope::Kind::every) scope.step = number(0.25 + below(random, 5));
      if (scope.kind == Scope::Kind::count) scope.count = 2 + below(random, 9);
    }
    auto key = add(problem, statement(scope.kind == Scope::Kind::once));
    auto weight = optional();
    if (weight && weight->program.empty()) weight->number = std::abs(weight->number);
    problem.constraints.push_back({random_name(random, "constraint ", problem.constraints.size()), std::move(key),
                                   std::move(scope), std::move(weight), random_place(random)});
  }
  for (int i = below(random, 3); i > 0; --i) {
    Term term{random_name(random, "objective ", problem.objective.size()), quantity(), {}, random_place(random)};
    for (int k = below(random, 4); k > 0; --k) {
      Piece piece;
      piece.kind = static_cast<Piece::Kind>(below(random, 3));
      piece.program = add(problem, statement(piece.kind == Piece::Kind::once));
      if (piece.kind == Piece::Kind::integral) piece.from = optional();
      if (piece.kind == Piece::Kind::at) piece.from = quantity();
      term.pieces.push_back(std::move(piece));
    }
    problem.objective.push_back(std::move(term));
  }
  for (int i = below(random, 3); i > 0; --i) {
    Keyframe keyframe{quantity(), {}, random_place(random)};
    for (const auto& each : problem.dofs) {
      if (coin(random)) keyframe.keys.push_back({each.name, quantity()});
    }
    problem.keyframes.push_back(std::move(keyframe));
  }
  const auto sampled = [&](int outputs) {
    Program program;
    program.inputs = {dof(problem.dofs.front().name, below(random, 3)), time()};
    for (int k = 0; k < outputs; ++k) program.values.push_back(below(random, 2));
    return add(problem, std::move(program));
  };
  for (int i = below(random, 3); i > 0; --i) {
    problem.plots.push_back({random_name(random, "plot", problem.plots.size()), sampled(2), {below(random, 2)}});
  }
  for (int i = below(random, 3); i > 0; --i) {
    Body body{static_cast<Body::Shape>(below(random, 4)),
              random_name(random, "body", problem.bodies.size()),
              {},
              sampled(12),
              std::vector<int>(12, 3)};
    const int sizes[] = {4, 1, 3, 0};
    for (int k = sizes[static_cast<int>(body.shape)]; k > 0; --k) body.size.push_back(quantity());
    problem.bodies.push_back(std::move(body));
  }
  for (int i = below(random, 4); i > 0; --i) {
    PlacedAction action{Iterate{below(random, 9)}, random_place(random)};
    if (coin(random)) {
      Solve solve;
      if (coin(random)) solve.iterations = below(random, 9);
      if (coin(random)) solve.tolerance = 1e-3 / (1 + below(random, 99));
      action.action = solve;
    }
    problem.actions.push_back(action);
  }
  return problem;
}

Motion random_motion(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto value = [&] { return random_number(random); };
  Motion motion;
  motion.start = below(random, 100) - 50.25;
  motion.end = motion.start + 0.1 + below(random, 100);
  motion.status = static_cast<Status>(below(random, 4));
  motion.message = random_name(random, "message ", 1);
  motion.iterations = below(random, 1000);
  motion.seconds = {value(), value(), value()};
  motion.objective = value();
  motion.violation = value();
  for (std::size_t i = 0; i < random() % 4; ++i) motion.terms.emplace_back(random_name(random, "term ", i), value());
  for (std::size_t i = 0; i < random() % 4; ++i) {
    motion.violations.push_back({random_name(random, "constraint ", i), value(), {}, below(random, 3)});
    if (coin(random)) motion.violations.back().time = value();
  }
  for (std::size_t i = 0; i < random() % 4; ++i) {
    Trajectory dof{random_name(random, "q", i), {random_knots(random, motion.start, motion.end)}, {}};
    for (int k = 0; k < dof.basis.size(); ++k) dof.coefficients.push_back(value());
    motion.dofs.push_back(std::move(dof));
  }
  for (std::size_t i = 0; i < random() % 9; ++i) motion.constants.emplace_back(random_name(random, "c", i), value());
  for (std::size_t i = 0; i < random() % 3; ++i) motion.parameters.emplace_back(random_name(random, "p", i), value());
  for (int i = below(random, 4); i > 0; --i) {
    motion.record.push_back({below(random, 1000), value(), value(), value(), value(), value(), value()});
  }
  if (!coin(random)) return motion;
  Samples samples;
  for (int i = below(random, 4); i > 0; --i) samples.times.push_back(value());
  const auto table = [&](int columns) {
    std::vector<std::vector<double>> rows(samples.times.size());
    for (auto& row : rows) {
      for (int k = 0; k < columns; ++k) row.push_back(value());
    }
    return rows;
  };
  for (std::size_t i = 0; i < random() % 3; ++i)
    samples.values[random_name(random, "plot", i)] = table(below(random, 4));
  for (std::size_t i = 0; i < random() % 3; ++i) samples.poses[random_name(random, "body", i)] = table(12);
  motion.samples = std::move(samples);
  return motion;
}

}  // namespace spacetime::examples
