// The client library: daemons that it starts, asks, loses and brings back.
#include "protocol/client.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <future>
#include <random>
#include <thread>

#include "common/assert.h"

namespace spacetime::protocol {
namespace {

const std::string bin = SPACETIME_BIN_DIR;
constexpr std::chrono::seconds patience{60};

Target started(const std::string& name) { return {{bin + "/spacetime-" + name, "serve"}, {}, {}}; }

// Asks and waits: for tests alone.
Reply answer(Client& client, std::string_view method, const Json& params, Client::Progress progress = {}) {
  const auto promise = std::make_shared<std::promise<Reply>>();
  auto future = promise->get_future();
  client.ask(
      method, params.dump(), [promise](const Reply& reply) { promise->set_value(reply); }, std::move(progress));
  SPACETIME_ASSERT(future.wait_for(patience) == std::future_status::ready);
  return future.get();
}

Json result(Client& client, std::string_view method, const Json& params = Json::object()) {
  const Reply reply = answer(client, method, params);
  EXPECT_TRUE(reply.error.is_null()) << method << ": " << reply.error.dump();
  return reply.result;
}

const std::string scene = R"(time [0, 2]
trajectory bspline spans 48
constant top = 0.9
creature arm {
  gravity (0, -9.81, 0)
  link rod { revolute swing; offset -pi/2; a 1; mass 1; rod }
  point tip on rod (0, 0, 0)
}
constrain start: (arm.swing, arm.swing') = 0  at 0
constrain top_:  arm.tip.y = top      at 2
constrain still: arm.swing' = 0       at 2
minimize effort: integral(arm.swing.force^2)
keyframe 0: arm.swing = 0
keyframe 2: arm.swing = 2
)";

Json problem() {
  static const Json it = [] {
    Client compiler(started("symbolic"), {});
    return result(compiler, "scene/compile", {{"text", scene}}).at("problem");
  }();
  return it;
}

// A session of some solves and edits; the motion it ends with, without its times.
Json motion_of_a_session(Client& client) {
  const auto act = [&](const Json& action) { return result(client, "action/do", {{"action", action}}); };
  result(client, "problem/load", {{"problem", problem()}});
  act({{"action", "solve"}});
  for (const double top : {0.5, 0.7, 0.2}) {
    act({{"action", "set"}, {"constant", "top"}, {"value", top}});
    act({{"action", "solve"}});
    result(client, "motion/get", {{"checkpoint", true}});
    act({{"action", "weight"}, {"name", "effort"}, {"weight", 1 + top}});
    act({{"action", "iterate"}, {"iterations", 7}});
    act({{"action", "solve"}});
  }
  Json motion = result(client, "motion/get");
  if (motion.contains("motion")) motion["motion"].erase("seconds");
  return motion;
}

TEST(Client, AsksAndIsAnswered) {
  Client client(started("optimizer"), {});
  EXPECT_EQ(answer(client, "motion/get", Json::object()).error["code"], static_cast<int>(Code::no_problem));
  result(client, "problem/load", {{"problem", problem()}});
  std::atomic<int> iterates = 0;
  const Json action{{"action", "solve"}};
  const Reply outcome = answer(client, "action/do", {{"action", action}}, [&](const Json& value) {
    EXPECT_EQ(value["kind"], "iteration");
    ++iterates;
  });
  EXPECT_EQ(outcome.result["status"], "converged");
  EXPECT_GT(iterates, 0);
}

TEST(Client, GivesUpOnAProgramThatIsNotThere) {
  Client client({{"/nowhere/spacetime-optimizer"}, {}, {}}, {});
  const Reply reply = answer(client, "motion/get", Json::object());
  EXPECT_EQ(reply.error["code"], static_cast<int>(Code::internal));
}

TEST(Client, EndsItsDaemon) {
  int process = 0;
  {
    Client client(started("symbolic"), {});
    result(client, "expression/query", {{"scene", "time [0, 1]"}, {"text", "1"}});
    process = client.process();
    EXPECT_EQ(kill(process, 0), 0);
  }
  EXPECT_NE(kill(process, 0), 0);
}

// SPACETIME_KILLS sets how many (12 unless said; the long test asks for 200).
TEST(Client, EndsWithTheSameMotionHoweverOftenItsDaemonIsKilled) {
  const char* asked = std::getenv("SPACETIME_KILLS");
  const int kills = asked ? std::atoi(asked) : 12;
  Client undisturbed(started("optimizer"), {});
  const auto begun = std::chrono::steady_clock::now();
  const Json expected = motion_of_a_session(undisturbed);
  const std::chrono::duration<double> session = std::chrono::steady_clock::now() - begun;
  EXPECT_EQ(expected["motion"]["status"], "converged");

  Client client(started("optimizer"), {});
  std::atomic<int> killed = 0;
  const std::jthread killer([&](const std::stop_token& over) {
    std::mt19937 random(94);                              // moments differ from run to run all the same
    std::uniform_real_distribution<double> moment(0, 4);  // sessions: some are cut short, some are not
    while (!over.stop_requested() && killed < kills) {
      std::this_thread::sleep_for(moment(random) * session);
      const int process = client.process();
      if (process != 0 && kill(process, SIGKILL) == 0) ++killed;
    }
  });
  while (killed < kills && !HasFailure()) EXPECT_EQ(motion_of_a_session(client), expected);
  EXPECT_EQ(motion_of_a_session(client), expected);
}

}  // namespace
}  // namespace spacetime::protocol
