// Text from a peer that means no good, or that a broken line has mangled: always an error with a place, never a crash,
// never memory or time without bound.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "protocol/check.h"
#include "protocol/limits.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "tests/protocol/examples.h"

namespace spacetime {
namespace {

struct Refusal {
  std::string path, message;
};

Refusal refusal(const std::string& text) {
  try {
    read_problem(text);
  } catch (const DocumentError& error) {
    return {error.path(), error.what()};
  }
  return {"accepted", "accepted"};
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return text.replace(at, from.size(), to);
}

// The shortest document with a bit of everything.
std::string small_document() {
  auto problem = examples::rich_problem();
  problem.bodies.clear();
  problem.objective.resize(1);
  problem.constraints.resize(1);
  problem.keyframes.resize(1);
  problem.actions.resize(1);
  return write(problem);
}

TEST(Hostile, CutAtEveryByte) {
  const auto text = small_document();
  const auto end = text.rfind('}');
  for (std::size_t size = 0; size <= end; ++size) {
    const auto found = refusal(text.substr(0, size));
    ASSERT_NE(found.message.find("too early, at byte " + std::to_string(size)), std::string::npos)
        << size << ": " << found.message;
  }
  EXPECT_EQ(refusal(text.substr(0, end + 1)).path, "accepted");
  const auto motion = write(examples::rich_motion());
  for (std::size_t size = 0; size <= motion.rfind('}'); ++size) {
    ASSERT_THROW(read_motion(std::string_view(motion).substr(0, size)), DocumentError) << size;
  }
}

TEST(Hostile, CutTextNamesWhereItStood) {
  const auto text = small_document();
  const auto knot = text.find("1.25");
  EXPECT_EQ(refusal(text.substr(0, knot)).path, "/dofs/0/basis/knots/5");
  EXPECT_EQ(refusal(text.substr(0, text.find("\"arm.elbow\""))).path, "/dofs/0/name");
}

TEST(Hostile, TextAfterTheEnd) {
  for (const auto* more : {"x", "{}", ",", "]", "}", "null", "\"", "\x01"}) {
    const auto found = refusal(small_document() + more);
    EXPECT_EQ(found.path, "");
    EXPECT_NE(found.message.find("goes on after its end"), std::string::npos) << found.message;
  }
  EXPECT_EQ(refusal(small_document() + " \n\t ").path, "accepted");
}

TEST(Hostile, NumbersThatAreNone) {
  for (const auto* number :
       {"NaN", "Infinity", "-Infinity", "nan", "inf", "+1", "01", ".5", "1.", "0x10", "1e", "--1"}) {
    const auto found = refusal(replaced(small_document(), "1.25", number));
    EXPECT_EQ(found.path.substr(0, 20), "/dofs/0/basis/knots/") << number;
    EXPECT_NE(found.message.find("not JSON at byte "), std::string::npos) << found.message;
  }
  for (const auto* number : {"1e999", "-1e999", "1e310"}) {
    const auto found = refusal(replaced(small_document(), "1.25", number));
    EXPECT_EQ(found.path, "/dofs/0/basis/knots/5") << number;
    EXPECT_EQ(found.message,
              std::string("problem document: /dofs/0/basis/knots/5: expected a finite number, found ") + number);
  }
}

TEST(Hostile, RepeatedMembers) {
  const auto text = small_document();
  const auto first = refusal(replaced(text, "\"time\"", "\"format\": \"spacetime-problem/1\", \"time\""));
  EXPECT_EQ(first.path, "/format");
  EXPECT_NE(first.message.find("the member is there twice"), std::string::npos);
  EXPECT_EQ(refusal(replaced(text, "\"kind\": \"bspline\"", "\"kind\": \"bspline\", \"kind\": \"bspline\"")).path,
            "/dofs/0/basis/kind");
  EXPECT_EQ(refusal(replaced(text, "\"kind\": \"bspline\"", "\"k\\u0069nd\": 1, \"kind\": \"bspline\"")).path,
            "/dofs/0/basis/kind");
}

TEST(Hostile, Depth) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) text += bracket;
    const auto found = refusal(text);
    EXPECT_NE(found.message.find("more than 32 objects and lists inside one another"), std::string::npos);
    EXPECT_LT(found.path.size(), 100u);
  }
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_NO_THROW(parse(nested(limits::document_depth), "document"));
  EXPECT_THROW(parse(nested(limits::document_depth + 1), "document"), DocumentError);
}

TEST(Hostile, SizeAndNumberOfValues) {
  EXPECT_NE(refusal(std::string(limits::document_bytes + 1, ' ')).message.find("more than the limit of 67108864"),
            std::string::npos);
  std::string many = "[0";
  while (many.size() < 2 * limits::document_values + 10) many += ",0";
  const auto found = refusal(many);
  EXPECT_EQ(found.path, "/3999999");
  EXPECT_NE(found.message.find("more than 4000000 values"), std::string::npos);
}

