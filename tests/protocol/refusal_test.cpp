// Every rule broken once: the path is exact and the sentence says what was expected and what was found.
#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/check.h"
#include "protocol/checkpoint_json.h"
#include "protocol/limits.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "tests/protocol/refusal.h"

namespace spacetime {
namespace {

void expect_problem_refusals(const std::vector<Case>& cases) {
  expect_refusals(write(examples::rich_problem()), cases, [](const std::string& text) { return read_problem(text); });
}

void expect_motion_refusals(const std::vector<Case>& cases) {
  expect_refusals(write(examples::rich_motion()), cases, [](const std::string& text) { return read_motion(text); });
}

TEST(ProblemRefuses, WrongForms) {
  expect_problem_refusals({
      {"/format", R"("spacetime-problem/2")", nullptr,
       R"(expected "spacetime-problem/1", found "spacetime-problem/2")"},
      {"/format", "1", nullptr, R"(expected "spacetime-problem/1", found 1)"},
      {"/format", none, "", R"(the member "format" is missing)"},
      {"/dofs", none, "", R"(the member "dofs" is missing)"},
      {"/surplus", "1", nullptr, "unknown member; known here: \"format\", "},
      {"/dofs/0/Start", "1", nullptr, R"(known here: "name", "basis", "start", "lower", "upper", "line" or "column")"},
      {"/time", "[0]", nullptr, "expected a list of 2 numbers, found a list of 1"},
      {"/time/1", "null", nullptr, "expected a number, found null"},
      {"/dofs/0/basis/knots/7", R"("abc")", nullptr, R"(expected a number, found "abc")"},
      {"/dofs/0/basis/kind", R"("wavelet")", nullptr, R"(expected "bspline", found "wavelet")"},
      {"/dofs/1", "[1, 2, 3]", nullptr, "expected an object, found a list of 3"},
      {"/dofs", "{}", nullptr, "expected a list, found an object"},
      {"/dofs/0/line", "0", nullptr, "expected an integer of at least 1, found 0"},
      {"/dofs/0/column", "1.5", nullptr, "expected an integer of at least 1, found 1.5"},
      {"/parameters", none, "", R"(the member "parameters" is missing)"},
      {"/parameters/0/start", none, "/parameters/0", R"(the member "start" is missing)"},
      {"/parameters/0/basis", "1", nullptr, R"("name", "start", "lower", "upper", "line" or "column")"},
      {"/parameters/0/lower", "null", nullptr, "found null"},
      {"/dofs/0/upper", R"("high")", nullptr, R"(found "high")"},
      {"/constants/2/frozen", "true", nullptr, "expected an object, found true"},
      {"/constants/2/frozen/line", "0", nullptr, "expected an integer of at least 1, found 0"},
      {"/constants/2/frozen/file", R"("x")", nullptr, R"(unknown member; known here: "line" or "column")"},
      {"/constraints/6/condition", "1", nullptr, "expected an object, found 1"},
      {"/constraints/6/condition/output", none, "/constraints/6/condition", R"("output" is missing)"},
      {"/constraints/6/condition/index", "1", nullptr, R"(known here: "program" or "output")"},
      {"/constraints/6/since", "-1", nullptr, "expected an integer of at least 0, found -1"},
      {"/constraints/7/replacement", "1", nullptr, "expected true or false, found 1"},
      {"/objective/2/since", "0.5", nullptr, "found 0.5"},
      {"/objective/2/replacement", R"("yes")", nullptr, R"(expected true or false, found "yes")"},
      {"/dofs/0/start", "true", nullptr, "expected a number, or an object with program and output, found true"},
      {"/dofs/0/start", R"({"program": "TWICE"})", nullptr, R"(the member "output" is missing)"},
      {"/dofs/0/start", R"({"program": "", "output": 0})", "/dofs/0/start/program", R"(found "")"},
      {"/dofs/0/start", R"({"program": "TWICE", "output": -1})", "/dofs/0/start/output", "found -1"},
      {"/programs", "[]", nullptr, "expected an object, found a list of 0"},
      {"/programs/SINE/inputs/0/kind", R"("joint")", nullptr, R"(expected a kind of input (dof, signal, )"},
      {"/programs/SINE/inputs/0/derivative", "3", nullptr, "expected an integer from 0 to 2, found 3"},
      {"/programs/SINE/inputs/0/derivative", none, "/programs/SINE/inputs/0", R"("derivative" is missing)"},
      {"/programs/SINE/inputs/1/index", "0", nullptr, R"(unknown member; known here: "kind")"},
      {"/programs/SINE/inputs/2/name", R"("x")", nullptr, R"(known here: "kind" or "index")"},
      {"/programs/SINE/op/3", R"("multiply")", nullptr, R"(expected the name of an operation, found "multiply")"},
      {"/programs/SINE/op/3", "2", nullptr, "expected the name of an operation, found 2"},
      {"/programs/SINE/a/3", "-1", nullptr, "expected an integer of at least 0, found -1"},
      {"/programs/SINE/a/3", "2147483648", nullptr, "expected an integer of at least 0, found 2147483648"},
      {"/programs/SINE/a/3", "0.5", nullptr, "found 0.5"},
      {"/programs/SINE/jacobian/0", "[0, 0]", nullptr, "expected a list of 3 integers, found a list of 2"},
      {"/programs/SINE/jacobian/0/1", R"("q")", nullptr, R"(expected an integer of at least 0, found "q")"},
      {"/programs/SINE/operations/hessian", "5", nullptr, R"(known here: "values" or "jacobian")"},
      {"/functionals/0/kind", R"("once")", nullptr, R"(expected "integral" or "at", found "once")"},
      {"/functionals/0/time", "1", nullptr, "unknown member"},
      {"/functionals/1/time", none, "/functionals/1", R"(the member "time" is missing)"},
      {"/functionals/1/from", "1", nullptr, "unknown member"},
      {"/constraints/0/relation", R"("<>")", nullptr, R"(expected "=" or "<=", found "<>")"},
      {"/constraints/0/scope/times/0", "[]", nullptr, "found a list of 0"},
      {"/constraints/0/scope/count", "3", nullptr, R"(unknown member; known here: "kind" or "times")"},
      {"/constraints/1/scope/step", none, "/constraints/1/scope", R"(the member "step" is missing)"},
      {"/constraints/1/scope/kind", R"("whole")", "/constraints/1/scope/from", "unknown member"},
      {"/constraints/2/scope/count", "10.5", nullptr, "expected an integer from 2 to 4000000, found 10.5"},
      {"/constraints/2/scope/count", "1000000000", nullptr, "expected an integer from 2 to 4000000, found 1000000000"},
      {"/constraints/2/scope/count", "1", nullptr, "expected an integer from 2 to 4000000, found 1"},
      {"/constraints/2/weight", R"("heavy")", nullptr, R"(found "heavy")"},
      {"/objective/0/pieces/3/kind", R"("never")", nullptr, R"(expected "integral", "at" or "once")"},
      {"/objective/0/pieces/3/from", "1", nullptr, "unknown member"},
      {"/keyframes/0/keys/1/value", none, "/keyframes/0/keys/1", R"(the member "value" is missing)"},
      {"/plots/0/outputs", "0", nullptr, "expected a list, found 0"},
      {"/bodies/0/shape", R"("cone")", nullptr, R"(expected "capsule", "sphere", "box" or "none", found "cone")"},
      {"/a~1b~0c", "1", nullptr, "/a~1b~0c: unknown member"},
  });
}

TEST(ProblemRefuses, WhatMeansNothing) {
  expect_problem_refusals({
      {"/time", "[2, 2]", nullptr, "the time must rise"},
      {"/time", "[0, 3]", "/dofs/0/basis/knots/6", "the last four knots are the end of the time"},
      {"/constants/1/name", R"("g")", nullptr, R"("g" is the name of an earlier one already)"},
      {"/constants/1/name", R"("")", nullptr, "must not be empty"},
      {"/constants/1/name", R"("a\nb")", nullptr, "control characters"},
      {"/constants/1/name", '"' + std::string(limits::name_bytes + 1, 'x') + '"', nullptr, "257 bytes"},
      {"/constants/0/value", R"({"program": "TWICE", "output": 0})", "/constants/0/value/program",
       R"(uses constant "g", which is not declared before)"},
      {"/constants/1/value", R"({"program": "nothing", "output": 0})", "/constants/1/value/program",
       R"(there is no program "nothing")"},
      {"/constants/1/value", R"({"program": "TWICE", "output": 1})", "/constants/1/value/output",
       "the program has 1 values"},
      {"/constants/1/value", R"({"program": "POSE", "output": 0})", "/constants/1/value/program",
       "a quantity may depend on constants alone"},
      {"/constants/1/value", R"({"program": "PRODUCT", "output": 0})", "/constants/1/value/program",
       "a quantity may depend on constants alone"},
      {"/dofs/1/name", R"("arm.elbow")", nullptr, "is the name of an earlier one already"},
      {"/dofs/1/name", R"("g")", nullptr, "is the name of an earlier one already"},
      {"/dofs/1/name", R"("aim")", nullptr, "is the name of an earlier one already"},
      {"/parameters/0/name", R"("g")", nullptr, "is the name of an earlier one already"},
      {"/parameters/1/name", R"("speed")", nullptr, "is the name of an earlier one already"},
      {"/parameters/0/upper", "-1", nullptr, "is below the lower bound"},
      {"/parameters/0/start", R"({"program": "SLOW", "output": 0})", "/parameters/0/start/program",
       "a quantity may depend on constants alone"},
      {"/parameters/0/upper", R"({"program": "AIMED", "output": 0})", "/parameters/0/upper/program",
       "a quantity may depend on constants alone"},
      {"/dofs/0/upper", "-3", nullptr, "is below the lower bound"},
      {"/dofs/0/lower", "0.0500001", "/dofs/0/upper", "is below the lower bound"},
      {"/dofs/1/upper/output", "1", nullptr, "there is no 1"},
      {"/programs/AIMED/inputs/1/name", R"("aims")", nullptr, R"(there is no parameter "aims")"},
      {"/programs/AIMED/inputs/1/name", R"("g")", nullptr, R"(there is no parameter "g")"},
      {"/dofs/0/basis/knots", "[0, 0, 0, 0, 2, 2, 2]", nullptr, "at least 8 knots, not 7"},
      {"/dofs/0/basis/knots/3", "0.25", nullptr, "the first four knots are the start of the time"},
      {"/dofs/0/basis/knots/5", "0.5", nullptr, "knots between the ends must rise"},
      {"/dofs/0/basis/knots/4", "1.5", "/dofs/0/basis/knots/5", "knots between the ends must rise"},
      {"/dofs/0/basis/knots/4", "0", nullptr, "knots between the ends must rise"},
      {"/dofs/0/basis/knots/5", "2", "/dofs/0/basis/knots/6", "knots between the ends must rise"},
      {"/dofs/0/basis/knots/5", "7", "/dofs/0/basis/knots/6", "must rise"},
      {"/programs/SINE/inputs/0/name", R"("arm.wrist")", nullptr, R"(there is no degree of freedom "arm.wrist")"},
      {"/programs/SINE/inputs/1", R"({"kind": "signal", "name": "k", "derivative": 0})", "/programs/SINE/inputs/1/name",
       R"(there is no signal "k")"},
      {"/programs/SINE/inputs/1", R"({"kind": "constant", "name": "k"})", "/programs/SINE/inputs/1/name",
       R"(there is no constant "k")"},
      {"/programs/SINE/inputs/1", R"({"kind": "parameter", "name": "k"})", "/programs/SINE/inputs/1/name",
       R"(there is no parameter "k")"},
      {"/programs/SINE/inputs/2/index", "1", nullptr, "multiplies value 1 of 1"},
      {"/programs/PRODUCT/inputs/1/index", "3", nullptr, "there is no functional 3"},
      {"/programs/SINE/a/3", "6", nullptr, "below 6"},  // a forward reference: value 6 is its own
      {"/programs/SINE/a/0", "7", nullptr, "below 3"},
      {"/programs/SINE/b/0", "1", nullptr, "must be 0"},
      {"/programs/SINE/b", "[0, 1, 0, 3]", nullptr, "has 4 rows, but op has 5"},
      {"/programs/SINE/values/0", "5", nullptr, "below 5"},
      {"/programs/SINE/jacobian/0/0", "1", nullptr, "there is no such value"},
      {"/programs/SINE/jacobian/0/1", "1", nullptr, "a time is no unknown"},
      {"/programs/SINE/jacobian/0/2", "6", nullptr, "below 6"},
      {"/programs/SINE/hessian/0/1", "3", nullptr, "there is no such input"},
      {"/programs/SINE/hessian/0/2", "8", nullptr, "below 8"},
      {"/programs/PRODUCT/jacobian/1", "[0, 0, 2]", nullptr, "each once"},
      {"/programs/SINE/operations/values", "1000000000", nullptr, "must be from 0"},
      {"/programs/SINE/operations/jacobian", "1000000000", nullptr, "must be from 0 to 5"},
      {"/programs/SINE/op/2", R"("tan")", "/programs/SINE", "is not the program's hash, which is "},
      {"/programs/00", R"({"inputs": [], "numbers": [], "op": [], "a": [], "b": [], "c": [], "values": [],
                               "jacobian": [], "hessian": [], "operations": {"values": 0, "jacobian": 0}})",
       nullptr, "is not the program's hash"},
      {"/programs/SQUARE", none, "/functionals/1/program", R"(there is no program "SQUARE")"},
      {"/functionals/0/program", R"("SQUARE")", nullptr, "uses functional 0, which is not before it"},
      {"/functionals/0/output", "1", nullptr, "the program has 1 values, numbered from 0; there is no 1"},
      {"/functionals/0/to/output", "1", nullptr, "there is no 1"},
      {"/functionals/1/time", R"({"program": "SINE", "output": 0})", "/functionals/1/time/program", "constants alone"},
      {"/constraints/1/name", R"("rest")", nullptr, "is the name of an earlier one already"},
      {"/constraints/0/scope", R"({"kind": "once"})", "/constraints/0/scope/kind",
       "what is evaluated once cannot depend on time or on a trajectory"},
      {"/constraints/0/scope/times", "[]", nullptr, "names no time"},
      {"/constraints/0/scope/times/1/output", "9", nullptr, "there is no 9"},
      {"/constraints/1/scope/step", "0", nullptr, "must be positive"},
      {"/constraints/1/scope/step", "-1", nullptr, "must be positive"},
      {"/constraints/1/scope/to", "0.25", nullptr, "is before its start"},
      {"/constraints/2/weight", "-1", nullptr, "must not be negative"},
      {"/constraints/6/condition/program", R"("SIN")", nullptr, R"(there is no program "SIN")"},
      {"/constraints/6/condition/output", "1", nullptr, "there is no 1"},
      {"/constraints/6/condition/program", R"("SQUARE")", nullptr, "a condition may depend on degrees of freedom"},
      {"/constraints/6/condition/program", R"("SINE")", nullptr, "a condition may depend on degrees of freedom"},
      {"/constraints/4/condition", R"({"program": "SLOW", "output": 0})", "/constraints/4/condition/program",
       "what is evaluated once cannot depend on time or on a trajectory"},
      {"/constraints/6/since", "7", nullptr, "must be from 0 to 6, the number of actions"},
      {"/keyframes/1/since", "7", nullptr, "must be from 0 to 6, the number of actions"},
      {"/objective/1/since", "7", nullptr, "must be from 0 to 6, the number of actions"},
      {"/constraints/7/name", R"("nobody")", nullptr, R"(there is no "nobody" here)"},
      {"/constraints/7/name", R"("energy")", nullptr, "a replacement bears the name of what it replaces"},
      {"/constraints/7/replacement", "false", "/constraints/7/name", "is the name of an earlier one already"},
      {"/constraints/7/replacement", none, "/constraints/7/name", "is the name of an earlier one already"},
      {"/objective/2/name", R"("rest")", nullptr, "a replacement bears the name of what it replaces"},
      {"/constraints/0/scope/times/0", "2.5", nullptr, "is outside the problem's time"},
      {"/constraints/1/scope/from", "-0.5", nullptr, "is outside the problem's time"},
      {"/functionals/0/from", "-1", nullptr, "is outside the problem's time"},
      {"/functionals/1/time", "2.0000001", nullptr, "is outside the problem's time"},
      {"/keyframes/0/time", "3", nullptr, "is outside the problem's time"},
      {"/constraints/2/program", R"("SIN")", nullptr, R"(there is no program "SIN")"},
      {"/objective/1/name", R"("always")", nullptr, "is the name of an earlier one already"},
      {"/objective/0/weight", R"({"program": "TWICE", "output": 4})", "/objective/0/weight/output", "no 4"},
      {"/objective/0/pieces/3/program", R"("SQUARE")", "/objective/0/pieces/3/output", "there is no 1"},
      {"/objective/0/pieces/0/kind", R"("once")", "/objective/0/pieces/0/program", "evaluated once"},
      {"/keyframes/0/keys/1/dof", R"("ball.Z")", nullptr, R"(there is no degree of freedom "ball.Z")"},
      {"/keyframes/0/keys/1/dof", R"("arm.elbow")", nullptr, "has a key at this time already"},
      {"/plots/0/outputs", "[]", nullptr, "at least one value"},
      {"/plots/0/outputs/0", "1", nullptr, "there is no 1"},
      {"/plots/1/name", R"("swing")", nullptr, "is the name of an earlier one already"},
      {"/plots/1/program", R"("SINE")", nullptr, "takes a multiplier"},
      {"/bodies/0/outputs/11", "12", nullptr, "there is no 12"},
      {"/bodies/0/outputs", "[0]", nullptr, "a pose has 12 numbers, not 1"},
      {"/bodies/0/size", "[1, 2, 3]", nullptr, "this shape has 4 numbers, not 3"},
      {"/bodies/3/size", "[1]", nullptr, "this shape has 0 numbers, not 1"},
      {"/bodies/1/name", R"("upper")", nullptr, "is the name of an earlier one already"},
  });
}

