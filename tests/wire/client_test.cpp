// The client library: daemons that it starts, asks, loses and brings back.

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "common/assert.h"
#include "tests/wire/clients.h"

namespace spacetime::protocol {
namespace {

const std::string bin = SPACETIME_BIN_DIR;

Target started(const std::string& name) { return {{bin + "/spacetime-" + name, "serve"}, {}, {}}; }

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
    Json without_sketch = problem();
    without_sketch["keyframes"] = Json::array();
    result(client, "problem/update", {{"problem", top == 0.7 ? without_sketch : problem()}});
    result(client, "motion/get", {{"checkpoint", true}});
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
  int told = 0;
  const Json action{{"action", "solve"}};
  const Reply outcome = answer(client, "action/do", {{"action", action}}, [&](const Json& value) {
    EXPECT_EQ(value["kind"], "iteration");
    for (const Json& one : value["record"]) EXPECT_EQ(one["iteration"], ++told);
    EXPECT_EQ(value["record"].back()["iteration"], value["iteration"]);
    EXPECT_EQ(value["record"].back()["terms"]["effort"], value["objective"]);
    ++iterates;
  });
  EXPECT_EQ(outcome.result["status"], "converged");
  EXPECT_GT(iterates, 0);
  EXPECT_FALSE(result(client, "motion/get").at("motion").contains("multipliers"));
  const Json multipliers = result(client, "motion/get", {{"multipliers", true}}).at("motion").at("multipliers");
  EXPECT_EQ(multipliers.back().at("name"), "still");
  EXPECT_EQ(multipliers.back().at("times"), Json::array({2}));
  EXPECT_EQ(multipliers.back().at("values").size(), 1U);
}

// A port of the loopback on which connections are taken and nobody answers.
class Mute {
 public:
  Mute() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    auto* const general = static_cast<sockaddr*>(static_cast<void*>(&place));
    SPACETIME_ASSERT(::bind(socket_, general, size) == 0 && ::listen(socket_, 8) == 0);
    SPACETIME_ASSERT(::getsockname(socket_, general, &size) == 0);
    port_ = std::to_string(ntohs(place.sin_port));
  }
  ~Mute() { ::close(socket_); }
  const std::string& port() const { return port_; }

 private:
  int socket_;
  std::string port_;
};

void run(const std::string& command) {
  SPACETIME_ASSERT(std::system(("(" + command + ") > /dev/null 2>&1").c_str()) == 0);
}

// An authority with what it has signed, for a daemon by this name.
std::string certificates_for(const std::string& name, const std::string& folder) {
  const auto directory = std::filesystem::path(testing::TempDir()) / (folder + std::to_string(getpid()));
  run(SPACETIME_SOURCE_DIR "/protocol/certificates.sh '" + directory.string() + "' " + name);
  return directory.string();
}

// The same authority signs a daemon's certificate that was good until yesterday.
void expire(const std::string& keys) {
  run("cd '" + keys +
      "' && openssl req -new -key daemon-key.pem -subj /CN=daemon -out expired.csr && openssl x509 -req -in "
      "expired.csr "
      "-CA authority.pem -CAkey authority-key.pem -days -1 -out daemon.pem");
}

// A daemon that listens with TLS on a port that it has chosen.
class Listening {
 public:
  explicit Listening(const std::string& keys) : log_(keys + "/log") {
    process_ = fork();
    if (process_ == 0) {
      SPACETIME_ASSERT(std::freopen(log_.c_str(), "w", stderr));
      execl((bin + "/spacetime-symbolic").c_str(), "spacetime-symbolic", "serve", "--listen", "tls://127.0.0.1:0",
            "--certificate", (keys + "/daemon.pem").c_str(), "--key", (keys + "/daemon-key.pem").c_str(), "--authority",
            (keys + "/authority.pem").c_str(), nullptr);
      _exit(127);
    }
    const auto end = std::chrono::steady_clock::now() + patience;
    const std::string mark = "listening on tls://127.0.0.1:";
    std::string line;
    while (std::chrono::steady_clock::now() < end && port_.empty()) {
      std::ifstream log(log_);
      while (std::getline(log, line) && !log.eof()) {
        if (const auto at = line.find(mark); at != line.npos) port_ = line.substr(at + mark.size());
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    SPACETIME_ASSERT(!port_.empty());
  }
  ~Listening() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  const std::string& port() const { return port_; }

 private:
  std::string log_, port_;
  pid_t process_ = 0;
};

Target secured(const std::string& port, const std::string& keys, const std::string& authority) {
  return {{},
          Address{Address::Kind::tls, {}, "127.0.0.1", port},
          {keys + "/client.pem", keys + "/client-key.pem", authority + "/authority.pem"}};
}

TEST(Client, GivesUpAHostThatTakesConnectionsAndNeverAnswers) {
  const std::string keys = certificates_for("127.0.0.1", "mute");
  const Mute mute;
  Target plain{{}, Address{Address::Kind::tcp, {}, "127.0.0.1", mute.port()}, {}, std::chrono::milliseconds(50)};
  Target tls = secured(mute.port(), keys, keys);
  tls.patience = plain.patience;
  const Target program{{"/bin/sleep", "1000"}, {}, {}, plain.patience};
  for (const Target& target : {plain, tls, program}) {
    Course course;
    const Client client(target, course.callbacks());
    for (int attempt = 0; attempt < 3; ++attempt) {  // it goes on trying
      ASSERT_TRUE(course.next_is(Client::State::connecting, "has not answered within 50 ms"));
    }
  }
}

TEST(Client, CanEndWhileItConnects) {
  const std::string keys = certificates_for("127.0.0.1", "ends");
  const Mute mute;
  for (int k = 0; k < 20; ++k) const Client client(secured(mute.port(), keys, keys), {});
}

TEST(Client, TalksWithTheDaemonThatItsAuthorityKnowsAlone) {
  const std::string keys = certificates_for("127.0.0.1", "keys"), others = certificates_for("127.0.0.1", "others");
  const Listening daemon(keys);
  {
    Client client(secured(daemon.port(), keys, keys), {});
    result(client, "expression/query", {{"scene", "time [0, 1]"}, {"text", "1"}});
  }
  Course course;
  const Client deceived(secured(daemon.port(), keys, others), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::lost, "certificate verify failed"));
  // Its own certificate is signed by an authority that the daemon does not know.
  const Client stranger(secured(daemon.port(), others, keys), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::lost, "unknown ca"));
}

TEST(Client, IsLostAtOnceToADaemonOfAnotherName) {
  const std::string keys = certificates_for("elsewhere.example", "named");
  const Listening daemon(keys);
  Course course;
  const Client client(secured(daemon.port(), keys, keys), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::lost, "certificate verify failed"));
}

TEST(Client, IsLostAtOnceWhereACertificateHasExpiredOrCannotBeRead) {
  const std::string keys = certificates_for("127.0.0.1", "old");
  expire(keys);
  const Listening daemon(keys);
  Course course;
  Client client(secured(daemon.port(), keys, keys), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::lost, "certificate has expired"));
  EXPECT_EQ(answer(client, "expression/query", Json::object()).error["code"], static_cast<int>(Code::internal));
  const Client without(secured(daemon.port(), "/nowhere", keys), course.callbacks());
  EXPECT_TRUE(course.next_is(Client::State::lost, "cannot use --certificate '/nowhere/client.pem'"));
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
