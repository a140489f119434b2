// Curves and the time they share, read and worked by injected input.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/bspline.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"

namespace spacetime::test {
namespace {

// The ruler, the bars and the curves show the same span of time, however it is zoomed and moved.
TEST(Window, TheTimeAxisIsZoomedAndMovedAsOne) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  gui::Selection selection;
  selection.dofs = {"arm.elbow"};
  d.hub().post(gui::Select{selection});
  d.frame(2);
  const auto control = [&](int i) { return d.place("control arm.elbow " + std::to_string(i)); };
  const float apart = control(11).x - control(10).x;
  const gui::Rect curves = d.place("curves");
  EXPECT_TRUE(d.has("window from"));
  d.wheel("ruler", 4);
  EXPECT_GT(control(11).x - control(10).x, 1.5F * apart);
  EXPECT_FALSE(d.has("window from"));  // out of sight
  EXPECT_EQ(d.place("curves").width, curves.width);
  const float middle = control(11).x;
  d.drag("curves", 60, 0, 8, true, 1);
  EXPECT_NEAR(control(11).x, middle + 60, 0.5);
  const double low = d.screen().memory().curves.low;
  d.drag("curves", 0, 30, 8, true, 1);
  EXPECT_NEAR(control(11).x, middle + 60, 0.5);
  EXPECT_NE(d.screen().memory().curves.low, low);
  d.wheel("curves", 2, true);
  EXPECT_GT(control(11).x - control(10).x, 2 * apart);

  // A click on the ruler above a control point goes to the time that it has most to say about.
  const auto& elbow = *std::ranges::find(d.state().curves->dofs, "arm.elbow", &Trajectory::name);
  const gui::Rect ruler = d.place("ruler"), point = control(13);
  d.drag("ruler", point.x + point.width / 2 - ruler.x - ruler.width / 2, 0);
  EXPECT_NEAR(d.state().playback.time, greville(elbow.basis)[13], 1e-3);
  const gui::Rect held = d.place("scope held to"), flight = d.place("scope flight from");
  EXPECT_GT(held.x, flight.x);  // 1.1 s and 1 s
  d.frame(20);
  d.save_picture("curves-zoomed.png");
  d.click("fit");
  EXPECT_NEAR(control(11).x - control(10).x, apart, 0.01);
  EXPECT_TRUE(d.has("window from"));
}

// A control point that is dragged takes the figure with it; the text has where it was let go.
TEST(Window, AControlPointIsDraggedWithTheFigure) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  d.click("run");
  d.settle();
  gui::Selection selection;
  selection.dofs = {"arm.elbow"};
  d.hub().post(gui::Select{selection});
  d.hub().post(gui::DropGhost{});
  d.frame(2);
  const auto elbow = [](const std::vector<Trajectory>& dofs) {
    return std::ranges::find(dofs, "arm.elbow", &Trajectory::name)->coefficients;
  };
  const auto before = elbow(d.state().curves->dofs);
  const auto present = d.state().present;
  d.drag("control arm.elbow 10", 0, -20, 8, false);
  d.until([&](const gui::State& s) { return elbow(s.curves->dofs) != before; }, "the figure to follow");
  d.frame(3);
  ASSERT_TRUE(d.state().ghost);
  EXPECT_EQ(elbow(d.state().ghost->dofs), before);
  EXPECT_FALSE(d.state().running);
  d.save_picture("curves-dragging.png");
  EXPECT_GT(elbow(d.state().curves->dofs)[10], before[10]);
  d.let_go();
  d.settle();
  const auto followed = elbow(d.state().curves->dofs);  // to where the mouse came to rest
  EXPECT_GT(followed[10], before[10]);
  auto others = followed;
  others[10] = before[10];
  EXPECT_EQ(others, before);
  ASSERT_EQ(d.state().present, present + 1);
  EXPECT_EQ(d.state().log.back().text.find("control arm.elbow 10 = "), 0U) << d.state().log.back().text;
  EXPECT_EQ(elbow(d.state().ghost->dofs), before);  // still: of the motion before
  EXPECT_EQ(batch_curves(text_of(d.state())), present_curves(d.state()));

  // Esc lets it back.
  d.drag("control arm.elbow 8", 0, 30, 8, false);
  d.until([&](const gui::State& s) { return elbow(s.curves->dofs) != followed; }, "the figure to follow");
  d.key(GLFW_KEY_ESCAPE);
  d.let_go();
  d.settle();
  EXPECT_EQ(elbow(d.state().curves->dofs), followed);
  EXPECT_EQ(d.state().present, present + 1);
}