TEST(MotionRefuses, WrongFormsAndWhatMeansNothing) {
  expect_motion_refusals({
      {"/format", R"("spacetime-problem/1")", nullptr, R"(expected "spacetime-motion/1" or "spacetime-motion/2")"},
      {"/surplus", "1", nullptr, "unknown member"},
      {"/status", R"("done")", nullptr, R"(expected "converged", "stopped", "infeasible" or "failed")"},
      {"/status", none, "", R"(the member "status" is missing)"},
      {"/time/0", "2", "/time", "the time must rise"},
      {"/iterations", "1.5", nullptr, "expected an integer of at least 0, found 1.5"},
      {"/seconds/solve", "1", nullptr, "unknown member"},
      {"/objective/terms/energy", R"("x")", nullptr, "expected a number"},
      {"/violation/constraints/0/time", none, "/violation/constraints/0", R"(the member "time" is missing)"},
      {"/violation/constraints/0/time", R"("x")", nullptr, "expected a number"},
      {"/violation/constraints/0/line", "-1", nullptr, "expected an integer of at least 0"},
      {"/dofs/0/coefficients", "[1]", nullptr, "1 coefficients, but 9 knots ask for 5"},
      {"/dofs/0/coefficients/2", "null", nullptr, "expected a number, found null"},
      {"/dofs/0/basis/knots/4", "3", "/dofs/0/basis/knots/5", "must rise"},
      {"/dofs/1/name", R"("arm.shoulder")", nullptr, "an earlier one has this name"},
      {"/constants/", "1", nullptr, "must not be empty"},
      {"/parameters/speed", "null", nullptr, "expected a number, found null"},
      {"/parameters/", "1", nullptr, "must not be empty"},
      {"/objective/total", "null", nullptr, R"(only a motion whose status is "failed" may lack it)"},
      {"/objective/terms/calm", "null", nullptr, "must be a finite number"},
      {"/violation/max", "null", nullptr, "must be a finite number"},
      {"/violation/constraints/1/max", "null", nullptr, "must be a finite number"},
      {"/samples/values/hand/2/1", "null", nullptr, "must be a finite number"},
      {"/samples/values/hand/2/1", R"("x")", nullptr, "expected a number"},
      {"/samples/times/1", "null", nullptr, "expected a number, found null"},
      {"/record", "{}", nullptr, "expected a list, found an object"},
      {"/record/0/iteration", "-1", nullptr, "expected an integer of at least 0"},
      {"/record/0/radius", "1", nullptr, "unknown member"},
      {"/record/1/seconds", none, "/record/1", R"(the member "seconds" is missing)"},
      {"/record/1/violation", "null", nullptr, "must be a finite number"},
      {"/record/1/step", "null", nullptr, "expected a number, found null"},
      {"/samples/times", "[0]", "/samples/values/hand", "3 rows, but 1 times"},
      {"/samples/values/hand/1", "[1]", nullptr, "1 columns, expected 2"},
      {"/samples/poses/upper/1", "[1]", nullptr, "1 columns, expected 12"},
      {"/samples/frames", "1", nullptr, "unknown member"},
      {"/bodies", none, "", R"(the member "bodies" is missing)"},
      {"/programs", none, "", R"(the member "programs" is missing)"},
      {"/bodies/0/size", "[]", nullptr, "this shape has 1 numbers, not 0"},
      {"/bodies/0/outputs/3", "99", nullptr, "99"},
      {"/bodies/1/program", R"("gone")", nullptr, "gone"},
  });
}

