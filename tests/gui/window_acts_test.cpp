// What acts on the window lead to and tell: leaving a scene that is not saved, menus and their keys, weights, the
// panel of the run, the log, help.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/files.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

bool is_told(const gui::State& s, const std::string& words) { return told(s).find(words) != std::string::npos; }

// A scene without a file that is left: saved under a name first, then what was asked for comes.
TEST(Window, WhatWasAskedForComesAfterSavingUnderAName) {
  const std::string folder = scratch("window_acts_leaving");
  std::filesystem::create_directories(folder);
  Driver d(daemons());
  d.open_example("double_integrator");
  act(d.hub(), "iterate 1");
  const auto ask_for_name = [&](const std::string& name) {
    d.frame(3);
    d.click("guard save");
    d.frame(3);
    ASSERT_TRUE(d.has("confirm file"));
    d.screen().memory().files.folder = folder;
    d.frame(2);
    d.key(GLFW_KEY_A, true);
    d.type(name);
  };
  d.key(GLFW_KEY_N, true);
  ask_for_name("given_up.scene");
  d.click("cancel file");  // cancels it all
  d.frame(5);
  EXPECT_EQ(d.state().log.size(), 2U);
  EXPECT_FALSE(d.has("guard save"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/given_up.scene"));

  d.key(GLFW_KEY_N, true);
  ask_for_name("kept.scene");
  d.click("confirm file");
  d.until([](const gui::State& s) { return s.log.size() == 1 && s.curves; }, "the new scene");
  EXPECT_NE(read_text(folder + "/kept.scene").find("iterate 1"), std::string::npos);

  // Where it cannot be written nothing is left, and it is told why.
  d.settle();
  act(d.hub(), "iterate 1");
  d.key(GLFW_KEY_Q, true);
  ask_for_name("no/such/folder.scene");
  d.click("confirm file");
  d.until([](const gui::State& s) { return is_told(s, "folder.scene"); }, "a refusal");
  d.frame(5);
  EXPECT_FALSE(d.screen().memory().quit);
  EXPECT_FALSE(d.screen().memory().leaving.has_value());

  d.key(GLFW_KEY_Q, true);
  ask_for_name("last.scene");
  d.click("confirm file");
  d.until([&](const gui::State&) { return d.screen().memory().quit; }, "the end");
  EXPECT_TRUE(std::filesystem::exists(folder + "/last.scene"));
  EXPECT_TRUE(is_told(d.state(), "last.scene is saved."));
}

TEST(Window, KeysWorkWhileAMenuIsOpen) {
  const std::string file = scratch("window_acts_menu.scene");
  write_text(file, read_text(SPACETIME_SOURCE_DIR "/examples/double_integrator.scene"));
  Driver d(daemons());
  d.hub().post(gui::Open{file});
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.settle();
  d.click("menu View");
  d.frame(2);
  ASSERT_TRUE(d.has("menu Trails"));
  d.key(GLFW_KEY_ESCAPE);
  d.frame(2);
  EXPECT_FALSE(d.has("menu Trails"));
  act(d.hub(), "iterate 1");
  d.click("menu Edit");
  d.frame(2);
  ASSERT_TRUE(d.has("menu Undo"));
  d.key(GLFW_KEY_S, true);
  d.until([](const gui::State& s) { return is_told(s, "window_acts_menu.scene is saved."); }, "the file");
  d.frame(2);
  EXPECT_FALSE(d.has("menu Undo"));
  EXPECT_NE(read_text(file).find("iterate 1"), std::string::npos);
  // Of a degree of freedom, too; and Esc there stops nothing.
  d.click("tab Freedom");
  d.frame(2);
  d.click("dof x", 1);
  d.frame(2);
  ASSERT_TRUE(d.has("refine dof"));
  d.key(GLFW_KEY_ESCAPE);
  d.frame(2);
  EXPECT_FALSE(d.has("refine dof"));
}

double weight_of(Driver& d, const std::string& name) {
  const auto& all = d.screen().memory().question.equations;
  return std::ranges::find(all, name, &gui::Equation::name)->weight.value_or(-1);
}

// A weight is steered like a constant: the motion follows while it is dragged, and one act is left.
TEST(Window, TheMotionFollowsAWeight) {
  Driver d(daemons());
  d.open_example("throw");
  d.click("run");
  d.settle();
  const auto energy = [&] { return d.state().motion->terms.front().second / weight_of(d, "energy"); };
  const double before = energy();
  const int present = d.state().present;
  d.drag("weight energy", 90, 0, 10, false);
  d.until([](const gui::State& s) { return s.steering && s.ghost; }, "a drag");
  d.frame(5);
  d.save_picture("weight-dragged.png");
  d.let_go();
  d.settle();
  EXPECT_GT(weight_of(d, "energy"), 1.2);
  EXPECT_EQ(d.state().present, present + 1);
  EXPECT_EQ(d.state().motion->status, Status::converged) << d.state().motion->message;
  EXPECT_NE(d.state().log.back().text.find("weight energy = "), std::string::npos);
  EXPECT_LT(energy(), before);
  EXPECT_EQ(batch_curves(text_of(d.state())), curves_text(*d.state().motion));

  // Back to the pale motion, as the button says; the run before is not undone.
  d.frame(2);
  d.click("go back");
  d.settle();
  EXPECT_EQ(d.state().present, present);
  EXPECT_EQ(weight_of(d, "energy"), 1);
}

// What is typed behind Ctrl+A arrives whole, however few frames there are.
TEST(Window, AWeightIsWrittenBehindCtrlA) {
  Driver d(daemons());
  d.open_example("throw");
  d.click("run");
  d.settle();
  d.click("weight calm");
  d.frame(2);
  gui::Screen& screen = d.screen();
  screen.key(GLFW_KEY_LEFT_CONTROL, true);
  screen.key(GLFW_KEY_A, true);
  screen.key(GLFW_KEY_A, false);
  screen.key(GLFW_KEY_LEFT_CONTROL, false);
  screen.type("0.0125");
  screen.key(GLFW_KEY_ENTER, true);
  screen.key(GLFW_KEY_ENTER, false);
  d.frame(8);
  d.settle();
  EXPECT_EQ(weight_of(d, "calm"), 0.0125);
  EXPECT_EQ(d.state().log.back().text.substr(0, 20), "weight calm = 0.0125");
  EXPECT_EQ(d.state().motion->status, Status::converged);  // it was solved for at once
}

// The panel numbers a run's iterations from its start; one alone is a dot within the axes.
TEST(Window, ThePanelTellsOfTheRun) {
  for (const auto& [width, height, scale] : {std::tuple{1280, 800, 1.0F}, {2560, 1440, 1.5F}}) {
    Driver d(daemons(), width, height, scale);
    d.open_example("throw");
    const std::string name = "panel-" + std::to_string(width);
    const auto standing = [&] { return d.screen().memory().standing; };
    EXPECT_EQ(standing(), "Not solved yet: press Run.");
    d.click("run");
    d.settle();
    const int first = d.state().motion->iterations;
    EXPECT_EQ(standing(), "Run 1: converged after " + std::to_string(first) + " iterations");
    act(d.hub(), "set release = 1.05");
    d.frame(2);
    EXPECT_EQ(standing(), "Edited: press Run");
    d.save_picture(name + "-edited.png");
    d.click("step");
    d.settle();
    EXPECT_EQ(standing(), "Run 2: stopped after 1 iteration (" + std::to_string(first + 1) + " in all)");
    EXPECT_EQ(d.state().record.run, 2);
    EXPECT_EQ(d.state().record.made(), 1);
    d.screen().move(0, 0);
    d.frame(3);
    d.save_picture(name + "-step.png");
    const gui::Rect plot = d.place("by iteration"), newest = d.place("newest iteration");
    EXPECT_GT(newest.x, plot.x + plot.width / 2);
    EXPECT_LT(newest.x, plot.x + plot.width);
    EXPECT_GT(newest.y, plot.y);
    EXPECT_LT(newest.y, plot.y + plot.height);
    d.click("by objective");
    d.screen().move(0, 0);
    d.frame(3);
    d.save_picture(name + "-step-objective.png");

    // Whatever there is to say, the table stays in sight.
    act(d.hub(), "constrain wall: ball.X <= 2 at land");
    d.click("run");
    d.settle();
    EXPECT_EQ(d.state().motion->status, Status::infeasible);
    d.screen().move(0, 0);
    d.frame(4);
    d.save_picture(name + "-infeasible.png");
    const gui::Rect last = d.place("terms");
    EXPECT_LT(last.y + last.height, d.place("ruler").y - 20 * scale);
    const gui::Rect chart = d.place("by iteration");  // and the chart with its names
    EXPECT_LT(chart.y + chart.height + 20 * scale, d.place("bottom edge").y);
    d.click("tab Log");
    d.frame(3);
    d.save_picture(name + "-log.png");
    const gui::Rect entry = d.place("entry 1");
    EXPECT_LE(entry.x + entry.width, static_cast<float>(width));
  }
}

// A long line of the log is wrapped, with what came of it first.
TEST(Window, LongLinesOfTheLogAreWrapped) {
  Driver d(daemons());
  d.open_example("double_integrator");
  act(d.hub(), "iterate 1");
  act(d.hub(), "constrain a_rather_long_name: x + 0.1 * x' + 0.01 * x'' <= 10 over [0.1, 0.9] every 0.05");
  d.click("tab Log");
  d.frame(3);
  EXPECT_GT(d.place("entry 2").height, 1.5F * d.place("entry 1").height);
}

// Help comes when the mouse stays, beside the control, and goes with a press until the mouse has left.
TEST(Window, HelpStandsBesideWhatItIsOf) {
  Driver d(daemons(), 960, 600);
  d.open_example("throw");
  const auto rest_on = [&](const std::string& name, double seconds) {
    const gui::Rect r = d.place(name);
    d.screen().move(r.x + r.width / 2, r.y + r.height / 2);
    for (int k = 0; k < 6; ++k) d.screen().frame(d.state(), seconds / 5);
  };
  for (const char* name : {"step", "tab Constants", "enable goal", "method", "menu File", "weight calm"}) {
    rest_on(name, 0.3);
    EXPECT_FALSE(d.has("help")) << name;
    rest_on(name, 1);
    ASSERT_TRUE(d.has("help")) << name;
    const gui::Rect help = d.place("help"), control = d.place(name);
    EXPECT_TRUE(help.y >= control.y + control.height || help.y + help.height <= control.y) << name;
    EXPECT_GE(help.x, 0) << name;
    EXPECT_LE(help.x + help.width, 960) << name;
  }
  d.save_picture("help.png");
  rest_on("tab Freedom", 1);
  EXPECT_TRUE(d.has("help"));
  d.click("tab Freedom");
  rest_on("tab Freedom", 2);
  EXPECT_FALSE(d.has("help"));
  rest_on("tab Constants", 0.1);
  rest_on("tab Freedom", 1);
  EXPECT_TRUE(d.has("help"));
  d.click("menu View");
  rest_on("menu Trails", 1);
  ASSERT_TRUE(d.has("help"));
  const gui::Rect entry = d.place("menu Trails");
  EXPECT_GE(d.place("help").x, entry.x + entry.width);
}

// A run can be slowed down, to be watched and paused; it comes to the same bits.
TEST(Window, ASlowRunIsWatchedAndPaused) {
  Driver d(daemons());
  d.open_example("throw");
  d.click("pace");
  d.frame(2);
  d.save_picture("pace.png");
  d.click("pace 8 a second");
  d.frame(2);
  EXPECT_EQ(d.state().pace, 8);
  d.click("run");
  d.until([](const gui::State& s) { return s.record.made() >= 3; }, "iterations");
  EXPECT_TRUE(d.state().running);  // for some seconds more
  EXPECT_LT(d.state().record.made(), 50);
  d.frame(2);
  EXPECT_TRUE(d.screen().memory().standing.starts_with("Run 1: solving, iteration ")) << d.screen().memory().standing;
  d.click("pause");
  d.settle();
  ASSERT_TRUE(can_continue(d.state()));
  d.frame(2);
  EXPECT_TRUE(d.screen().memory().standing.starts_with("Run 1: paused after ")) << d.screen().memory().standing;
  d.save_picture("paused.png");
  d.hub().post(gui::SetPace{0});
  d.frame();
  d.click("continue");
  d.settle();
  EXPECT_EQ(d.state().motion->status, Status::converged);
  EXPECT_EQ(batch_curves(text_of(d.state())), curves_text(*d.state().motion));
}

TEST(Window, GhostsAnswerTheirKey) {
  Driver d(daemons());
  d.frame(2);
  d.key(GLFW_KEY_G);
  d.frame(2);
  EXPECT_TRUE(is_told(d.state(), "There is no figure yet to pin a ghost of."));
  d.open_example("throw");
  d.key(GLFW_KEY_G);
  d.frame(2);
  EXPECT_TRUE(is_told(d.state(), "A ghost is pinned at 0 s"));
  d.key(GLFW_KEY_G);
  d.frame(2);
  EXPECT_TRUE(is_told(d.state(), "The ghost at 0 s is gone."));
  d.key(GLFW_KEY_G, false, true);
  d.frame(2);
  EXPECT_TRUE(is_told(d.state(), "The ghosts along the motion are put away."));
}

// A new scene is looked at as if it were the first.
TEST(Window, ANewSceneIsFramedAnew) {
  const auto camera = [](Driver& d) {
    d.key(GLFW_KEY_N, true);
    d.until([](const gui::State& s) { return s.curves && text_of(s).find("cart") != std::string::npos; }, "a scene");
    d.settle();
    d.frame(5);
    return d.screen().memory().scene.camera;
  };
  const gui::Camera first = [&] {
    Driver d(daemons());
    return camera(d);
  }();
  Driver d(daemons());
  d.open_example("throw");
  d.key(GLFW_KEY_4);
  d.wheel("scene", 5);
  d.frame(3);
  const gui::Camera then = camera(d);
  d.save_picture("new-framed.png");
  EXPECT_EQ(then, first);
}

}  // namespace
}  // namespace spacetime::test