// What constraints cost, instance by instance, after a solve.
TEST(Window, MultipliersAreShownOverTime) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  d.click("run");
  d.settle();
  d.click("show multipliers");
  d.frame(2);
  EXPECT_TRUE(d.has("legend rest[1]"));
  EXPECT_TRUE(d.has("legend held[2]"));
  const auto& all = d.state().motion->multipliers;
  const auto held = std::ranges::find(all, "held", &Multipliers::name);
  ASSERT_NE(held, all.end());
  EXPECT_EQ(held->times.size(), 12U);
  EXPECT_EQ(held->values.front().size(), 2U);
  d.save_picture("curves-multipliers.png");
  d.click("legend flight[1]");  // alone
  EXPECT_FALSE(d.has("legend held[2]"));
  EXPECT_EQ(d.state().selection.constraint, "flight");
  d.frame(2);
  d.save_picture("curves-multipliers-alone.png");

  // By iteration: the objective and its terms, all iterations whoever was too slow to see them.
  d.click("by objective");
  EXPECT_EQ(d.state().record.iterations.front().iteration, 0);
  EXPECT_EQ(d.state().record.iterations.size(), static_cast<std::size_t>(d.state().motion->iterations) + 1);
  EXPECT_EQ(d.state().record.iterations.back().terms.front().first, "energy");
  EXPECT_EQ(d.state().record.iterations.back().objective, d.state().motion->objective);
  d.save_picture("objective.png");
}

// Names select degrees of freedom; what is selected is filtered and shaken, and so it is in a batch.
TEST(Window, TwoDegreesOfFreedomAreFilteredAndShaken) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  d.click("run");
  d.settle();
  d.click("tab Freedom");
  d.frame(2);
  d.click("dof arm.elbow");
  EXPECT_EQ(d.state().selection.dofs, std::vector<std::string>{"arm.elbow"});
  d.screen().key(GLFW_KEY_LEFT_CONTROL, true);
  d.click("dof arm.wrist");
  d.screen().key(GLFW_KEY_LEFT_CONTROL, false);
  d.frame(2);
  EXPECT_EQ(d.state().selection.dofs, (std::vector<std::string>{"arm.elbow", "arm.wrist"}));
  d.click("open filter");
  d.frame(2);
  d.save_picture("filter.png");
  d.click("filter");
  d.settle();
  EXPECT_EQ(d.state().log.back().text, "filter strength 0.5 of arm.elbow, arm.wrist");
  d.click("open shake");
  d.frame(2);
  d.save_picture("shake.png");
  d.click("shake");
  d.settle();
  EXPECT_EQ(d.state().log.back().text, "shake amplitude 0.1 seed 1 of arm.elbow, arm.wrist");
  EXPECT_EQ(batch_curves(text_of(d.state())), present_curves(d.state()));
  d.click("legend arm.wrist");
  EXPECT_EQ(d.state().selection.dofs, std::vector<std::string>{"arm.wrist"});
}

// The curve that the mouse is near says what it is; many names do not run out of the plot.
TEST(Window, CurvesAreReadAndNamed) {
  Driver d(daemons(), 1280, 800);
  std::string scene = "time [0, 2]\ntrajectory bspline spans 8\n";
  for (int i = 0; i < 60; ++i) scene += "dof quite_a_long_name_" + std::to_string(i) + " = " + std::to_string(i) + "\n";
  d.hub().post(gui::OpenText{scene});
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.settle();
  gui::Selection selection;
  for (const Trajectory& dof : d.state().curves->dofs) selection.dofs.push_back(dof.name);
  d.hub().post(gui::Select{selection});
  d.frame(3);
  d.save_picture("curves-many.png");
  ASSERT_TRUE(d.has("legend more"));
  const gui::Rect plot = d.place("curves"), more = d.place("legend more");
  EXPECT_LE(more.x + more.width, plot.x + plot.width);
  selection.dofs = {"quite_a_long_name_7"};
  d.hub().post(gui::Select{selection});
  d.frame(2);
  EXPECT_FALSE(d.has("legend more"));
  EXPECT_TRUE(d.screen().memory().curves.reading.empty());
  d.screen().move(plot.x + plot.width * 0.3F, plot.y + plot.height / 2 + 2);  // a constant in the middle of the plot
  d.frame(2);
  const std::string reading = d.screen().memory().curves.reading;
  EXPECT_TRUE(reading.starts_with("quite_a_long_name_7  0.")) << reading;
  EXPECT_TRUE(reading.ends_with(" s  7")) << reading;
  EXPECT_NEAR(std::stod(reading.substr(reading.find("  "))), 0.6, 0.002);
  d.save_picture("curves-read.png");
}

}  // namespace
}  // namespace spacetime::test