TEST(ProblemRefuses, WhatTogetherIsTooMuch) {
  const auto document = write(examples::rich_problem());
  const auto found = refusal([&] {
    read_problem(change(change(document, "/constraints/2/scope/count", "4000000"), "/constraints/1/scope",
                        R"({"kind": "every", "from": 0, "to": 2, "step": 1e-9})"));
  });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->path, "/constraints/1/scope");
  EXPECT_NE(found->message.find("more than 4000000 residuals"), std::string::npos);
}

TEST(Check, FindsWhatNoDocumentCanHold) {
  const auto fault_of = [](auto change) {
    auto problem = examples::rich_problem();
    change(problem);
    const auto fault = validate(problem);
    return fault ? fault->path : "nothing";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fault_of([](Problem&) {}), "nothing");
  EXPECT_EQ(fault_of([&](Problem& p) { p.end = nan; }), "/time/1");
  EXPECT_EQ(fault_of([&](Problem& p) { p.dofs[0].start.number = nan; }), "/dofs/0/start");
  EXPECT_EQ(fault_of([&](Problem& p) { p.dofs[0].basis.knots[4] = nan; }), "/dofs/0/basis/knots/4");
  EXPECT_EQ(fault_of([&](Problem& p) { p.constraints[0].scope.times[0].number = nan; }),
            "/constraints/0/scope/times/0");
  EXPECT_EQ(fault_of([&](Problem& p) { p.functionals[1].from.reset(); }), "/functionals/1");
  EXPECT_EQ(fault_of([&](Problem& p) { p.functionals[1].to = Quantity{}; }), "/functionals/1");
  EXPECT_EQ(fault_of([&](Problem& p) { std::get<Iterate>(p.actions[0].action).iterations = -1; }),
            "/actions/0/iterations");
  EXPECT_EQ(fault_of([&](Problem& p) { p.keyframes[0].place.line = -1; }), "/keyframes/0/line");
}

