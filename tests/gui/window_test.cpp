// The window as a person uses it, driven by injected input: every step is a click, a drag or a key.
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

namespace fs = std::filesystem;

TEST(Window, AThrowIsMadeChangedUndoneSavedAndTheSameInABatch) {
  const std::string here = scratch("throw");
  fs::create_directories(here);
  const std::string file = here + "/throw.scene";
  fs::copy_file(SPACETIME_SOURCE_DIR "/examples/throw.scene", file);
  Driver d(daemons(here + "/state"));
  d.hub().post(gui::Open{file});
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.settle();
  d.save_picture("throw-1-opened.png");

  d.click("run");
  d.settle();
  ASSERT_EQ(d.state().motion->status, Status::converged) << d.state().motion->message;
  d.save_picture("throw-2-solved.png");

  // Scrubbing moves the time to where the mouse is.
  const gui::Rect ruler = d.place("ruler");
  d.drag("ruler", ruler.width * 0.1F, 0);
  EXPECT_NEAR(d.state().playback.time, 1.2, 0.03);
  d.frame(20);  // the help has gone
  d.save_picture("window.png");

  // The basket: the motion follows while it is dragged, and one undo step is left of it.
  const int before = d.state().present;
  d.drag("place Basket", -40, 20, 10, false);
  d.until([](const gui::State& s) { return s.steering.has_value() && s.ghost != nullptr; }, "a drag with a ghost");
  d.frame(10);
  d.save_picture("throw-3-dragging.png");
  d.let_go();
  d.settle();
  EXPECT_EQ(d.state().motion->status, Status::converged) << d.state().motion->message;
  EXPECT_NE(d.state().present, before);
  EXPECT_LT(text_of(d.state()).find("set BasketX"), text_of(d.state()).size());
  d.save_picture("throw-4-dragged.png");

  // An overhand pose: the arm is pulled up by its middle link at 0.5 s, and keyed.
  gui::Playback playback = d.state().playback;
  playback.time = 0.5;
  d.hub().post(gui::SetPlayback{playback});
  d.frame(2);
  const gui::Rect scene = d.place("scene");
  const auto hand = d.place("part arm.upper");
  d.drag("part arm.upper", 0, scene.y + 0.35F * scene.height - hand.y, 12);
  ASSERT_TRUE(d.state().pose.has_value());
  d.save_picture("throw-5-posed.png");
  d.key(GLFW_KEY_K);
  d.settle();
  EXPECT_FALSE(d.state().pose.has_value());
  EXPECT_LT(text_of(d.state()).find("key 0.5:"), text_of(d.state()).size());
  d.click("run");
  d.settle();
  d.save_picture("throw-6-keyed.png");

  // To the beginning and back: nothing is solved again, the bits are the same.
  const std::string last = present_curves(d.state());
  const int steps = d.state().present;
  for (int k = 0; k <= steps && can_undo(d.state()); ++k) {
    d.click("undo");
    d.settle();
  }
  EXPECT_EQ(d.state().present, 0);
  d.save_picture("throw-7-undone.png");
  for (int k = 0; k <= steps && can_redo(d.state()); ++k) {
    d.key(GLFW_KEY_Z, true, true);
    d.settle();
  }
  EXPECT_EQ(d.state().present, steps);
  EXPECT_EQ(present_curves(d.state()), last);

  d.key(GLFW_KEY_S, true);
  d.until([](const gui::State& s) { return !unsaved(s); }, "the file");
  EXPECT_EQ(batch_curves(read_text(file)), last);

  // Opened again, its script leads to the same motion.
  d.hub().post(gui::Open{file});
  d.frame(3);
  d.settle();
  while (!d.state().script.empty()) {
    d.click("run");
    d.settle();
  }
  EXPECT_EQ(present_curves(d.state()), last);
}

