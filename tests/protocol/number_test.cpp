// Numbers: every finite double returns with its bits, no other can be written, and only integers are integers.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "protocol/strict.h"
#include "protocol/writer.h"
#include "tests/protocol/examples.h"

namespace spacetime {
namespace {

using Limits = std::numeric_limits<double>;

std::string text_of(double value) {
  Writer to(false);
  to.number(value);
  return to.take();
}

double number_in(const std::string& text) {
  const auto tree = parse(text, "document");
  return Node(tree, "document").number();
}

TEST(Numbers, ReturnWithTheirBits) {
  std::mt19937 random(94);
  std::vector<double> values{0.0,
                             -0.0,
                             1,
                             -1,
                             0.1,
                             1e308,
                             -1e308,
                             1e22,
                             1e23,
                             9007199254740993.0,
                             123456789012345680.0,
                             18446744073709551616.0,
                             -9223372036854775808.0,
                             Limits::max(),
                             Limits::min(),
                             Limits::denorm_min(),
                             -Limits::denorm_min(),
                             2.2250738585072011e-308,
                             5e-324};
  for (int i = 0; i < 100'000; ++i) values.push_back(examples::random_number(random));
  for (const double value : values) {
    const auto text = text_of(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(number_in(text)), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

TEST(Numbers, AreWrittenWithTheFewestDigits) {
  EXPECT_EQ(text_of(0.1), "0.1");
  EXPECT_EQ(text_of(2), "2");
  EXPECT_EQ(text_of(-0.0), "-0.0");
  EXPECT_EQ(text_of(1e308), "1e+308");
  EXPECT_EQ(text_of(5e-324), "5e-324");
  EXPECT_EQ(text_of(0.30000000000000004), "0.30000000000000004");
}

TEST(Numbers, ThatAreNotFiniteCannotBeWritten) {
  for (const double value : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()}) {
    EXPECT_THROW(text_of(value), InputError);
    auto motion = examples::rich_motion();
    motion.dofs[1].coefficients[2] = value;
    EXPECT_THROW(write(motion), InputError);
    auto problem = examples::rich_problem();
    problem.programs.begin()->second.numbers.push_back(value);
    EXPECT_THROW(write(problem), InputError);
  }
}

TEST(Text, ThatIsNotUtf8CannotBeWritten) {
  auto motion = examples::rich_motion();
  motion.message = "\xC3(";
  EXPECT_THROW(write(motion), InputError);
}

TEST(Numbers, AreIntegersWhereTheyAreWhole) {
  const auto integer = [](const std::string& text) {
    const auto tree = parse(text, "document");
    return Node(tree, "document").integer(-5, 2147483647);
  };
  EXPECT_EQ(integer("7"), 7);
  EXPECT_EQ(integer("7.0"), 7);
  EXPECT_EQ(integer("7e2"), 700);
  EXPECT_EQ(integer("-5"), -5);
  EXPECT_EQ(integer("2147483647"), 2147483647);
  for (const auto* text : {"7.5", "-6", "2147483648", "-2147483649", "18446744073709551615", "18446744073709551616",
                           "1e300", "4.9e-324", "\"7\"", "true", "null", "[]"}) {
    EXPECT_THROW(integer(text), DocumentError) << text;
  }
}

}  // namespace
}  // namespace spacetime