TEST(MotionRefuses, WrongCheckpoints) {
  expect_motion_refusals({
      {"/checkpoint", "[]", nullptr, "expected an object, found a list of 0"},
      {"/checkpoint/problem", none, "/checkpoint", R"(the member "problem" is missing)"},
      {"/checkpoint/surplus", "1", nullptr, "unknown member"},
      {"/checkpoint/progress/action", "-1", nullptr, "found -1"},
      {"/checkpoint/progress/iterations", "62", nullptr, "must be from 0 to 61"},
      {"/checkpoint/edits/0/action", R"("jump")", nullptr, R"(found "jump")"},
      {"/checkpoint/window/action", R"("reset")", "/checkpoint/window/from", "unknown member"},
      {"/checkpoint/window", R"({"action": "reset"})", "/checkpoint/window/action", R"(expected "window")"},
      {"/checkpoint/damping/ball.X", "0", nullptr, "must be positive"},
      {"/checkpoint/shakes", "2000000000", nullptr, "must be from 0 to 1000000000"},
      {"/checkpoint/pivoted", "2147483647", nullptr, "must be from 0 to 1000000000"},
      {"/checkpoint/progress/action", "2147483647", nullptr, "must be from 0 to 1000000000"},
      {"/iterations", "2147483647", nullptr, "must be from 0 to 1000000000"},
      {"/checkpoint/start/dofs/0/basis/knots/1", "1", nullptr, "the first four knots are the start of the time"},
      {"/checkpoint/start/dofs/0/coefficients", "[1]", nullptr, "must be four fewer than knots"},
      {"/checkpoint/judged", "1", nullptr, "expected true or false"},
      {"/checkpoint/functionals/1", "null", nullptr, "expected a number, found null"},
      {"/checkpoint/outside/objective", "null", nullptr, "must be finite"},
      {"/checkpoint/newton/slacks/1", "-1", nullptr, "must not be negative"},
      {"/checkpoint/newton/slacks/1", "null", nullptr, "must be finite"},
      {"/checkpoint/newton/active/0", "2", nullptr, "must be from 0 to 1"},
      {"/checkpoint/newton/switches/0", "128", nullptr, "must be from 0 to 127"},
      {"/checkpoint/newton/filter/0", "[1]", nullptr, "expected a list of 2 numbers"},
      {"/checkpoint/newton/damping", "0", nullptr, "must be positive while the violation is reduced"},
      {"/checkpoint/newton/radius", "-0.1", nullptr, "must not be negative"},
      {"/checkpoint/sqp92/weights/0", "-1", nullptr, "must not be negative"},
      {"/checkpoint/bfgs", R"({"inverse": []})", nullptr, "only one method can have led here"},
  });
}