// A daemon that never reads or answers holds nothing up: frames are drawn and every input does what it can.
TEST(Window, DrawsAndObeysWhileDaemonsAreSilent) {
  const protocol::Target silent{{"sleep", "600"}, {}, {}};
  for (const bool symbolic_too : {true, false}) {
    gui::HubOptions options = daemons();
    options.optimizer = silent;
    if (symbolic_too) options.symbolic = silent;
    Driver d(options, 960, 600);
    d.hub().post(gui::Open{SPACETIME_SOURCE_DIR "/examples/throw.scene"});
    const char* tabs[] = {"tab Constants", "tab Freedom", "tab Equations", "tab Scene", "tab Log", "tab Console"};
    int frames = 0, handled = 0;
    for (; frames < 300; ++handled) {
      d.click(tabs[handled % 6]);  // five frames
      d.key(GLFW_KEY_F5);
      d.key(GLFW_KEY_T);
      frames += 11;
    }
    EXPECT_EQ(d.screen().memory().scene.trails, handled % 2 == 0);  // every T was taken
    EXPECT_LE(d.state().waiting, symbolic_too ? 0 : handled);  // no F5 is taken twice, or without a scene
    if (symbolic_too) continue;
    EXPECT_TRUE(d.state().scene && d.state().scene->problem);
    d.key(GLFW_KEY_O, true);
    EXPECT_TRUE(d.has("confirm file"));  // a dialog opens
  }
}

