// The window's session: scenes that are begun and left, input that comes faster than frames, messages that are seen.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "common/files.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

// Down and up within one slow frame, and the mouse far away by then.
TEST(Window, PressesWithinAFrameAreNotLost) {
  Driver d(daemons(), 960, 600);
  d.frame(3);
  const gui::Rect examples = d.place("examples");
  d.screen().move(examples.x + examples.width / 2, examples.y + examples.height / 2);
  d.screen().button(0, true);
  d.screen().button(0, false);
  d.frame(2);
  EXPECT_TRUE(d.screen().memory().welcome);
  d.key(GLFW_KEY_ESCAPE);
  d.frame(2);
  d.screen().key(GLFW_KEY_LEFT_CONTROL, true);
  d.screen().key(GLFW_KEY_E, true);
  d.screen().key(GLFW_KEY_E, false);
  d.screen().key(GLFW_KEY_LEFT_CONTROL, false);
  d.frame(3);
  EXPECT_TRUE(d.screen().memory().welcome);
}

TEST(Window, ANewSceneCanBeRunChangedAndIsNotLeftUnasked) {
  Driver d(daemons(), 1280, 800);
  d.key(GLFW_KEY_N, true);
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.settle();
  d.save_picture("new-1-scene.png");
  d.click("run");
  d.settle();
  EXPECT_EQ(d.state().motion->status, Status::converged) << told(d.state());
  EXPECT_EQ(batch_curves(text_to_save(d.state())), curves_text(*d.state().motion));
  act(d.hub(), "set Goal = 2");
  EXPECT_TRUE(unsaved(d.state()));
  d.key(GLFW_KEY_N, true);
  d.frame(3);
  ASSERT_TRUE(d.has("guard discard"));
  d.save_picture("new-2-guard.png");
  d.key(GLFW_KEY_ESCAPE);
  d.frame(2);
  EXPECT_FALSE(d.has("guard discard"));
  d.key(GLFW_KEY_N, true);
  d.frame(3);
  d.click("guard cancel");
  EXPECT_TRUE(unsaved(d.state()));
  d.click("menu File");
  d.save_picture("new-3-menu.png");
  d.click("menu New scene");
  d.click("guard discard");
  d.settle();
  EXPECT_FALSE(unsaved(d.state()));
  EXPECT_TRUE(d.state().file.empty());
}

TEST(Window, AMistakeInADraftIsScrolledTo) {
  Driver d(daemons(), 960, 600);
  d.open_example("throw");
  d.click("add new constraint");  // it has the keyboard at once
  d.frame(6);
  d.save_picture("draft-begun.png");
  d.type("high: ball.Z >= 0 at 1");
  d.key(GLFW_KEY_ENTER);
  d.until([](const gui::State& s) { return !s.notices.empty(); }, "a mistake");
  d.frame(3);
  const gui::Rect said = d.place("told new constraint"), edge = d.place("ruler");
  EXPECT_LT(said.y + said.height, edge.y - 20);
  EXPECT_GT(said.y, d.place("tab Equations").y);
  d.save_picture("draft-mistake.png");
}

TEST(Window, SessionsLeftBehindAreInTheFileMenu) {
  const std::string folder = scratch("window_left");
  {
    gui::Hub hub(daemons(folder));
    post_and_wait(hub, gui::OpenText{read_text(SPACETIME_SOURCE_DIR "/examples/double_integrator.scene")});
    act(hub, "iterate 1");
  }
  Driver d(daemons(folder), 1280, 800);
  d.until([](const gui::State& s) { return !s.left.empty(); }, "what was left behind");
  d.click("menu File");
  d.click("menu Not saved when it ended");
  d.save_picture("left-menu.png");
  d.click("menu a scene without a file");
  d.until([](const gui::State& s) { return s.present == 1; }, "the session");
  EXPECT_TRUE(d.state().left.empty());
}

}  // namespace
}  // namespace spacetime::test
