// One peer's bytes: read, cut into messages and handed to its conversation; answers framed and written as fast as the
// peer takes them.
#pragma once

#include <utility>  // before Asio 1.74

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/backlog.h"
#include "protocol/conversation.h"
#include "protocol/stream.h"

namespace spacetime::protocol {

// What a connection tells its server.  Called in the io_context's thread.
struct Events {
  std::function<void(std::string_view message, bool from_peer)> passed;  // each message, as text
  std::function<void()> gone;                                            // nothing is left: it can be destroyed
};

class Connection final : public Outlet, public std::enable_shared_from_this<Connection> {
 public:
  // Serves the peer, or, where `service` is null, only tells it why there is no session for it.
  Connection(boost::asio::io_context& context, std::unique_ptr<Stream> stream, const Service* service,
             const Allowance& allowance, Events events);

  void start();
  void finish();  // work ends; what has been answered is still written
  void cut();     // at once

  // Outlet: any thread.
  void send(std::string message) override;
  void offer(std::function<std::string()> message) override;
  bool full() const override;
  void ended() override;

 private:
  using Clock = std::chrono::steady_clock;
  using Message = std::function<std::string()>;

  void read();
  void take(std::string_view bytes);
  void pass(Frame frame);
  bool too_much_waits() const;
  void refuse(const Frame& frame);
  void forget();
  void wake();
  void write();
  void written(boost::system::error_code error);
  void watch();
  std::optional<Error> too_quiet(Clock::time_point now) const;

  boost::asio::io_context& context_;
  std::unique_ptr<Stream> stream_;
  const Allowance& allowance_;
  Events events_;
  FrameReader reader_;
  boost::asio::steady_timer resume_, pace_, watch_;
  std::array<char, 1 << 16> block_{};
  std::string outgoing_;
  Clock::time_point last_message_, last_byte_, last_progress_, last_written_;
  bool writing_ = false, broken_ = false, gone_ = false, reading_ends_ = false;

  mutable std::mutex mutex_;  // of what follows
  struct Outgoing {
    Message write;
    std::size_t bytes = 0;  // counted in unsent_
  };
  std::deque<Outgoing> queue_;
  Message newest_;
  bool wake_coming_ = false, ended_ = false;
  Backlog unsent_;  // needs no lock

  std::optional<Conversation> conversation_;  // destroyed first: its thread uses the rest
};

}  // namespace spacetime::protocol