// What is open over the window goes with Esc, as the list of keys says.
TEST(Window, EscClosesWhatIsOpen) {
  Driver d(daemons(), 960, 600);
  d.frame(3);
  d.click("examples");
  d.frame(3);
  EXPECT_TRUE(d.has("close welcome"));
  d.key(GLFW_KEY_ESCAPE);
  d.frame(3);
  EXPECT_FALSE(d.has("close welcome"));
  EXPECT_FALSE(d.screen().memory().welcome);
  d.key(GLFW_KEY_F1);
  EXPECT_TRUE(d.screen().memory().shortcuts);
  d.key(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(d.screen().memory().shortcuts);
}

// Where a mistake is told: beside what it is in.
TEST(Window, MistakesAreToldWhereThePersonLooks) {
  const std::string here = scratch("mistakes");
  fs::create_directories(here);
  Driver d(daemons(), 1280, 800);
  d.hub().post(gui::Open{SPACETIME_SOURCE_DIR "/examples/throw.scene"});
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.settle();
  d.click("add new constraint");
  d.write_into("draft new constraint", "high: ball.Z >= 0 at 1");
  d.until([](const gui::State& s) { return !s.notices.empty(); }, "a mistake");
  EXPECT_EQ(d.state().notices.front().place, gui::Notice::Place::equations);
  EXPECT_EQ(d.state().notices.front().about, "new constraint");
  EXPECT_NE(d.state().notices.front().text.find("Z"), std::string::npos) << d.state().notices.front().text;
  d.frame(2);
  d.save_picture("mistake-constraint.png");

  // An infeasible throw says what fights what.
  d.hub().post(gui::Draft{"new constraint", std::nullopt});
  act(d.hub(), "constrain wall: ball.X <= 2 at land");
  d.click("run");
  d.settle();
  EXPECT_EQ(d.state().motion->status, Status::infeasible);
  EXPECT_NE(d.state().motion->message.find("wall"), std::string::npos) << d.state().motion->message;
  d.save_picture("mistake-infeasible.png");
  d.click("undo");
  d.click("undo");
  d.settle();
  for (const gui::Notice& notice : d.state().notices) EXPECT_EQ(notice.text.find("wall"), std::string::npos);

  // A file that cannot be written.
  d.hub().post(gui::Save{"/proc/nothing/here.scene"});
  d.until(
      [](const gui::State& s) {
        return std::ranges::any_of(s.notices,
                                   [](const gui::Notice& n) { return n.text.find("here.scene") != std::string::npos; });
      },
      "a refusal to save");
  d.frame(2);
  d.save_picture("mistake-file.png");

  // A scene with a mistake is shown, and the mistake in it.
  write_text(here + "/wrong.scene",
             "time [0, 1]\ntrajectory bspline spans 8\ndof x\nconstrain a: x = yy at 0\nsolve\n");
  d.hub().post(gui::Open{here + "/wrong.scene"});
  d.until([](const gui::State& s) { return s.scene && !s.scene->problem; }, "a scene with a mistake");
  d.click("tab Scene");
  d.frame(3);
  EXPECT_TRUE(d.has("mistake 4"));
  d.save_picture("mistake-scene.png");
}

// A film is made by a process of its own while the window goes on.
TEST(Window, MakesAStripOfTheMotion) {
  const std::string here = scratch("film");
  fs::create_directories(here);
  Driver d(daemons(), 1280, 800);
  fs::copy_file(SPACETIME_SOURCE_DIR "/examples/throw.scene", here + "/throw.scene");
  d.hub().post(gui::Open{here + "/throw.scene"});
  d.until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  d.click("run");
  d.settle();
  // Another scene that is opened meanwhile does not disturb it.
  d.hub().post(gui::Film{here + "/strip.png", 12, "0,0.5,0,20,15,6"});
  d.hub().post(gui::OpenText{read_text(here + "/throw.scene")});
  d.frame(2);
  EXPECT_TRUE(d.state().film);
  d.until([](const gui::State& s) { return !s.film && !s.notices.empty(); }, "the strip");
  EXPECT_TRUE(fs::exists(here + "/strip.png")) << told(d.state());
  d.settle();
  d.screen().memory().files.dialog = gui::FilesMemory::Dialog::film;
  d.frame(3);
  d.screen().memory().files.folder = here;
  d.frame(2);
  d.click("file strip.png");  // it is there: the dialog says so
  EXPECT_EQ(d.screen().memory().files.name, "strip.png");
  d.save_picture("film-dialog.png");
  // As large as the figure is shown, and what is not possible is told of.
  EXPECT_NEAR(d.screen().memory().files.size[0], d.place("scene").width, 2);
  EXPECT_EQ(d.screen().memory().files.span[1], 2);
  d.screen().memory().files.span[1] = 7;
  d.frame(2);
  d.save_picture("film-fault.png");
  d.click("make film");
  EXPECT_FALSE(d.state().film);
  d.screen().memory().files.span[1] = 1.5;
  d.screen().memory().files.size[0] = 400;
  d.screen().memory().files.size[1] = 300;
  d.frame(2);
  const auto before = fs::last_write_time(here + "/strip.png");
  d.click("make film");
  d.until([](const gui::State& s) { return !s.film; }, "the strip again");
  EXPECT_NE(fs::last_write_time(here + "/strip.png"), before) << told(d.state());
  EXPECT_EQ(gui::read_png(here + "/strip.png").width, 400);
  // One that is stopped says no more.
  d.hub().post(gui::Film{here + "/frames/%04d.png", 0});
  d.frame(2);
  d.hub().post(gui::DropFilm{});
  d.frame(2);
  EXPECT_FALSE(d.state().film);
  d.hub().post(gui::Film{"/proc/nothing/film.mp4", 0});
  d.until([](const gui::State& s) { return !s.film && told(s).find("could not be made") != std::string::npos; },
          "a refusal");
}

// Tables show the question as it stands after an act, though the text declares nothing new.
TEST(Window, TablesFollowTheActs) {
  Driver d(daemons(), 1280, 800);
  d.open_example("throw");
  const auto equation = [&](const std::string& name) {
    const auto& all = d.screen().memory().question.equations;
    return *std::ranges::find(all, name, &gui::Equation::name);
  };
  d.click("enable goal");
  d.settle();
  EXPECT_FALSE(equation("goal").enabled);
  d.click("enable goal");
  d.settle();
  EXPECT_TRUE(equation("goal").enabled);
  act(d.hub(), "weight calm = 0.5");
  act(d.hub(), "scope held over [0, 0.9] every 0.1");
  act(d.hub(), "bound arm.elbow in [-3, 3]");
  act(d.hub(), "window [0.2, 1.4] of arm.elbow, arm.wrist");
  d.frame(3);
  EXPECT_EQ(equation("calm").weight, 0.5);
  EXPECT_TRUE(equation("held").rescoped);
  const gui::Question& question = d.screen().memory().question;
  EXPECT_EQ(question.window, (std::pair{0.2, 1.4}));
  EXPECT_EQ(std::ranges::count(question.dofs, true, &gui::Freedom::in_window), 2);
  EXPECT_EQ(std::ranges::find(question.dofs, "arm.elbow", &gui::Freedom::name)->upper, 3.0);
  d.click("undo");
  d.settle();
  EXPECT_FALSE(d.screen().memory().question.window.has_value());
  // Only the end of a scope that is dragged becomes a number.
  d.drag("scope flight from", -40, 0);
  d.settle();
  EXPECT_NE(d.state().log.back().text.find(", land] every 0.05"), std::string::npos) << d.state().log.back().text;
}

}  // namespace
}  // namespace spacetime::test
