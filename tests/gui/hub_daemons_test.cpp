// Daemons that die, or never say anything.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using namespace gui;

const std::vector<std::string> acts{"solve", "set BasketX = 2.3", "solve", "key 0.5: arm.elbow = 0.25", "solve"};

std::string motion_of_a_session(Hub& hub) {
  post_and_wait(hub, OpenText{text_of("examples/throw.scene")});
  for (const std::string& line : acts) act(hub, line);
  post_and_wait(hub, Undo{});
  act(hub, "iterate 2");
  EXPECT_EQ(hub.state().log.size(), 6U) << told(hub.state());
  return curves_text(*hub.state().motion);
}

TEST(HubDaemons, AreStartedAgainWithoutATrace) {
  const auto begun = std::chrono::steady_clock::now();
  Hub undisturbed(daemons());
  const std::string expected = motion_of_a_session(undisturbed);
  // Of a session, so that there is time to start a daemon between two kills however slow everything is.
  const std::chrono::duration<double> session = std::chrono::steady_clock::now() - begun;
  for (const bool optimizer : {false, true}) {
    std::mt19937 random(1997);
    Hub hub(daemons());
    std::atomic<bool> over = false;
    std::atomic<int> killed = 0;
    std::thread killer([&] {
      while (!over) {
        std::this_thread::sleep_for(std::uniform_real_distribution<double>(0.1, 0.6)(random) * session);
        const int process = optimizer ? hub.optimizer_process() : hub.symbolic_process();
        if (process != 0 && kill(process, SIGKILL) == 0) ++killed;
      }
    });
    for (int i = 0; i < 2 || killed < kills(3); ++i)
      EXPECT_TRUE(motion_of_a_session(hub) == expected) << (optimizer ? "optimizer" : "symbolic");
    over = true;
    killer.join();
    EXPECT_GE(killed, kills(3));
    EXPECT_GT((optimizer ? hub.state().optimizer : hub.state().symbolic).restarts, 0);
  }
}

TEST(HubDaemons, ThatNeverAnswerHoldUpNothing) {
  for (const std::vector<std::string>& program :
       {std::vector<std::string>{"sleep", "60"}, std::vector<std::string>{"sh", "-c", "cat > /dev/null"}}) {
    HubOptions options = daemons();
    options.optimizer.program = program;
    Hub hub(options);
    hub.post(OpenText{text_of("examples/throw.scene")});
    until(
        hub, [](const State& state) { return state.present == 0; }, "the scene");
    for (int i = 0; i < 300; ++i) {
      const Words words = set_words("BasketX", 2 + 0.001 * i);
      hub.post(Steer{{words.line, {words.action}}});
      if (i % 7 == 0) hub.post(Act{"set BasketX = 2.3"});
      if (i % 11 == 0) hub.post(Undo{});
      if (i % 13 == 0) hub.post(Steered{i % 2 == 0});
      hub.step(0.01);  // returns, or this test does not
    }
    EXPECT_LE(hub.state().work.wanted.size(), 20U);
    EXPECT_LE(hub.state().work.tasks.size(), 10U);  // what came after the last Undo
    EXPECT_EQ(hub.state().scene->outline.empty(), false);
  }
}

TEST(HubDaemons, ThatCannotBeStartedAreTold) {
  HubOptions options = daemons();
  options.optimizer.program = {"/nowhere/spacetime-optimizer"};
  Hub hub(options);
  hub.post(OpenText{text_of("examples/throw.scene")});
  until(
      hub,
      [](const State& state) { return state.optimizer.condition == Daemon::Condition::lost && state.present == 0; },
      "the loss");
  EXPECT_NE(told(hub.state()).find("lost"), std::string::npos) << told(hub.state());
  EXPECT_TRUE(hub.state().scene->problem);
}

}  // namespace
}  // namespace spacetime::test
