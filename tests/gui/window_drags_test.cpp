// Drags whose control is gone, or lies under a dialog, before the button is let go.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"

namespace spacetime::test {
namespace {

std::size_t controls_of(const gui::State& s, const std::string& name) {
  return std::ranges::find(s.curves->dofs, name, &Trajectory::name)->coefficients.size();
}

// One of the last control points of a refined curve is held while the refinement is undone.
TEST(Window, AControlPointThatIsUndoneIsHeldNoMore) {
  Driver d(daemons());
  d.open_example("throw");
  const std::size_t before = controls_of(d.state(), "arm.elbow");
  d.click("menu Edit");
  d.click("menu Refine all");
  d.until([&](const gui::State& s) { return controls_of(s, "arm.elbow") > before; }, "the finer curve");
  gui::Selection selection;
  selection.dofs = {"arm.elbow"};
  d.hub().post(gui::Select{selection});
  d.frame(2);
  const std::size_t refined = controls_of(d.state(), "arm.elbow");
  d.drag("control arm.elbow " + std::to_string(refined - 4), 0, -20, 4, false);
  ASSERT_EQ(d.screen().memory().curves.dragged, "arm.elbow");
  d.key(GLFW_KEY_Z, true);
  d.until([&](const gui::State& s) { return controls_of(s, "arm.elbow") == before; }, "the curve before");
  d.frame();
  EXPECT_EQ(d.screen().memory().curves.dragged, "");
  d.let_go();
  d.settle();
  EXPECT_EQ(d.state().present, 0);
}

// What is dragged when a dialog opens ends with the button: nothing waits for it any longer.
TEST(Window, ADialogInTheMiddleOfADragHoldsNothingUp) {
  Driver d(daemons());
  d.open_example("throw");
  d.click("run");
  d.settle();
  for (const auto& [key, with_control] : {std::pair{GLFW_KEY_O, true}, {GLFW_KEY_F1, false}}) {
    const int before = d.state().present;
    d.drag("place Basket", -20, 10, 5, false);
    d.until([](const gui::State& s) { return s.steering.has_value(); }, "the drag");
    d.key(key, with_control);
    d.frame(3);
    d.let_go();
    d.settle();
    EXPECT_FALSE(d.state().steering);
    EXPECT_GT(d.state().present, before);
    EXPECT_NE(d.state().log.back().text.find("set BasketX"), std::string::npos) << d.state().log.back().text;
    d.key(GLFW_KEY_ESCAPE);
    d.frame(3);
  }
}

// A key that is undone while it is held is forgotten, whatever stands in its place then.
TEST(Window, AKeyThatIsUndoneIsHeldNoMore) {
  Driver d(daemons());
  d.open_example("throw");
  act(d.hub(), gui::key_words(0.5, {{"arm.elbow", -1}}).line);
  d.frame(3);
  d.drag("key 0.5", 40, 0, 4, false);
  d.until([](const gui::State& s) { return s.steering.has_value(); }, "the drag");
  ASSERT_GE(d.screen().memory().key.dragged, 0);
  d.key(GLFW_KEY_Z, true);
  d.frame(3);
  EXPECT_EQ(d.screen().memory().key.dragged, -1);
  d.let_go();
  d.settle();
  EXPECT_FALSE(d.state().steering);
}

// A constraint that is deleted is not selected any more, so that what is shown is not empty for want of it.
TEST(Window, AConstraintThatIsGoneIsNotSelected) {
  Driver d(daemons());
  d.open_example("throw");
  d.click("run");
  d.settle();
  d.click("show residuals");
  gui::Selection selection = d.state().selection;
  selection.constraint = "flight";
  d.hub().post(gui::Select{selection});
  d.frame(3);
  EXPECT_EQ(d.state().selection.constraint, "flight");
  act(d.hub(), "delete flight");
  d.frame(3);
  EXPECT_EQ(d.state().selection.constraint, "");
  EXPECT_TRUE(d.has("legend held"));
}

}  // namespace
}  // namespace spacetime::test