TEST(Hostile, ManyMembersTakeNoQuadraticTime) {
  std::string text = "{\"format\": \"spacetime-problem/1\"";
  for (int i = 0; i < 200'000; ++i) text += ",\"" + std::to_string(i) + "\":0";
  EXPECT_EQ(refusal(text + "}").path, "/0");
  EXPECT_EQ(refusal(text + ",\"77\":1}").path, "/77");
}

TEST(Hostile, ABillionClaimed) {
  const auto text = small_document();
  const auto claims = [&](std::string_view from, std::string_view to) { return refusal(replaced(text, from, to)); };
  EXPECT_NE(claims("\"values\": 1, \"jacobian\": 1", "\"values\": 1000000000, \"jacobian\": 1000000000")
                .path.find("/operations/jacobian"),
            std::string::npos);
  auto found = claims("\"kind\": \"times\", \"times\": [0, ",
                      "\"kind\": \"count\", \"from\": 0, \"to\": 1, \"count\": 1000000000, \"times\": [0, ");
  EXPECT_EQ(found.path, "/constraints/0/scope/times");
  auto problem = examples::rich_problem();
  problem.constraints.resize(1);
  auto& scope = problem.constraints[0].scope;
  scope = {};
  scope.kind = Scope::Kind::count;
  scope.to = {1, {}, 0};
  scope.count = 1'000'000'000;
  found = refusal(write(problem));
  EXPECT_EQ(found.path, "/constraints/0/scope/count");
  scope.kind = Scope::Kind::every;
  scope.step = {1e-300, {}, 0};
  found = refusal(write(problem));
  EXPECT_EQ(found.path, "/constraints/0/scope");
  EXPECT_NE(found.message.find("more than 4000000 residuals"), std::string::npos);
}

TEST(Hostile, LongTrajectoriesAndPrograms) {
  Problem problem;
  std::vector<double> knots(4, 0.0);
  for (std::size_t i = 1; i <= limits::spans; ++i) {
    knots.push_back(static_cast<double>(i) / static_cast<double>(limits::spans + 1));
  }
  knots.insert(knots.end(), 4, 1.0);
  problem.dofs = {{"q", {knots}, {}, {}}};
  EXPECT_EQ(refusal(write(problem)).path, "/dofs/0/basis/knots");
  EXPECT_EQ(validate(problem)->path, "/dofs/0/basis/knots");
  problem.dofs.front().basis.knots.erase(problem.dofs.front().basis.knots.begin() + 4);
  EXPECT_EQ(refusal(write(problem)).path, "accepted");

  problem = {};
  std::mt19937 random(7);
  const auto half = static_cast<int>(limits::operations / 2 + 1);
  examples::add(problem, examples::random_program(random, {}, half));
  EXPECT_FALSE(validate(problem));
  examples::add(problem, examples::random_program(random, {}, half));
  EXPECT_EQ(validate(problem)->path, "/programs");
}

// Each of these is small and fits every other limit; together they would keep a solver busy for hours.
TEST(Hostile, EndlessWork) {
  Problem problem;
  std::vector<double> knots(4, 0.0);
  for (int i = 1; i < 100'000; ++i) knots.push_back(i / 1e5);
  knots.insert(knots.end(), 4, 1.0);
  problem.dofs = {{"q", {knots}, {}, {}}};
  std::mt19937 random(5);
  const auto key = examples::add(problem, examples::random_program(random, {{InputKind::dof, "q", 0, 0}}, 1000));
  auto& term = problem.objective.emplace_back();
  term.name = "sum";
  term.pieces.resize(200, {Piece::Kind::integral, key, 0, {}, {}});
  EXPECT_FALSE(validate(problem));
  term.pieces.resize(300, {Piece::Kind::integral, key, 0, {}, {}});
  EXPECT_EQ(validate(problem)->path, "/objective/0/pieces/249");
  problem.objective.clear();
  problem.programs.clear();
  auto& constraint = problem.constraints.emplace_back();
  constraint.name = "all";
  constraint.program = examples::add(problem, examples::random_program(random, {}, 100'000));
  constraint.scope.kind = Scope::Kind::count;
  constraint.scope.count = 1'100'000;
  EXPECT_EQ(validate(problem)->path, "/constraints/0/scope");
}

TEST(Hostile, LongTextsAreQuotedShort) {
  const auto found = refusal(replaced(small_document(), "1.25", '"' + std::string(1'000'000, 'x') + '"'));
  EXPECT_EQ(found.path, "/dofs/0/basis/knots/5");
  EXPECT_LT(found.message.size(), 200u);
  EXPECT_LT(refusal(replaced(small_document(), "1.25", '"' + std::string(1'000'000, 'x'))).message.size(), 300u);
}

// Whatever is read of a mangled text is again a problem that can be used.
TEST(Hostile, RandomBytes) {
  const std::string texts[] = {small_document(), write(examples::busy_problem())};
  std::mt19937 random(2026);
  std::size_t accepted = 0, refused = 0;
  for (int i = 0; i < 8'000; ++i) {
    auto mangled = texts[i % 2];
    for (auto flips = 1 + random() % 3; flips > 0; --flips) {
      auto& byte = mangled[random() % mangled.size()];
      switch (random() % 3) {
        case 0:
          byte = static_cast<char>(byte ^ (1 << random() % 8));
          break;
        case 1:
          byte = static_cast<char>(random());
          break;
        default:
          byte = "0123456789-.eE\",:[]{} "[random() % 22];
          break;
      }
    }
    try {
      const auto problem = read_problem(mangled);
      ++accepted;
      ASSERT_FALSE(validate(problem)) << "seed 2026, round " << i;
      ASSERT_EQ(read_problem(write(problem)), problem) << "seed 2026, round " << i;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(accepted, 50u);
  EXPECT_GT(refused, 4'000u);
}

// Pieces of documents put together at random reach further than single bytes.
TEST(Hostile, RandomPieces) {
  const auto text = small_document();
  std::mt19937 random(1994);
  for (int i = 0; i < 5'000; ++i) {
    auto mangled = text;
    const auto from = random() % text.size(), size = random() % 60;
    mangled.replace(random() % text.size(), random() % 60, text.substr(from, size));
    try {
      ASSERT_FALSE(validate(read_problem(mangled))) << "seed 1994, round " << i;
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace spacetime
