// A connection's two threads: who sleeps while the peer reads slowly is woken, and progress costs the other nothing.
#include "protocol/connection.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "protocol/backlog.h"

namespace spacetime::protocol {
namespace {

constexpr std::chrono::seconds patience{10};

// Looks again and again, and now and then lets others have the processor; false where it was in vain for too long.
bool comes(const auto& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (int looks = 1; !condition(); ++looks) {
    if (looks % 200 != 0) continue;
    std::this_thread::yield();
    if (std::chrono::steady_clock::now() > end) return condition();
  }
  return true;
}

TEST(Backlog, WakesWhoWaitsBecauseItIsFull) {
  constexpr std::size_t most = 3;
  constexpr int rounds = 200'000;
  Backlog backlog(most);
  std::atomic<int> added = 0, wakes = 0;
  const std::jthread peer([&] {
    for (int k = 0; k < rounds; ++k) {
      if (!comes([&] { return added > k; })) return;
      if (backlog.take_off(1)) ++wakes;
    }
  });
  int seen = 0;
  for (int k = 0; k < rounds; ++k) {
    backlog.add(1);
    ++added;
    while (backlog.full()) {
      ASSERT_TRUE(comes([&] { return wakes != seen; })) << "after " << k;
      seen = wakes;
    }
  }
}

// Takes what is written and says that it is done when it is told to.
class Slow final : public Stream {
 public:
  struct Written {
    std::string text;
    Done done;
  };
  explicit Slow(std::vector<Written>& written) : written_(written) {}
  void read_some(std::span<char>, Done) override {}
  void write_all(std::string_view bytes, Done done) override {
    written_.push_back({std::string(bytes), std::move(done)});
  }
  void close() override {}
  void part() override {}

 private:
  std::vector<Written>& written_;
};

TEST(Connection, WakesItsThreadForProgressWhereNoneWaitsYetAndSendsTheNewest) {
  boost::asio::io_context context;
  const Allowance allowance;
  std::vector<Slow::Written> written;
  const auto connection =
      std::make_shared<Connection>(context, std::make_unique<Slow>(written), nullptr, allowance, Events{});
  const auto offer = [&](const std::string& text) { connection->offer([text] { return text; }); };
  const auto handled = [&] {
    context.restart();
    return context.poll();
  };
  const auto finish = [&] { std::exchange(written.back().done, {})({}, written.back().text.size()); };

  offer("1");
  offer("2");
  EXPECT_EQ(handled(), 1u);
  ASSERT_EQ(written.size(), 1u);
  EXPECT_EQ(written[0].text, "2\n");

  offer("3");  // while that is being written
  EXPECT_EQ(handled(), 1u);
  offer("4");
  EXPECT_EQ(handled(), 0u);
  finish();
  while (written.size() < 2) {  // it is not due yet
    context.restart();
    context.run_one_for(patience);
  }
  EXPECT_EQ(written[1].text, "4\n");

  offer("5");  // goes out before what is sent after it
  connection->send("answer");
  offer("6");
  connection->ended();
  for (int k = 0; k < 3; ++k) {
    finish();
    handled();
  }
  ASSERT_EQ(written.size(), 5u);
  EXPECT_EQ(written[2].text, "5\n");
  EXPECT_EQ(written[3].text, "answer\n");
  EXPECT_EQ(written[4].text, "6\n");
  finish();
}

}  // namespace
}  // namespace spacetime::protocol
