#include "common/program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "common/motion.h"

namespace spacetime {
namespace {

// c = (x^2 + y p, p), with its derivatives by x, y and p.
Program example() {
  Program program;
  program.inputs = {{InputKind::dof, "x", 0, 0},
                    {InputKind::dof, "y", 0, 2},
                    {InputKind::parameter, "p", 0, 0},
                    {InputKind::multiplier, "", 0, 0},
                    {InputKind::time, "", 0, 0}};
  program.numbers = {2, 0};
  program.op = {Op::multiply, Op::multiply_add, Op::multiply, Op::multiply};
  program.a = {0, 1, 0, 3};
  program.b = {0, 2, 5, 5};
  program.c = {0, 7, 0, 0};
  program.values = {8, 2};
  program.jacobian = {{0, 0, 9}, {0, 1, 2}, {0, 2, 1}};
  program.hessian = {{0, 0, 10}, {2, 1, 3}};
  program.value_operations = 2;
  program.jacobian_operations = 3;
  return program;
}

TEST(Program, ExampleIsValid) {
  EXPECT_FALSE(validate(example()));
  EXPECT_FALSE(validate(Program{}));
}

struct Refusal {
  const char* name;
  const char* path;
  std::function<void(Program&)> spoil;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

const Refusal refusals[] = {
    {"ShortA", "a", [](Program& p) { p.a.pop_back(); }},
    {"LongB", "b", [](Program& p) { p.b.push_back(0); }},
    {"ShortC", "c", [](Program& p) { p.c.clear(); }},
    {"UnknownOp", "op/1", [](Program& p) { p.op[1] = static_cast<Op>(op_count); }},
    {"OwnOperand", "a/1", [](Program& p) { p.a[1] = 8; }},
    {"LaterOperand", "b/0", [](Program& p) { p.b[0] = 9; }},
    {"NegativeOperand", "c/1", [](Program& p) { p.c[1] = -1; }},
    {"UnusedOperand", "c/2", [](Program& p) { p.c[2] = 1; }},
    {"UnusedNegative", "c/3", [](Program& p) { p.c[3] = -1; }},
    {"ValueTooLate", "values/0", [](Program& p) { p.values[0] = 9; }},
    {"ValueOutOfRange", "values/1", [](Program& p) { p.values[1] = 1000; }},
    {"ValueNegative", "values/1", [](Program& p) { p.values[1] = -1; }},
    {"JacobianTooLate", "jacobian/0/value", [](Program& p) { p.jacobian[0].value = 10; }},
    {"JacobianOutOfRange", "jacobian/2/value", [](Program& p) { p.jacobian[2].value = -7; }},
    {"JacobianRow", "jacobian/2/row", [](Program& p) { p.jacobian[2].row = 2; }},
    {"JacobianNegativeRow", "jacobian/0/row", [](Program& p) { p.jacobian[0].row = -1; }},
    {"JacobianInput", "jacobian/2/input", [](Program& p) { p.jacobian[2].input = 5; }},
    {"JacobianNegativeInput", "jacobian/0/input", [](Program& p) { p.jacobian[0].input = -1; }},
    {"JacobianByMultiplier", "jacobian/2/input", [](Program& p) { p.jacobian[2].input = 3; }},
    {"JacobianByTime", "jacobian/2/input", [](Program& p) { p.jacobian[2].input = 4; }},
    {"JacobianTwice", "jacobian/1", [](Program& p) { p.jacobian[1] = p.jacobian[0]; }},
    {"JacobianOrder", "jacobian/1", [](Program& p) { std::swap(p.jacobian[0], p.jacobian[1]); }},
    {"HessianOutOfRange", "hessian/0/value", [](Program& p) { p.hessian[0].value = 11; }},
    {"HessianNegative", "hessian/0/value", [](Program& p) { p.hessian[0].value = -1; }},
    {"HessianRow", "hessian/1/row", [](Program& p) { p.hessian[1].row = 9; }},
    {"HessianColumn", "hessian/1/column", [](Program& p) { p.hessian[1].column = -1; }},
    {"HessianByTime", "hessian/1/row", [](Program& p) { p.hessian[1].row = 4; }},
    {"HessianByMultiplier", "hessian/1/column", [](Program& p) { p.hessian[1].column = 3; }},
    {"HessianUpper", "hessian/1/column", [](Program& p) { std::swap(p.hessian[1].row, p.hessian[1].column); }},
    {"HessianTwice", "hessian/1", [](Program& p) { p.hessian[1] = p.hessian[0]; }},
    {"HessianOrder", "hessian/1", [](Program& p) { std::swap(p.hessian[0], p.hessian[1]); }},
    {"PrefixesOutOfOrder", "value_operations", [](Program& p) { p.value_operations = 4; }},
    {"PrefixNegative", "value_operations", [](Program& p) { p.value_operations = -1; }},
    {"PrefixTooLong", "jacobian_operations", [](Program& p) { p.jacobian_operations = 5; }},
    {"PrefixNegativeToo", "jacobian_operations", [](Program& p) { p.jacobian_operations = -1; }},
    {"Infinite", "numbers/0", [](Program& p) { p.numbers[0] = INFINITY; }},
    {"NotANumber", "numbers/1", [](Program& p) { p.numbers[1] = NAN; }},
    {"ThirdDerivative", "inputs/1/derivative", [](Program& p) { p.inputs[1].derivative = 3; }},
    {"NegativeDerivative", "inputs/0/derivative", [](Program& p) { p.inputs[0].derivative = -1; }},
    {"ParametersDerivative", "inputs/2/derivative", [](Program& p) { p.inputs[2].derivative = 1; }},
    {"TimesDerivative", "inputs/4/derivative", [](Program& p) { p.inputs[4].derivative = 1; }},
    {"InputTwice", "inputs/1", [](Program& p) { p.inputs[1] = p.inputs[0]; }},
    {"TimeTwice", "inputs/5", [](Program& p) { p.inputs.push_back({}); }},
    {"MultiplierOutOfRange", "inputs/3/index", [](Program& p) { p.inputs[3].index = 2; }},
    {"NegativeIndex", "inputs/3/index", [](Program& p) { p.inputs[3].index = -1; }},
    {"IndexOfADof", "inputs/0/index", [](Program& p) { p.inputs[0].index = 1; }},
    {"NamelessDof", "inputs/0/name", [](Program& p) { p.inputs[0].name.clear(); }},
    {"NamelessParameter", "inputs/2/name", [](Program& p) { p.inputs[2].name.clear(); }},
    {"NamelessConstant", "inputs/4/name", [](Program& p) { p.inputs[4].kind = InputKind::constant; }},
    {"NamelessSignal", "inputs/4/name", [](Program& p) { p.inputs[4].kind = InputKind::signal; }},
    {"NamedTime", "inputs/4/name", [](Program& p) { p.inputs[4].name = "t"; }},
    {"UnknownKind", "inputs/4/kind", [](Program& p) { p.inputs[4].kind = static_cast<InputKind>(7); }},
};

class ProgramRefusal : public testing::TestWithParam<Refusal> {};
TEST_P(ProgramRefusal, NamesThePath) {
  auto program = example();
  GetParam().spoil(program);
  const auto fault = validate(program);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->path, GetParam().path) << fault->message;
  EXPECT_FALSE(fault->message.empty());
}
INSTANTIATE_TEST_SUITE_P(Each, ProgramRefusal, testing::ValuesIn(refusals),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Program, Prints) {
  EXPECT_EQ(print(example()),
            "%0 = dof x\n"
            "%1 = dof y''\n"
            "%2 = parameter p\n"
            "%3 = multiplier 0\n"
            "%4 = time\n"
            "%5 = 2\n"
            "%6 = 0\n"
            "%7 = mul %0 %0\n"
            "%8 = mul_add %1 %2 %7\n"
            "value 0 = %8\n"
            "value 1 = %2\n"
            "%9 = mul %0 %5\n"
            "jacobian 0 %0 = %9\n"
            "jacobian 0 %1 = %2\n"
            "jacobian 0 %2 = %1\n"
            "%10 = mul %3 %5\n"
            "hessian %0 %0 = %10\n"
            "hessian %2 %1 = %3\n");
}

TEST(Program, HashIsPinned) {  // computed by another program from the published FNV-1a; files are named by it
  EXPECT_EQ(hash(Program{}), "bdfd4eb7812d369ad8432a124f146a2d");
  EXPECT_EQ(hash(example()), "0675cbdd52cf9da99e365477e5ca0f9a");
}

TEST(Program, HashTellsEveryDifference) {
  std::set<std::string> hashes = {hash(example())};
  const std::function<void(Program&)> changes[] = {[](Program& p) { p.inputs[0].name = "z"; },
                                                   [](Program& p) { p.inputs[1].derivative = 1; },
                                                   [](Program& p) { p.inputs[3].index = 1; },
                                                   [](Program& p) { p.inputs[0].kind = InputKind::signal; },
                                                   [](Program& p) { p.inputs.pop_back(); },
                                                   [](Program& p) { p.numbers[0] = std::nextafter(2.0, 3.0); },
                                                   [](Program& p) { p.numbers[1] = -0.0; },
                                                   [](Program& p) { p.op[0] = Op::add; },
                                                   [](Program& p) { p.a[1] = 0; },
                                                   [](Program& p) { p.b[1] = 0; },
                                                   [](Program& p) { p.c[1] = 0; },
                                                   [](Program& p) { p.values[1] = 0; },
                                                   [](Program& p) { p.values.pop_back(); },
                                                   [](Program& p) { p.jacobian[2].row = 1; },
                                                   [](Program& p) { p.jacobian[0].value = 0; },
                                                   [](Program& p) { p.jacobian[0].input = 1; },
                                                   [](Program& p) { p.jacobian.pop_back(); },
                                                   [](Program& p) { p.hessian[0].row = 1; },
                                                   [](Program& p) { p.hessian[1].column = 0; },
                                                   [](Program& p) { p.hessian[0].value = 0; },
                                                   [](Program& p) { p.hessian.clear(); },
                                                   [](Program& p) { p.value_operations = 1; },
                                                   [](Program& p) { p.jacobian_operations = 4; }};
  for (const auto& change : changes) {
    auto program = example();
    change(program);
    EXPECT_TRUE(hashes.insert(hash(program)).second) << print(program);
  }
  EXPECT_EQ(hash(example()), *hashes.find(hash(example())));
}

TEST(Program, TablesHaveTheDocumentsNames) {
  const char* const names[] = {"add",  "sub", "mul", "div", "neg",  "mul_add", "abs",  "sign",  "sqrt", "min",
                               "max",  "sin", "cos", "tan", "asin", "acos",    "atan", "atan2", "sinh", "cosh",
                               "tanh", "exp", "log", "pow", "lt",   "le",      "and",  "or",    "not",  "select"};
  ASSERT_EQ(std::size(names), static_cast<std::size_t>(op_count));
  for (int i = 0; i < op_count; ++i) {
    EXPECT_EQ(info(static_cast<Op>(i)).name, names[i]);
    EXPECT_EQ(op_named(names[i]), static_cast<Op>(i));
  }
  EXPECT_FALSE(op_named("plus"));
  EXPECT_EQ(info(Op::multiply_add).arity, 3);
  EXPECT_EQ(info(Op::arc_tangent2).arity, 2);
  EXPECT_EQ(info(Op::logical_not).arity, 1);
  EXPECT_FALSE(info(Op::minimum).commutative);  // at a tie the first decides

  const char* const kinds[] = {"dof", "signal", "constant", "parameter", "functional", "time", "multiplier"};
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(name_of(static_cast<InputKind>(i)), kinds[i]);
    EXPECT_EQ(input_kind_named(kinds[i]), static_cast<InputKind>(i));
  }
  EXPECT_FALSE(input_kind_named("knob"));
  EXPECT_EQ(name_of(Status::infeasible), "infeasible");
}

}  // namespace
}  // namespace spacetime
