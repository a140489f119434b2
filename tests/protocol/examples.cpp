#include "tests/protocol/examples.h"

#include <numeric>
#include <utility>

#include "protocol/checkpoint_json.h"

namespace spacetime::examples {
namespace {

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

// (q - p, 1/2 p^2) of a parameter p
Program less_a_parameter(const std::string& name, const std::string& p) {
  Program program;
  program.inputs = {dof(name, 0), parameter(p)};
  program.numbers = {0.5, 1, -1};
  push(program, Op::subtract, 0, 1);  // 5
  push(program, Op::multiply, 1, 1);  // 6
  push(program, Op::multiply, 2, 6);  // 7
  program.values = {5, 7};
  program.jacobian = {{0, 0, 3}, {0, 1, 4}, {1, 1, 1}};
  program.value_operations = program.jacobian_operations = 3;
  return program;
}

// q' < p and t <= p
Program moving_slowly(const std::string& name, const std::string& p) {
  Program program;
  program.inputs = {time(), dof(name, 1), parameter(p)};
  push(program, Op::less, 1, 2);         // 3
  push(program, Op::less_equal, 0, 2);   // 4
  push(program, Op::logical_and, 3, 4);  // 5
  return values_only(std::move(program), {5});
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

}  // namespace

Input dof(std::string name, int derivative) { return {InputKind::dof, std::move(name), 0, derivative}; }
Input constant(std::string name) { return {InputKind::constant, std::move(name), 0, 0}; }
Input parameter(std::string name) { return {InputKind::parameter, std::move(name), 0, 0}; }
Input functional(int index) { return {InputKind::functional, {}, index, 0}; }
Input multiplier(int index) { return {InputKind::multiplier, {}, index, 0}; }
Input time() { return {InputKind::time, {}, 0, 0}; }

void push(Program& program, Op op, std::int32_t a, std::int32_t b, std::int32_t c) {
  program.op.push_back(op);
  program.a.push_back(a);
  program.b.push_back(b);
  program.c.push_back(c);
}

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
  const auto aimed = add(problem, less_a_parameter("arm.elbow", "aim"));
  const auto slow = add(problem, moving_slowly("ball.X", "speed"));
  problem.constants = {{"g", number(9.81), {2, 10}},
                       {"h", {0, twice_g, 0}, {3, 10}},
                       {"spans", number(3), {4, 10}, Place{5, 24}},
                       {"count", number(11), {}, Place{}}};
  problem.parameters = {{"speed", number(2.5), {6, 11}}, {"aim", {0, twice_g, 0}, {}}};
  problem.parameters[0].lower = number(0);
  problem.parameters[0].upper = {0, twice_g, 0};
  problem.dofs = {{"arm.elbow", {{0, 0, 0, 0, 0.5, 1.25, 2, 2, 2, 2}}, number(0.1), {7, 3}},
                  {"ball.X", {{0, 0, 0, 0, 2, 2, 2, 2}}, {0, twice_g, 0}, {}}};
  problem.dofs[0].lower = number(-2.8);
  problem.dofs[0].upper = number(0.05);
  problem.dofs[1].upper = {0, twice_g, 0};
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
                         {"always", constraint, scope(Kind::whole), {}, {13, 1}},
                         {"reach", aimed, scope(Kind::knots), number(4), {14, 1}},
                         {"rest", aimed, scope(Kind::whole), {}, {23, 1}}};
  problem.constraints[6].relation = Constraint::Relation::at_most;
  problem.constraints[6].condition = {slow, 0};
  problem.constraints[6].since = 2;
  problem.constraints[7].replacement = true;
  problem.objective = {{"energy",
                        number(1),
                        {{Piece::Kind::integral, square, 0, {}, {}},
                         {Piece::Kind::integral, square, 0, number(0.25), number(1)},
                         {Piece::Kind::at, square, 0, number(2), {}},
                         {Piece::Kind::once, product, 1, {}, {}}},
                        {14, 1}},
                       {"objective 2", {0, twice_g, 0}, {}, {}, 1},
                       {"energy", number(3), {{Piece::Kind::once, product, 0, {}, {}}}, {24, 1}, 4, true}};
  problem.keyframes = {{number(0.8), {{"arm.elbow", number(-0.8)}, {"ball.X", {0, twice_g, 0}}}, {16, 1}},
                       {{0, twice_g, 0}, {}, {}, 3}};
  problem.plots = {{"swing", square, {0}}, {"pair \"of\" two\\", product, {1, 0}}};
  std::vector<int> outputs(12);
  std::iota(outputs.begin(), outputs.end(), 0);
  using Shape = Body::Shape;
  problem.bodies = {{Shape::capsule, "upper", {number(0.04), number(0.5), number(0), number(0)}, pose_program, outputs},
                    {Shape::sphere, "ball", {{0, twice_g, 0}}, pose_program, outputs},
                    {Shape::box, "crate", {number(1), number(2), number(3)}, pose_program, outputs},
                    {Shape::none, "frame", {}, pose_program, outputs}};
  problem.actions = {{Iterate{0}, {20, 1}}, {Solve{100, 1e-6}, {21, 1}},   {Solve{}, {22, 1}},
                     {Iterate{5}, {}},      {Replace{"rest", 7}, {23, 1}}, {Replace{"energy", 2}, {24, 1}}};
  return problem;
}

