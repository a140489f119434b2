#include "tests/gui/driven.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "protocol/motion_json.h"
#include "tests/process/process.h"

namespace spacetime::test {

gui::HubOptions daemons(const std::string& folder) {
  const auto target = [](const std::string& name) {
    return protocol::Target{{std::string(SPACETIME_BIN_DIR) + "/spacetime-" + name, "serve"}, {}, {}};
  };
  return {target("symbolic"), target("optimizer"), folder, {}};
}

int kills(int usual) {
  const char* asked = std::getenv("SPACETIME_KILLS");
  return asked ? std::atoi(asked) : usual;
}

void until(gui::Hub& hub, const std::function<bool(const gui::State&)>& holds, const std::string& what) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!holds(hub.state())) {
    hub.step(0.001);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (std::chrono::steady_clock::now() > deadline) {
      FAIL() << "waited in vain for " << what << "; told: " << told(hub.state());
    }
  }
}

bool quiet(const gui::State& state) {
  const gui::Work& work = state.work;
  if (work.opening || work.job.task || !work.tasks.empty() || work.run || work.going || work.drag) return false;
  if (work.scripting || state.present < 0) return false;
  const gui::Entry& entry = state.log[state.present];
  if (!entry.scene->problem) return !entry.scene->diagnostics.empty();
  return entry.checkpoint && work.at == entry.number;
}

void until_quiet(gui::Hub& hub) {
  hub.step(0);
  until(hub, quiet, "quiet");
}

void post_and_wait(gui::Hub& hub, gui::Event event) {
  hub.post(std::move(event));
  until_quiet(hub);
}

void act(gui::Hub& hub, const std::string& line) { post_and_wait(hub, gui::Act{line}); }

std::string curves_text(const Motion& motion) {
  Motion curves;
  curves.start = motion.start;
  curves.end = motion.end;
  curves.dofs = motion.dofs;
  curves.parameters = motion.parameters;
  curves.constants = motion.constants;
  return write(curves);
}

std::string present_curves(const gui::State& state) { return curves_text(*state.log[state.present].motion); }

std::string batch_curves(const std::string& text) {
  const Result result = solve_scene(text);
  EXPECT_NE(result.code, 1) << result.err;
  return curves_text(read_motion(result.out));
}

std::string told(const gui::State& state) {
  std::string text;
  for (const gui::Notice& notice : state.notices) text += notice.text + "\n";
  return text;
}

}  // namespace spacetime::test
