// Keys and pinned ghosts on the timeline's ruler, and runs that are paused.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/bspline.h"
#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"

namespace spacetime::test {
namespace {

double elbow_at(const Driver& d, double time) {
  for (const Trajectory& dof : d.state().curves->dofs)
    if (dof.name == "arm.elbow") return value(dof.basis, dof.coefficients, time);
  return NAN;
}

const gui::KeyMark* key_at(Driver& d, double time) {
  for (const gui::KeyMark& mark : d.screen().memory().question.keys)
    if (!mark.sketched && std::abs(mark.time - time) < 0.006) return &mark;
  return nullptr;
}

float pixels(Driver& d, double seconds) {  // of a scene of two seconds
  return static_cast<float>(seconds / 2) * (d.place("ruler").width - 12);
}

TEST(Window, AKeyIsDraggedToAnotherTimeAndTheMotionFollows) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  const double before = elbow_at(d, 0.5);
  act(d.hub(), gui::key_words(0.5, {{"arm.elbow", before + 0.7}}).line);
  act(d.hub(), gui::key_words(1.2, {{"arm.elbow", 0.3}}).line);  // its pull reaches the other's time
  d.frame(3);
  ASSERT_TRUE(key_at(d, 0.5));
  const auto acts = d.state().log.size();
  d.drag("key 0.5", pixels(d, 0.3), 0, 8, false);
  d.until([&](const gui::State&) { return std::abs(elbow_at(d, 0.8) - (before + 0.7)) < 1e-9; }, "the motion");
  EXPECT_TRUE(d.state().ghost);
  d.save_picture("keys-1-dragged.png");
  d.let_go();
  d.settle();
  EXPECT_EQ(d.state().log.size(), acts + 1) << text_of(d.state());
  EXPECT_NEAR(elbow_at(d, 0.8), before + 0.7, 1e-9);
  ASSERT_TRUE(key_at(d, 0.8));
  EXPECT_FALSE(key_at(d, 0.5));
  EXPECT_TRUE(key_at(d, 1.2));
  EXPECT_TRUE(batch_curves(text_of(d.state())) == curves_text(*d.state().motion)) << text_of(d.state());

  // Taken away again, the other alone is left.
  d.click("key 0.8", 1);
  d.save_picture("keys-2-menu.png");
  d.click("take key away");
  d.settle();
  EXPECT_FALSE(key_at(d, 0.8));
  const double left = elbow_at(d, 0.5);
  const auto alone = elbow_at(d, 1.2);
  for (int k = 0; k < 4; ++k) d.hub().post(gui::Undo{});
  d.settle();
  act(d.hub(), gui::key_words(0.5, {{"arm.elbow", before + 0.7}}).line);
  act(d.hub(), gui::key_words(1.2, {{"arm.elbow", 0.3}}).line);
  d.settle();
  d.click("key 0.5", 1);
  d.click("take key away");
  d.settle();
  EXPECT_NEAR(elbow_at(d, 0.5), left, 1e-9);
  EXPECT_NEAR(elbow_at(d, 1.2), alone, 1e-9);

  // Esc while it is held: as before.
  const std::string text = text_of(d.state());
  d.drag("key 1.2", pixels(d, 0.2), 0, 6, false);
  d.until([](const gui::State& s) { return s.steering.has_value(); }, "a drag");
  d.key(GLFW_KEY_ESCAPE);
  d.let_go();
  d.settle();
  EXPECT_EQ(text_of(d.state()), text);
}

// Once it was solved for, nothing of a key can be taken out: the pose is keyed at the other time, and solved for.
TEST(Window, AKeyThatWasSolvedForIsDraggedBySolvingAnew) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  act(d.hub(), gui::key_words(0.5, {{"arm.elbow", -1}}).line);
  act(d.hub(), "solve");
  d.frame(3);
  d.drag("key 0.5", pixels(d, 0.2), 0, 8);
  d.settle();
  const std::string& last = d.state().log.back().text;
  EXPECT_EQ(last.find("key 0.7"), 0U) << last;
  EXPECT_NE(last.find("solve"), std::string::npos) << last;
  EXPECT_TRUE(key_at(d, 0.7));
  EXPECT_FALSE(key_at(d, 0.5));
  d.click("undo");
  d.settle();
  EXPECT_TRUE(key_at(d, 0.5));
}

TEST(Window, GhostsArePinnedAndClickedAway) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  d.click("run");
  d.settle();
  const std::string text = text_of(d.state());
  for (const double time : {0.4, 0.8, 1.3}) {
    gui::Playback playback = d.state().playback;
    playback.time = time;
    d.hub().post(gui::SetPlayback{playback});
    d.frame(2);
    d.key(GLFW_KEY_G);
  }
  d.key(GLFW_KEY_G, false, true);  // those along the motion are put away
  EXPECT_EQ(d.state().pins, (std::vector<double>{0.4, 0.8, 1.3}));
  d.frame(20);
  d.save_picture("pins-1.png");
  d.click("pin 0.8");
  EXPECT_EQ(d.state().pins, (std::vector<double>{0.4, 1.3}));
  d.key(GLFW_KEY_G);  // at 1.3
  EXPECT_EQ(d.state().pins, (std::vector<double>{0.4}));
  EXPECT_EQ(text_of(d.state()), text);  // of pins it says nothing
}

TEST(Window, ARunIsPausedAndContinued) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  d.hub().post(gui::SetPace{20});  // so that there is time to pause it
  d.hub().post(gui::Act{"solve method sqp92 iterations 1000000000 tolerance 1e-300"});
  d.until([](const gui::State& s) { return s.record.iterations.size() > 3; }, "iterations");
  d.save_picture("pause-1-running.png");
  d.click("pause");
  d.settle();
  ASSERT_TRUE(d.has("continue")) << told(d.state());
  d.frame(30);
  d.save_picture("pause-2-paused.png");
  const int before = d.state().motion->iterations;
  d.click("continue");
  d.until(
      [&](const gui::State& s) {
        return !s.record.iterations.empty() && s.record.iterations.back().iteration > before;
      },
      "more of it");
  d.click("stop");
  d.settle();
  EXPECT_TRUE(d.has("run"));
  EXPECT_FALSE(d.has("continue"));
  EXPECT_TRUE(batch_curves(text_of(d.state())) == curves_text(*d.state().motion)) << text_of(d.state());
}

}  // namespace
}  // namespace spacetime::test
