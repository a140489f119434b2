// The window killed in the midst of its work: what was done before is there when it is opened again.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <thread>

#include "common/files.h"
#include "tests/gui/driven.h"
#include "tests/gui/driver.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The throw without its last line, so that a person has it solved.
std::string unsolved() {
  const std::string text = text_of("examples/throw.scene");
  return text.substr(0, text.rfind("\nsolve") + 1);
}

// A session by mouse and keys.  After every act the text is kept in `kept` under the act's number.
void work(const std::string& folder, const std::string& kept) {
  Driver d(daemons(folder), 960, 600);
  int done = 0;
  const auto next = [&] {
    d.settle();
    d.until([&](const gui::State&) { return d.hub().written(); }, "the journal");
    write_text(kept + "/" + std::to_string(done++), text_to_save(d.state()));
  };
  d.hub().post(gui::OpenText{unsolved()});
  d.until([](const gui::State& state) { return state.present == 0; }, "the scene");
  next();
  d.click("run"), next();
  d.drag("place Basket", -30, 15, 6), next();
  d.key(GLFW_KEY_Z, true), next();
  d.key(GLFW_KEY_Z, true, true), next();
  d.click("enable calm"), next();
  d.click("step"), next();
  d.drag("place Basket", 20, 0, 4), next();
  d.key(GLFW_KEY_Z, true), next();
  d.click("run"), next();
}

// In a process of its own, which is killed after that long (s), or left to end; how long it took (s).
double work_apart(const std::string& folder, const std::string& kept, std::optional<double> killed_after) {
  const auto began = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    work(folder, kept);
    _exit(testing::Test::HasFailure() ? 1 : 0);
  }
  if (killed_after) {
    std::this_thread::sleep_for(std::chrono::duration<double>(*killed_after));
    kill(child, SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(killed_after ? true : WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return std::chrono::duration<double>(Clock::now() - began).count();
}

std::vector<std::string> texts_in(const std::string& kept) {
  std::vector<std::string> texts;
  for (int k = 0; fs::exists(kept + "/" + std::to_string(k)); ++k)
    texts.push_back(read_text(kept + "/" + std::to_string(k)));
  return texts;
}

// Nothing of what was done is lost but the act in flight, whose entry may be there, or a part of it.
TEST(WindowKilled, LosesAtMostTheActInFlight) {
  std::mt19937 random(1997);
  const std::string whole = scratch("whole");
  fs::create_directories(whole);
  const double seconds = work_apart(scratch("whole_state"), whole, {});
  const auto expected = texts_in(whole);
  ASSERT_EQ(expected.size(), 10U);
  int met = 0;  // sessions that had begun
  for (int round = 0; round < kills(3); ++round) {
    const std::string folder = scratch("state" + std::to_string(round)), kept = scratch("kept" + std::to_string(round));
    fs::create_directories(kept);
    const double moment = std::uniform_real_distribution<double>(0.2, 0.95)(random) * seconds;
    work_apart(folder, kept, moment);
    const auto known = texts_in(kept);
    if (known.empty()) continue;  // it was only starting
    ++met;
    const std::string where = "killed after " + std::to_string(moment) + " s, behind act " +
                              std::to_string(known.size() - 1) + " of " + std::to_string(expected.size() - 1);
    ASSERT_EQ(known, (std::vector(expected.begin(), expected.begin() + static_cast<long>(known.size())))) << where;
    const std::string& before = known.back();
    const std::string& after = expected[std::min(known.size(), expected.size() - 1)];

    gui::Hub hub(daemons(folder));
    until(
        hub, [](const gui::State& state) { return state.left.size() == 1; }, "what was left behind");
    hub.post(gui::Open{hub.state().left[0].journal});
    until(
        hub, [](const gui::State& state) { return state.present >= 0; }, "the journal");
    until_quiet(hub);
    const std::string text = text_to_save(hub.state());
    EXPECT_TRUE(text == before || text == after || (text.starts_with(before) && after.starts_with(text)))
        << where << ":\n"
        << text.substr(unsolved().size());
    if (!hub.state().script.empty()) post_and_wait(hub, gui::RunScript{});
    if (hub.state().present > 0) {
      EXPECT_TRUE(curves_text(*hub.state().motion) == batch_curves(text_to_save(hub.state()))) << where;
    }
    hub.close(true);
  }
  EXPECT_GT(met, 0);
}

}  // namespace
}  // namespace spacetime::test
