// Texts that no one writes: compiling ends soon, in little memory, and with a report.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <random>
#include <string>

#include "symbolic/complete.h"
#include "tests/symbolic/compiled.h"

namespace spacetime::symbolic {
namespace {

const std::string head = "time [0, 2]\ntrajectory bspline spans 8\ndof x\n";

std::string repeated(const std::string& piece, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += piece;
  return out;
}

// The most memory the process has had, in bytes.
std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

TEST(Hostile, AHundredThousandNestedBracketsAreOneReport) {
  for (const std::string open : {"(", "[", "{", "sin(", "(1, ", "-", "not ", "2^", "if(x < 1, "}) {
    const std::string deep = repeated(open, 100000);
    for (const std::string& statement :
         {"let y = " + deep, "constrain " + deep, "define f(a) = " + deep, "creature c { link l " + deep,
          "script s { path " + deep, "key 1: x = " + deep, "eliminate x = " + deep}) {
      const Compilation result = compile(head + statement);
      EXPECT_FALSE(result.problem.has_value());
      EXPECT_GE(result.diagnostics.size(), 1U) << statement.substr(0, 40);
      EXPECT_LE(result.diagnostics.size(), 3U) << statement.substr(0, 40);
    }
  }
}

TEST(Hostile, AHundredMegabytesAreRefusedUnread) {
  const std::string line(100 << 20, 'x');
  const std::size_t before = peak_memory();
  const Compilation result = compile(line);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_NE(result.diagnostics[0].message.find("16 MiB"), std::string::npos);
  EXPECT_LT(render(result.diagnostics[0], "scene", line).size(), 400U);
  EXPECT_TRUE(complete(line, 1, 1 << 30).empty());
  EXPECT_FALSE(describe(line, 1, 1 << 30));
  EXPECT_LT(peak_memory() - before, std::size_t{1} << 20);
}

TEST(Hostile, LongLinesAreShownInPart) {
  const std::string text = head + "let y = " + repeated("x + ", 100000) + "q";
  const Compilation result = compile(text);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_LT(render(result.diagnostics[0], "scene", text).size(), 400U);
}

TEST(Hostile, BytesThatAreNoTextAreOneReport) {
  std::mt19937 random(20261122);
  for (int i = 0; i < 200; ++i) {
    std::string bytes(1 + random() % 4096, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 256);
    bytes[0] = static_cast<char>(0x80 + random() % 0x40);  // continues no character
    const Compilation result = compile(bytes);
    ASSERT_EQ(result.diagnostics.size(), 1U);
    EXPECT_EQ(result.diagnostics[0].span, (Span{1, 1, 1}));
  }
}

TEST(Hostile, LostAndDoubledPiecesOfTheManualEndWell) {
  const std::string text = file_text("examples/throw_reach.scene");
  std::mt19937 random(20261122);
  for (int i = 0; i < 300; ++i) {
    std::string changed = text;
    const std::size_t from = random() % text.size(), size = random() % 40, to = random() % text.size();
    if (i % 2 == 0)
      changed.erase(from, size);
    else
      changed.insert(to, text.substr(from, size));
    const Compilation result = compile(changed);
    EXPECT_NE(result.problem.has_value(), !result.diagnostics.empty()) << changed;
  }
}

}  // namespace
}  // namespace spacetime::symbolic