TEST(MotionRefuses, CheckpointsWhoseNumbersWereRounded) {
  expect_motion_refusals({
      {"/checkpoint/fingerprint", none, "/checkpoint", R"(the member "fingerprint" is missing)"},
      {"/checkpoint/fingerprint", R"("0123")", nullptr, "expected 32 hexadecimal digits"},
      {"/checkpoint/fingerprint", R"("0123456789abcdef0123456789abcdef")", nullptr, "have probably been rounded"},
      {"/dofs/0/coefficients/0", "1e-300", "/checkpoint/fingerprint", "leave out the member 'checkpoint'"},
      {"/parameters/speed", "2.0000000000000004", "/checkpoint/fingerprint", "have probably been rounded"},
      {"/iterations", "60", "/checkpoint/fingerprint", "have probably been rounded"},
      {"/checkpoint/newton/filter/0/0", "1.0000000000000002", "/checkpoint/fingerprint", "have probably been rounded"},
      {"/checkpoint/start/dofs/0/coefficients/0", "1e-300", "/checkpoint/fingerprint", "have probably been rounded"},
      {"/format", R"("spacetime-motion/1")", "/checkpoint/fingerprint", "version 1 has no fingerprint"},
  });
}

// A document of the first version cannot tell whether its numbers are those that were written: it is taken at its word.
TEST(Motions, OfTheFirstVersionAreRead) {
  auto document = nlohmann::json::parse(write(examples::rich_motion()));
  document["format"] = "spacetime-motion/1";
  document["checkpoint"].erase("fingerprint");
  document["checkpoint"]["step"] = 0.125;
  const Motion read = read_motion(document.dump());
  EXPECT_EQ(read.checkpoint->step, 0.125);
  EXPECT_EQ(read.checkpoint->fingerprint, "");
  EXPECT_NE(write(read).find(fingerprint(read)), std::string::npos);  // from now on it has one
  EXPECT_FALSE(refusal([&] { read_motion(write(read)); }));
}