Problem busy_problem() {
  Problem problem;
  problem.start = 0;
  problem.end = 2;
  const auto program = add(problem, sine_minus_time("q"));
  const Quantity twice_g{0, add(problem, twice("g")), 0};
  problem.constants = {
      {"g", number(9.81), {}}, {"spans", number(12), {}, Place{5, 24}}, {"count", number(3), {}, Place{}}};
  problem.dofs = {{"q", {{0, 0, 0, 0, 1, 2, 2, 2, 2}}, number(0), {}},
                  {"p", {{0, 0, 0, 0, 2, 2, 2, 2}}, number(0), {}}};
  Scope at;
  at.kind = Scope::Kind::times;
  at.times = {number(1)};
  problem.constraints = {{"goal", program, at, {}, {}}, {"goal", program, at, {}, {}}, {"late", program, {}, {}, {}}};
  problem.constraints[1].replacement = true;
  problem.constraints[2].since = 11;
  problem.objective = {{"energy", number(1), {{Piece::Kind::integral, program, 0, {}, {}}}, {}},
                       {"energy", number(1), {{Piece::Kind::at, program, 0, number(2), {}}}, {}, 0, true}};
  Scope every;
  every.kind = Scope::Kind::every;
  every.to = number(2);
  every.step = twice_g;
  problem.actions = {
      {Solve{50, 1e-6, Solve::Method::sqp92, true, 3}, {10, 1}},
      {Iterate{4}, {11, 1}},
      {Window{Interval{number(0.25), twice_g}, {"q"}}, {12, 1}},
      {Window{}, {13, 1}},
      {Refine{Interval{number(0), number(1)}, {"q"}, 2, {}}, {14, 1}},
      {Refine{{}, {}, 1, number(1e-3)}, {15, 1}},
      {Shake{number(0.1), 7, {"q", "p"}}, {16, 1}},
      {Smooth{number(0.5), {"q"}}, {17, 1}},
      {Damp{twice_g, {"p"}}, {18, 1}},
      {Adapt{number(1e-4), 3}, {19, 1}},
      {Lock{2}, {20, 1}},
      {SetConstant{"g", twice_g}, {21, 1}},
      {SetWeight{"goal", number(5)}, {22, 1}},
      {SetWeight{"goal", {}}, {23, 1}},
      {SetWeight{"energy", twice_g}, {24, 1}},
      {Disable{"goal"}, {25, 1}},
      {Enable{"energy"}, {26, 1}},
      {Replace{"goal", 1}, {27, 1}},
      {Replace{"energy", 1}, {28, 1}},
      {Rescope{"goal", every}, {29, 1}},
      {Bound{"q", number(-1), twice_g}, {30, 1}},
      {PullKeys{number(1), {{"q", number(0.5)}, {"p", twice_g}}}, {31, 1}},
      {Control{"p", 3, number(-0.5)}, {32, 1}},
      {Delete{"late"}, {33, 1}},
      {Reset{}, {34, 1}},
      {Solve{}, {}},
      {Refine{}, {}},
      {Shake{number(0), {}, {}}, {}},
      {Smooth{number(0), {}}, {}},
      {Damp{number(1), {}}, {}},
      {Adapt{twice_g, {}}, {}},
  };
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
  motion.violations = {{"goal", 3e-12, 1.6, 27, Multiplier{-4.5, 1.6}}, {"total", 0, {}, 12}};
  motion.dofs = {{"arm.shoulder", {{0, 0, 0, 0, 0.5, 2, 2, 2, 2}}, {0, 0.1, -0.25, 1e-17, 3}},
                 {"ball.X", {{0, 0, 0, 0, 2, 2, 2, 2}}, {1, 2, 3, 4}}};
  motion.constants = {{"release", 1}, {"g", 9.81}};
  motion.parameters = {{"speed", 2.5}, {"aim", -0.125}};
  motion.record = {{0, 7.5, {{"energy", 7}, {"calm", 0.5}}, 0.25, 1, 0, 0, 0.03125},
                   {1, 5.596, {{"energy", 5.5}, {"calm", 0.096}}, 3e-12, 4e-9, 0.5, 1e-3, 0.25}};
  motion.multipliers = {{"goal", 27, {0.5, 1.6}, {{1, -4.5}, {0, 2}}}, {"total", 12, {}, {{0.25}}}};
  motion.samples = Samples{{0, 1, 2},
                           {{"hand", {{1, 2}, {3, 4}, {5, 6}}}, {"swing", {{0}, {0.5}, {1}}}},
                           {{"upper", std::vector<std::vector<double>>(3, std::vector<double>(12, 0.5))}}};
  Problem problem;
  std::vector<int> outputs(12);
  std::iota(outputs.begin(), outputs.end(), 0);
  const auto program = add(problem, pose("arm.shoulder")), size = add(problem, twice("g"));
  motion.bodies = {{Body::Shape::sphere, "ball", {{0, size, 0}}, program, outputs},
                   {Body::Shape::none, "frame", {}, program, outputs}};
  motion.programs = problem.programs;
  Checkpoint checkpoint;
  checkpoint.problem = "0123456789abcdef0123456789abcdef";
  checkpoint.progress = {2, 12};
  checkpoint.declared = 2;
  checkpoint.edits = {SetConstant{"g", {1.62, {}, 0}}, Disable{"goal"}};
  checkpoint.window = {Interval{{0.5, {}, 0}, {1.5, {}, 0}}, {"ball.X"}};
  checkpoint.damping = {{"ball.X", 0.125}};
  checkpoint.shakes = 3;
  checkpoint.start = {{motion.dofs[1]}, {{"speed", 2}}};
  checkpoint.judged = true;
  checkpoint.functionals = {5.5, -0.5};
  checkpoint.outside = {0.75, {0.5, 0.25}, {0.5, 0}};
  checkpoint.step = 0.25;
  checkpoint.last_shift = 1e-3;
  checkpoint.pivoted = 1;
  checkpoint.newton = {1e-3,   {1, 2}, {3e-4, 5e-4}, {0.5}, {0.25, 0.125}, true, {1, 0}, {0, 3}, {{1, 2}, {0.5, 2.5}},
                       1.25e4, 1.25,   0.01,         0.6,   0.5,           1e-8, true,   2.5,    7,
                       {-3, 4}};
  checkpoint.sqp92 = {{1, -2}, {1, 2}};
  motion.checkpoint = checkpoint;
  motion.checkpoint->fingerprint = fingerprint(motion);
  return motion;
}

}  // namespace spacetime::examples
