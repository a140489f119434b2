// Two versions of a scene: what a user did not touch is the same in both problems, down to its programs' content, so
// that whoever takes over what differs (problem/update) keeps the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>

#include "symbolic/compiler.h"
#include "tests/symbolic/compiled.h"
#include "tests/symbolic/places.h"

namespace spacetime::symbolic {
namespace {

using Names = std::set<std::string>;

template <class T>
void compare(const std::string& kind, const std::vector<T>& before, const std::vector<T>& after, Names& out) {
  const auto in = [](const std::vector<T>& list, const T& one) { return std::ranges::find(list, one.name, &T::name); };
  for (const T& one : before) {
    const auto other = in(after, one);
    if (other == after.end())
      out.insert("- " + kind + one.name);
    else if (!(*other == one))
      out.insert("* " + kind + one.name);
  }
  for (const T& one : after)
    if (in(before, one) == before.end()) out.insert("+ " + kind + one.name);
}

// What differs, places left out: + what is new, - what is gone, * what is another.
Names differences(const Problem& one, const Problem& other) {
  const Problem before = without_places(one), after = without_places(other);
  Names out;
  compare("constant ", before.constants, after.constants, out);
  compare("parameter ", before.parameters, after.parameters, out);
  compare("dof ", before.dofs, after.dofs, out);
  compare("", before.constraints, after.constraints, out);
  compare("", before.objective, after.objective, out);
  if (before.plots != after.plots) out.insert("plots");  // they share a program
  compare("body ", before.bodies, after.bodies, out);
  if (before.keyframes != after.keyframes) out.insert("keyframes");
  if (before.actions != after.actions) out.insert("actions");
  return out;
}

std::size_t new_programs(const Problem& before, const Problem& after) {
  std::size_t out = 0;
  for (const auto& [key, program] : after.programs) {
    const auto known = before.programs.find(key);
    if (known == before.programs.end())
      ++out;
    else
      EXPECT_EQ(known->second, program) << key;
  }
  return out;
}

struct Edit {
  const char* from;
  const char* to;
  Names differ;
  std::size_t programs;  // new ones
};

void PrintTo(const Edit& edit, std::ostream* out) { *out << edit.from << " -> " << edit.to; }

class Update : public testing::TestWithParam<Edit> {};

TEST_P(Update, TouchesWhatWasEditedAlone) {
  const auto& [from, to, differ, programs] = GetParam();
  std::string text = file_text("examples/throw.scene");
  const std::string before = text;
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, std::string(from).size(), to);
  Compiler compiler;
  const Problem old = compiler.compile(before).problem.value();
  const Compilation edited = compiler.compile(text);
  ASSERT_TRUE(edited.problem.has_value());
  EXPECT_EQ(differences(old, *edited.problem), differ);
  EXPECT_EQ(new_programs(old, *edited.problem), programs);
  EXPECT_EQ(edited.statistics.derived, programs);
  // And back again.
  const Compilation back = compiler.compile(before);
  EXPECT_EQ(*back.problem, old);
  EXPECT_EQ(back.statistics.derived, 0U);
}

INSTANTIATE_TEST_SUITE_P(
    Edits, Update,
    testing::Values(
        Edit{"(BasketX, BasketY)  ", "(BasketX, 2*BasketY)  ", {"* goal"}, 1},
        Edit{"every 0.05", "every 0.04", {"* flight"}, 0}, Edit{"every 0.05", "every 0.05  weight 10", {"* flight"}, 0},
        Edit{"minimize energy", "constrain high: arm.hand.y <= 1  over [0, 2]\nminimize energy", {"+ high"}, 1},
        Edit{"constrain goal:", "# constrain goal:", {"- goal"}, 0},
        Edit{"constrain goal:", "constrain aim:", {"- goal", "+ aim"}, 0},
        Edit{"BasketX = 2.5", "BasketX = 2.6", {"* constant BasketX"}, 0},
        Edit{"constant land", "constant more    = 3\nconstant land", {"+ constant more"}, 0},
        Edit{"1e-3", "1e-2", {"* calm"}, 0},
        // Integrals over the same time share a program, with which both change.
        Edit{"ball.X''^2 +", "2*ball.X''^2 +", {"* calm", "* energy"}, 1},
        Edit{"mass 1.5", "mass 1.6", {"* calm", "* energy", "plots"}, 2},
        Edit{"arm.shoulder = -2.5", "arm.shoulder = -2.6", {"keyframes"}, 0},
        Edit{"solve", "solve iterations 3", {"actions"}, 0}, Edit{"# A three-link arm", "#\n# An arm", {}, 0}));

TEST(Update, ALayoutIsNoEdit) {
  const std::string text = file_text("examples/throw.scene");
  std::string loose = text;
  for (std::size_t at = 0; (at = loose.find("; ", at)) != std::string::npos; ++at) loose.replace(at, 2, "\n\n");
  const Problem a = problem_of(text), b = problem_of(loose);
  EXPECT_EQ(differences(a, b), Names{});
  EXPECT_EQ(new_programs(a, b), 0U);
  EXPECT_NE(a, b);  // they stand on other lines
}

// What has no name is called by its number, so that one more in front of it renames it; named statements stay.
TEST(Update, WhatHasNoNameIsKnownByItsOrder) {
  const std::string head = "time [0, 1]\ntrajectory bspline spans 4\ndof x\n", last = "constrain x' = 3 at 1\n",
                    named = "constrain end: x = 1 at 1\n";
  const Problem old = problem_of(head + last + named),
                edited = problem_of(head + "constrain x = 2 at 0\n" + last + named);
  EXPECT_EQ(differences(old, edited), (Names{"* constraint 1", "+ constraint 2"}));
}

}  // namespace
}  // namespace spacetime::symbolic
