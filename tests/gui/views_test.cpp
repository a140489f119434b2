// The views, drawn without a window: every one of them in both sizes and themes, and the controls in them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/files.h"
#include "common/sample.h"
#include "gui/screen.h"
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
  state.record = motion.record;
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
    const bool scrolls = name.starts_with("expression") || name.starts_with("entry") || name.starts_with("example");
    EXPECT_TRUE(scrolls || r.y + r.height <= static_cast<float>(height) + 1) << name;
  }
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
}

INSTANTIATE_TEST_SUITE_P(All, Views,
                         testing::Combine(testing::Values(Format{1280, 800, 1}, Format{2560, 1440, 1.5F}),
                                          testing::Bool()));

}  // namespace
}  // namespace spacetime::gui
