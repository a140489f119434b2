// The views, drawn without a window: every one of them in both sizes and themes, and the controls in them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

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

TEST(Views, AreDrawn) {
  State state = solved("throw");
  const char* folder = std::getenv("SPACETIME_SCREENSHOTS");
  for (const bool dark : {true, false}) {
    Screen screen(1280, 800);
    state.dark = dark;
    for (int tab = 0; tab < 4; ++tab) {
      screen.memory().tab_left = std::min(tab, 2);
      screen.memory().tab_right = tab;
      for (int k = 0; k < 4; ++k) screen.frame(state);
      if (folder)
        write_png(std::string(folder) + "/throw-" + (dark ? "dark" : "light") + std::to_string(tab) + ".png",
                  screen.image());
    }
  }
}

}  // namespace
}  // namespace spacetime::gui
