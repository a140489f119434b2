// What the window shows: what is under the pointer, where the camera stands, what lines and marks mean.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/files.h"
#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"

namespace spacetime::test {
namespace {

void open_throw(Driver& d, bool solved) {
  d.open_example("throw");
  if (!solved) return;
  d.click("run");
  d.settle();
}

void go_to(Driver& d, double time) {
  gui::Playback playback = d.state().playback;
  playback.time = time;
  d.hub().post(gui::SetPlayback{playback});
  d.frame(2);
}

void point_at(Driver& d, const std::string& name) {
  const gui::Rect r = d.place(name);
  d.screen().move(r.x + r.width / 2, r.y + r.height / 2);
  d.frame(2);
}

bool inside(const gui::Rect& inner, const gui::Rect& outer) {
  return inner.x >= outer.x && inner.y >= outer.y && inner.x + inner.width <= outer.x + outer.width &&
         inner.y + inner.height <= outer.y + outer.height;
}

// The hand and the ball in it go together; the ball that flies goes alone.
TEST(Window, TheHandIsTakenHoldOfByTheBallInIt) {
  Driver d(daemons());
  open_throw(d, true);
  go_to(d, 0.5);
  point_at(d, "part ball.slideY");
  EXPECT_EQ(d.screen().memory().scene.pointed, "arm.palm, and ball with it");
  d.frame(20);
  d.save_picture("sights-1-held.png");
  const gui::Rect before = d.place("part ball.slideY");
  d.drag("part ball.slideY", 12, -25, 10);
  ASSERT_TRUE(d.state().pose);
  EXPECT_TRUE(d.state().pose->values.contains("arm.elbow"));
  EXPECT_TRUE(d.state().pose->values.contains("ball.Y"));
  d.frame(2);
  const gui::Rect after = d.place("part ball.slideY");
  EXPECT_NEAR(after.x - before.x, 12, 2);
  EXPECT_NEAR(after.y - before.y, -25, 2);
  point_at(d, "part ball.slideY");
  EXPECT_EQ(d.screen().memory().scene.pointed, "arm.palm, and ball with it");  // it is in the hand still
  d.frame(20);
  d.save_picture("sights-2-posed.png");
  d.key(GLFW_KEY_ESCAPE);

  go_to(d, 1.4);
  point_at(d, "part ball.slideY");
  EXPECT_EQ(d.screen().memory().scene.pointed, "ball");
  d.drag("part ball.slideY", 12, -25, 10);
  ASSERT_TRUE(d.state().pose);
  EXPECT_FALSE(d.state().pose->values.contains("arm.elbow"));
  d.key(GLFW_KEY_ESCAPE);
  act(d.hub(), "window [0, 2] of arm.elbow");
  d.frame(2);
  point_at(d, "part ball.slideY");
  EXPECT_EQ(d.screen().memory().scene.pointed, "ball: the window leaves it where it is");
}

// Only a scene that is opened, and who asks for it, moves the camera.
TEST(Window, TheCameraStaysWhateverBecomesOfTheMotion) {
  Driver d(daemons());
  open_throw(d, false);
  const gui::Camera opened = d.screen().memory().scene.camera;
  const auto expect_still = [&](const char* when) {
    d.frame(3);
    EXPECT_EQ(d.screen().memory().scene.camera, opened) << when;
  };
  d.click("run");
  d.settle();
  expect_still("solved");
  d.drag("place Basket", 60, -30, 8);
  d.settle();
  expect_still("dragged");
  while (can_undo(d.state())) {
    d.click("undo");
    d.settle();
  }
  expect_still("undone");
  act(d.hub(), "bound arm.elbow in [-3, 3]");  // compiled anew
  expect_still("declared");
  d.click("run");
  d.settle();
  d.key(GLFW_KEY_F);
  EXPECT_NE(d.screen().memory().scene.camera, opened);  // the ball flies further than the sketch says
  d.save_picture("sights-3-framed.png");
  const gui::Camera framed = d.screen().memory().scene.camera;
  d.open(read_text(SPACETIME_SOURCE_DIR "/examples/acrobat_jump.scene"));
  EXPECT_NE(d.screen().memory().scene.camera, framed);
}

TEST(Window, AFigureThatLeavesTheViewIsToldOf) {
  Driver d(daemons());
  d.open(
      "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain here: x = 0 at 0\nconstrain away: x = 20 at "
      "1\nminimize calm: integral(x''^2)\n");
  d.click("run");
  d.settle();
  d.frame(2);
  EXPECT_EQ(d.screen().memory().scene.doing, "");
  go_to(d, 1);
  EXPECT_NE(d.screen().memory().scene.doing.find("F frames"), std::string::npos);
  d.save_picture("sights-11-away.png");
  d.key(GLFW_KEY_F);
  d.frame(2);
  EXPECT_EQ(d.screen().memory().scene.doing, "");
  EXPECT_LT(d.place("part x").y + d.place("part x").height, d.place("scene legend").y);
}

TEST(Window, WhatIsDraggedIsToldShortlyAndInside) {
  Driver d(daemons());
  open_throw(d, false);
  std::vector<std::pair<std::string, double>> keys;
  for (const char* dof : {"arm.shoulder", "arm.elbow", "arm.wrist", "ball.X", "ball.Y"})
    keys.emplace_back(dof, 0.1 + std::sqrt(2) * static_cast<double>(keys.size()));
  act(d.hub(), gui::key_words(0.5, keys).line);
  d.frame(3);
  d.drag("key 0.5", 60, 0, 8, false);
  d.until([](const gui::State& s) { return s.steering.has_value(); }, "a drag");
  d.frame(3);
  const std::string& doing = d.screen().memory().scene.doing;
  EXPECT_NE(doing.find("arm.elbow = 1.514"), std::string::npos) << doing;
  for (std::size_t i = 0, digits = 0; i < doing.size(); ++i) {
    digits = std::isdigit(static_cast<unsigned char>(doing[i])) ? digits + 1 : 0;
    EXPECT_LE(digits, 5U) << doing;
  }
  EXPECT_TRUE(inside(d.place("doing"), d.place("scene")));
  d.save_picture("sights-4-dragging.png");
  d.let_go();
}

TEST(Window, AKeyIsSaidToBeAGuess) {
  Driver d(daemons());
  open_throw(d, true);
  go_to(d, 0.5);
  d.drag("part arm.upper", 30, 10, 8);
  d.key(GLFW_KEY_K);
  d.settle();
  ASSERT_TRUE(d.has("told "));
  EXPECT_TRUE(inside(d.place("told "), d.place("scene")));
  EXPECT_NE(told(d.state()).find("guess"), std::string::npos);
  point_at(d, "key 0.5");
  d.frame(40);  // its help
  d.save_picture("sights-5-keyed.png");
  for (int k = 0; k < 600; ++k) d.hub().step(1.0 / 60);
  EXPECT_FALSE(d.has("told ") && told(d.state()).find("guess") != std::string::npos);
}

TEST(Window, TheScenesLegendIsInsideAndCanBePutAway) {
  Driver d(daemons(), 2560, 1440, 1.5F);
  open_throw(d, true);
  d.hub().post(gui::Pin{0.4, true});
  d.screen().memory().scene.forces = true;
  act(d.hub(), "disable goal");
  d.frame(3);
  EXPECT_TRUE(inside(d.place("scene legend"), d.place("scene")));
  d.save_picture("sights-6-legend.png");
  d.hub().post(gui::SetTheme{false});
  d.frame(3);
  d.save_picture("sights-7-legend-light.png");
  d.click("menu View");
  d.click("menu Legend");
  d.key(GLFW_KEY_ESCAPE);
  d.frame(2);
  EXPECT_FALSE(d.has("scene legend"));
}

TEST(Window, ToolsOfTheSelectionCoverNoneOfThem) {
  Driver d(daemons());
  open_throw(d, true);
  for (const char* tool : {"filter", "shake"}) {
    d.click(std::string("open ") + tool);
    d.frame(2);
    d.save_picture(std::string("sights-8-") + tool + ".png");
    const gui::Rect asked = d.place(std::string(tool) + (tool[0] == 'f' ? " strength" : " amplitude"));
    for (const char* other : {"open filter", "open shake", "fit", "controls", "value"}) {
      const gui::Rect r = d.place(other);
      EXPECT_GE(asked.x, r.x + r.width) << other;
    }
    d.key(GLFW_KEY_ESCAPE);
    d.frame(2);
  }
}

// An expression that wiggles faster than the samples of the whole: zoomed in, it is drawn as it is.
TEST(Window, ExpressionsAreSampledWhereTheyAreLookedAt) {
  Driver d(daemons());
  d.open("time [0, 2]\ntrajectory bspline spans 8\ndof x = 1\nlet wave = x * sin(2000 * t)\n");
  gui::Selection selection;
  selection.expressions = {"wave"};
  d.hub().post(gui::Select{selection});
  d.until([](const gui::State& s) { return s.samples && s.samples->times.size() == 201; }, "samples");
  d.wheel("ruler", 28);  // to about a hundredth
  const auto& span = d.screen().memory().span;
  d.until([&](const gui::State& s) { return s.samples->times.size() > 500; }, "samples of the span");
  EXPECT_LT(span.to - span.from, 0.05);
  const Samples& samples = *d.state().samples;
  double worst = 0;
  for (std::size_t i = 0; i < samples.times.size(); ++i)
    if (samples.times[i] >= span.from && samples.times[i] <= span.to && i > 0)
      worst = std::max(worst, std::abs(samples.values.at("wave")[i][0] - samples.values.at("wave")[i - 1][0]));
  EXPECT_LT(worst, 0.5);
  d.frame(20);
  d.save_picture("sights-9-zoomed.png");
  d.click("fit");
  d.until([](const gui::State& s) { return s.samples->times.size() == 201; }, "samples of the whole");
}

TEST(Window, TheSpanFollowsThePlaybackByPages) {
  Driver d(daemons());
  open_throw(d, true);
  d.wheel("ruler", 10);
  const auto& span = d.screen().memory().span;
  const double page = span.to - span.from;
  EXPECT_LT(page, 0.5);
  gui::Playback playback = d.state().playback;
  playback.playing = true;
  playback.speed = 4;
  d.hub().post(gui::SetPlayback{playback});
  d.frame(2);
  int turned = 0;
  double from = span.from;
  for (int k = 0; k < 50; ++k) {
    d.frame();
    EXPECT_LE(span.from, d.state().playback.time);
    EXPECT_GE(span.to, d.state().playback.time);
    turned += span.from != from ? 1 : 0;
    from = span.from;
  }
  EXPECT_GE(turned, 4);
  EXPECT_LE(turned, 12);  // by pages, not at every frame
  EXPECT_NEAR(span.to - span.from, page, 1e-9);
  d.save_picture("sights-10-following.png");
  d.hub().post(gui::Play{false});
  d.frame(2);
  const double stays = span.from;
  go_to(d, span.from > 0.5 ? 0.0 : 2.0);
  EXPECT_EQ(span.from, stays);  // who scrubs looks where he wants
}

}  // namespace
}  // namespace spacetime::test