TEST(MotionRefuses, CheckpointsOfOtherProblems) {
  Problem problem = examples::rich_problem();
  Motion motion;
  motion.start = problem.start;
  motion.end = problem.end;
  motion.iterations = 12;
  for (const Dof& dof : problem.dofs) motion.dofs.push_back({dof.name, dof.basis, {}});
  for (const Parameter& parameter : problem.parameters) motion.parameters.emplace_back(parameter.name, 0);
  motion.checkpoint.emplace();
  motion.checkpoint->problem = fingerprint(problem);
  const auto expect = [&](const std::string& path, const std::string& words, auto change) {
    SCOPED_TRACE(path);
    Motion changed = motion;
    change(changed);
    const auto fault = validate(changed, problem);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->path, path);
    EXPECT_NE(fault->message.find(words), std::string::npos) << fault->message;
  };
  EXPECT_FALSE(validate(motion, problem));
  expect("/dofs", "use the motion without its checkpoint", [](Motion& m) { m.dofs.pop_back(); });
  expect("/dofs", "where the motion has 'other'", [](Motion& m) { m.dofs[0].name = "other"; });
  expect("/parameters", "use the motion without its checkpoint", [](Motion& m) { m.parameters.clear(); });
  expect("/parameters", "'speed', which the motion has not", [](Motion& m) { m.parameters[0].first = "other"; });
  std::ranges::reverse(motion.parameters);  // members of an object
  EXPECT_FALSE(validate(motion, problem));
  expect("/time", "is not the problem's", [](Motion& m) { m.end += 1; });
  expect("/checkpoint/edits/1/name", "there is no constraint or term", [&](Motion& m) {
    m.checkpoint->edits = {SetConstant{problem.constants[0].name, {2, {}, 0}}, Disable{"nothing"}};
  });
  expect("/checkpoint/window/dofs/0", "nobody", [](Motion& m) { m.checkpoint->window.dofs = {"nobody"}; });
  expect("/checkpoint/progress/action", "must be from 0 to", [](Motion& m) { m.checkpoint->progress = {1000, 0}; });
  for (Constant& constant : problem.constants) {
    if (constant.value.program.empty()) constant.value.number += 1;
  }
  expect("/checkpoint/problem", "another version of this one", [](Motion&) {});
}

}  // namespace
}  // namespace spacetime
