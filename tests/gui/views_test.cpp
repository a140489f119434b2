// The views, drawn without a window: every one of them in both sizes and themes, and the controls in them.
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>

#include "common/files.h"
#include "common/sample.h"
#include "gui/holds.h"
#include "gui/scene_picture.h"
#include "gui/screen.h"
#include "gui/views/curve_values.h"
#include "optimizer/run.h"
#include "symbolic/compile.h"

namespace spacetime::gui {
namespace {

std::shared_ptr<const Scene> scene_of(const std::string& text) {
  auto compiled = symbolic::compile(text);
  auto scene = std::make_shared<Scene>();
  scene->text = text;
  if (compiled.problem) scene->problem = std::make_shared<Problem>(*compiled.problem);
  scene->diagnostics = compiled.diagnostics;
  return scene;
}

State solved(const std::string& name) {
  State state;
  state.scene = scene_of(read_text(SPACETIME_SOURCE_DIR "/examples/" + name + ".scene"));
  optimizer::RunOptions options;
  options.frames_per_second = 100;
  options.record = true;
  const Motion motion = optimizer::run(*state.scene->problem, options);
  state.motion = std::make_shared<Motion>(motion);
  state.curves = std::make_shared<Curves>(Curves{motion.dofs, motion.constants, motion.parameters});
  state.samples = std::make_shared<Samples>(*motion.samples);
  state.record = {motion.record, {20}};
  state.file = "throw.scene";
  state.symbolic.condition = state.optimizer.condition = Daemon::Condition::ready;
  for (const Dof& dof : state.scene->problem->dofs) state.selection.dofs.push_back(dof.name);
  state.playback.time = 1;
  return state;
}

struct Format {
  int width, height;
  float scale;
};

// Whether all controls are on the screen, as far as they are not in a list that scrolls.
void expect_inside(Screen& screen, int width, int height) {
  for (const auto& [name, r] : screen.memory().places) {
    if (name.starts_with("part ") || name.starts_with("place ") || name.starts_with("control ")) continue;
    EXPECT_GE(r.x, -1) << name;
    EXPECT_GE(r.y, -1) << name;
    EXPECT_LE(r.x + r.width, static_cast<float>(width) + 1) << name;
    const bool scrolls = name.starts_with("expression") || name.starts_with("entry") || name.starts_with("file ") ||
                         name.starts_with("example");
    EXPECT_TRUE(scrolls || r.y + r.height <= static_cast<float>(height) + 1) << name;
  }
}

// What is only looked at, or a place where the mouse does many things.
// Control points tell their numbers in place of help, names of curves what a click on them does.
constexpr std::array seen{"part ",  "control ", "place ",   "mistake ",         "time",  "title", "outcome", "scene",
                          "curves", "legend ",  "standing", "newest iteration", "terms", "help"};

void expect_help(Screen& screen) {
  for (const auto& [name, r] : screen.memory().places) {
    const auto is_seen = [&](const char* one) { return name.starts_with(one); };
    EXPECT_TRUE(screen.memory().helped.contains(name) || std::ranges::any_of(seen, is_seen)) << name;
  }
}

// What asks ImGui for a control: whole names, and beginnings of names with a digit or a capital behind.
bool asks_for_control(std::string_view function) {
  constexpr std::array names{"Button",     "SmallButton", "Checkbox",        "RadioButton", "Combo",
                             "Selectable", "MenuItem",    "InvisibleButton", "BeginMenu"};
  constexpr std::array beginnings{"Input", "Drag", "Slider"};
  const auto begins = [&](std::string_view one) {
    return function.starts_with(one) && function.size() > one.size() && std::isupper(function[one.size()]) != 0;
  };
  return std::ranges::find(names, function) != names.end() || std::ranges::any_of(beginnings, begins);
}

// Every control that ImGui is asked for stands before a `control` of its own in the source, which has help by its type.
TEST(ViewsSource, EveryControlIsNamedAndHelpedWith) {
  constexpr std::string_view library = "ImGui::";
  int asked = 0;
  for (const auto& file : std::filesystem::directory_iterator(SPACETIME_SOURCE_DIR "/gui/views")) {
    if (file.path().extension() != ".cpp") continue;
    const std::string text = read_text(file.path());
    for (auto at = text.find(library); at != std::string::npos; at = text.find(library, at + 1)) {
      const std::string function = text.substr(at + library.size(), text.find('(', at) - at - library.size());
      if (!asks_for_control(function)) continue;
      // Up to the next control that is asked for.
      auto next = text.find(library, at + 1);
      const auto asks = [&] {
        return asks_for_control(text.substr(next + library.size(), text.find('(', next) - next - library.size()));
      };
      while (next != std::string::npos && !asks()) next = text.find(library, next + 1);
      const std::string behind = text.substr(at + library.size(), next == std::string::npos ? next : next - at);
      ++asked;
      const bool helped = behind.find("control(") != std::string::npos || behind.find("here(\"curves\")") < 200 ||
                          behind.find("here(\"scene\")") < 200;
      EXPECT_TRUE(helped) << file.path() << ": " << behind.substr(0, 60);
    }
  }
  EXPECT_GT(asked, 40);
}

// What is held is known where a constraint ties it and the picture shows it touching: not in flight, and not while the
// sketch has it elsewhere.
TEST(Holds, ABallIsInTheHandAsLongAsItIsTiedToIt) {
  State state = solved("throw");
  const Figures figures(*state.scene->problem);
  const auto holds = [&](double time) {
    state.playback.time = time;
    const Question question = question_of(state);
    const Picture picture = picture_of(state, question, {}, figures, {false, false, false, false});
    return holds_at(question, *state.scene->problem, *state.curves, figures, picture, time);
  };
  const std::vector<Hold> hand{{"arm.palm", "ball.slideY"}};
  EXPECT_EQ(holds(0), hand);
  EXPECT_EQ(holds(0.537), hand);
  EXPECT_EQ(holds(1.1), hand);
  EXPECT_TRUE(holds(1.3).empty());
  auto apart = std::make_shared<Curves>(*state.curves);
  for (Trajectory& dof : apart->dofs)
    if (dof.name == "ball.X") std::ranges::fill(dof.coefficients, 2.0);
  state.curves = apart;
  EXPECT_TRUE(holds(0.537).empty());
}

// The torque of each joint stands at the joint.
TEST(ScenePicture, ForcesStandAtTheirJoints) {
  State state = solved("throw");
  state.playback.time = 0.9;
  const Figures figures(*state.scene->problem);
  const Picture picture = picture_of(state, question_of(state), {}, figures, {false, false, true, false});
  ASSERT_EQ(picture.torques.size(), 3U);
  const auto between = [&](int a, int b) {
    return glm::length(picture.torques[static_cast<std::size_t>(a)].centre -
                       picture.torques[static_cast<std::size_t>(b)].centre);
  };
  EXPECT_NEAR(between(0, 1), 0.5, 1e-4);
  EXPECT_NEAR(between(1, 2), 0.4, 1e-4);
}

// A creature's force is no place, though it has three components.
TEST(ScenePicture, OnlyPlacesHaveWays) {
  const Figures figures(*solved("throw").scene->problem);
  const auto points = figures.points();
  EXPECT_EQ(std::ranges::count(points, "arm.hand"), 1);
  EXPECT_EQ(std::ranges::count(points, "arm.force"), 0);
}

// No two curves look alike, whatever is selected; and where there is nothing to be seen, the plot says why.
TEST(Curves, AreToldApartAndSayWhatLacks) {
  State state = solved("throw");
  Screen screen(1280, 800);
  std::vector<Event> events;
  const Ui ui{state, screen.memory(), events};
  using Show = CurvesMemory::Show;
  CurvesMemory& m = screen.memory().curves;
  const auto alike = [&] {
    screen.frame(state);
    std::map<std::tuple<float, float, float, int>, std::set<std::string>> looks;
    for (const Plotted& curve : curves_shown(ui))
      looks[{curve.colour.x, curve.colour.y, curve.colour.z, curve.style}].insert(curve.name);
    return std::ranges::count_if(looks, [](const auto& look) { return look.second.size() > 1; });
  };
  state.selection.expressions = {"arm.force", "arm.hand", "ball.force"};
  EXPECT_EQ(alike(), 0);
  EXPECT_EQ(m.lacking, "");
  auto costly = std::make_shared<Motion>(*state.motion);
  for (const auto& [name, components] : {std::pair{"rest", 6}, {"held", 2}, {"flight", 2}, {"goal", 2}}) {
    std::vector<double> row;
    for (int c = 0; c < components; ++c) row.push_back(c % 2 ? c : -c);
    costly->multipliers.push_back({name, 0, {0, 1}, {row, row}});
  }
  state.motion = costly;
  m.show = Show::multipliers;
  EXPECT_EQ(alike(), 0);
  EXPECT_EQ(curves_shown(ui).size(), 12U);
  EXPECT_EQ(m.lacking, "");
  auto crowded = std::make_shared<Motion>(*state.motion);
  for (int k = 0; k < 12; ++k) {
    crowded->multipliers.push_back(crowded->multipliers.front());
    crowded->multipliers.back().name = "more " + std::to_string(k);
  }
  state.motion = crowded;
  EXPECT_EQ(alike(), 0);
  ASSERT_EQ(curves_shown(ui).front().name, "rest (largest of 6)");
  EXPECT_EQ(curves_shown(ui).front().values.front(), 5);

  auto before = std::make_shared<Motion>(*state.motion);
  before->iterations = 0;
  state.motion = before;
  screen.frame(state);
  EXPECT_TRUE(curves_shown(ui).empty());
  EXPECT_TRUE(m.lacking.starts_with("Solve to see")) << m.lacking;
  m.show = Show::curves;
  state.selection = {};
  screen.frame(state);
  EXPECT_TRUE(m.lacking.starts_with("Select")) << m.lacking;
  state.selection.expressions = {"ball.force"};
  state.samples = nullptr;
  screen.frame(state);
  EXPECT_EQ(m.lacking, "ball.force: not known yet. Solve to see it.");
  state.samples = std::make_shared<Samples>(Samples{{0, 1}, {{"ball.force", {{NAN}, {NAN}}}}, {}});
  screen.frame(state);
  EXPECT_NE(m.lacking.find("no number"), std::string::npos) << m.lacking;
  state.samples = std::make_shared<Samples>(Samples{{1}, {{"ball.force", {{2}}}}, {}});
  screen.frame(state);
  EXPECT_EQ(m.lacking, "");
  EXPECT_EQ(curves_shown(ui).size(), 1U);
}

class Views : public testing::TestWithParam<std::tuple<Format, bool>> {};

TEST_P(Views, AreDrawnInside) {
  const auto& [format, dark] = GetParam();
  static const State throw_state = solved("throw");
  State state = throw_state;
  state.dark = dark;
  state.left = {{"journal", "lost.scene"}};
  Screen screen(format.width, format.height, format.scale);
  const std::string name = fmt::format("{}x{}-{}", format.width, format.height, dark ? "dark" : "light");
  const auto take = [&](const std::string& what) {
    for (int k = 0; k < 3; ++k) screen.frame(state);
    expect_inside(screen, format.width, format.height);
    expect_help(screen);
    if (const char* folder = std::getenv("SPACETIME_SCREENSHOTS"))
      write_png(fmt::format("{}/view-{}-{}.png", folder, name, what), screen.image());
  };
  const char* tabs[] = {"equations", "constants", "freedom", "console"};
  for (int tab = 0; tab < 4; ++tab) {
    screen.memory().tab_left = std::min(tab, 2);
    screen.memory().tab_right = tab;
    screen.memory().scene.forces = tab == 1;
    screen.memory().curves.show = tab == 3 ? CurvesMemory::Show::residuals : CurvesMemory::Show::curves;
    take(tabs[tab]);
  }
  state.drafts["new constraint"] = "high: ball.Y >= 0.2 over [release, land]";
  state.notices.push_back(
      {Notice::Place::equations, Severity::error, "there is no 'ball.Z'; did you mean 'ball.X'?", "new constraint", 0});
  screen.memory().tab_left = 0;
  take("draft");
  screen.memory().welcome = true;
  take("welcome");
  screen.memory().welcome = false;
  take("between");
  screen.memory().shortcuts = true;
  take("shortcuts");
  screen.memory().shortcuts = false;
  take("between");
  using Dialog = FilesMemory::Dialog;
  for (const auto& [dialog, what] : {std::pair{Dialog::open, "open"}, {Dialog::save, "save"}, {Dialog::film, "film"}}) {
    screen.memory().files.dialog = dialog;
    take(what);
    screen.key(GLFW_KEY_ESCAPE, true);
    screen.frame(state);
    screen.key(GLFW_KEY_ESCAPE, false);
    take("between");
  }
  screen.memory().leaving = Leaving{};
  take("guard");
  screen.memory().leaving.reset();
  for (const char* menu : {"File", "Edit", "View", "Help"}) {
    const auto click = [&](const Rect& r) {
      screen.move(r.x + r.width / 2, r.y + r.height / 2);
      screen.frame(state);
      screen.button(0, true);
      screen.button(0, false);
      for (int k = 0; k < 3; ++k) screen.frame(state);
    };
    const std::string control = std::string("menu ") + menu;
    for (int k = 0; k < 3; ++k) screen.frame(state);
    if (!screen.memory().places.contains(control)) {
      ADD_FAILURE() << control;
      continue;
    }
    const Rect place = screen.memory().places.at(control);
    click(place);
    take(std::string("menu-") + menu);
    click(place);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Views,
                         testing::Combine(testing::Values(Format{1280, 800, 1}, Format{2560, 1440, 1.5F}),
                                          testing::Bool()));

}  // namespace
}  // namespace spacetime::gui
