#include "symbolic/colour.h"

#include <gtest/gtest.h>

#include <regex>
#include <string>

namespace spacetime::symbolic {
namespace {

const std::string text = "time [0, 1]\ndof x; dof x\n";
const Diagnostic twice{
    {2, 12, 1}, "'x' is declared: error: twice", {{{2, 5, 1}, "first note: here"}, {{9, 1, 1}, "nowhere"}}};

TEST(Colour, IsTheSameTextWithoutItsColours) {
  const std::string coloured = render_coloured(twice, "a: error: b.scene", text);
  EXPECT_EQ(std::regex_replace(coloured, std::regex("\x1b\\[[0-9;]*m"), ""), render(twice, "a: error: b.scene", text));
}

TEST(Colour, OfThePlaceTheKindAndTheMark) {
  const std::string coloured = render_coloured({{2, 12, 1}, "wrong", {}}, "a", text);
  EXPECT_EQ(coloured,
            "\x1b[1ma:2:12: \x1b[0m\x1b[1;31merror: \x1b[0m\x1b[1mwrong\x1b[0m\n"
            "dof x; dof x\n"
            "\x1b[1;32m           ^\x1b[0m\n");
}

}  // namespace
}  // namespace spacetime::symbolic
