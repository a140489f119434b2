// What tests of the client share: asking and waiting, and the course of its states.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "common/assert.h"
#include "protocol/client.h"

namespace spacetime::protocol {

inline constexpr std::chrono::seconds patience{60};

// Asks and waits: for tests alone.
inline Reply answer(Client& client, std::string_view method, const Json& params, Client::Progress progress = {}) {
  const auto promise = std::make_shared<std::promise<Reply>>();
  auto future = promise->get_future();
  client.ask(
      method, params.dump(), [promise](const Reply& reply) { promise->set_value(reply); }, std::move(progress));
  SPACETIME_ASSERT(future.wait_for(patience) == std::future_status::ready);
  return future.get();
}

inline Json result(Client& client, std::string_view method, const Json& params = Json::object()) {
  const Reply reply = answer(client, method, params);
  EXPECT_TRUE(reply.error.is_null()) << method << ": " << reply.error.dump();
  return reply.result;
}

// Every state that a client has been in, with its sentences.
struct Course {
  struct Seen {
    Client::State state;
    std::string why;
  };
  std::mutex mutex;
  std::condition_variable more;
  std::vector<Seen> seen;

  Client::Callbacks callbacks() {
    return {[this](Client::State state, const std::string& why) {
      const std::lock_guard lock(mutex);
      seen.push_back({state, why});
      more.notify_all();
    }};
  }
  // Waits for a state with a sentence that has these words; false where another with a sentence came first.
  bool next_is(Client::State state, const std::string& words) {
    std::unique_lock lock(mutex);
    const auto told = [](const Seen& one) { return !one.why.empty(); };
    const bool came = more.wait_for(lock, patience, [&] { return std::ranges::any_of(seen, told); });
    if (!came) return false;
    const auto found = std::ranges::find_if(seen, told);
    const bool right = found->state == state && found->why.find(words) != std::string::npos;
    if (!right) ADD_FAILURE() << "state " << static_cast<int>(found->state) << ": " << found->why;
    seen.erase(seen.begin(), found + 1);
    return right;
  }
};

}  // namespace spacetime::protocol
