#include "protocol/server.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <fstream>
#include <map>
#include <system_error>

#include "common/diagnostic.h"
#include "protocol/connection.h"

namespace spacetime::protocol {
namespace {

namespace asio = boost::asio;

// After a signal, peers have so long to take their last answers.
constexpr std::chrono::seconds farewell{2};
// Peers beyond the limit of sessions who are being told so; more are dropped without a word.
constexpr std::size_t most_refusals = 64;

std::shared_ptr<spdlog::logger> logger_of(const Service& service, bool verbose) {
  auto logger = std::make_shared<spdlog::logger>(std::string(service.name),
                                                 std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
  logger->set_level(verbose ? spdlog::level::debug : spdlog::level::info);
  return logger;
}

// All messages, one a line: {"seconds": ..., "session": 1, "from": "peer", "message": {...}}.  What is no JSON stands
// under "text" as a string.
class Recorder {
 public:
  // Throws InputError where nothing can be written there: on a full disk that shows with the first byte only.
  explicit Recorder(const std::string& file) : file_(file), out_(file, std::ios::binary | std::ios::trunc) {
    out_ << '\n' << std::flush;
    if (out_) {
      out_.close();
      out_.open(file, std::ios::binary | std::ios::trunc);
    }
    if (!out_) throw InputError("cannot write the record '" + file + "'");
  }
  // False once, where the record ends here because it cannot be written any further.
  bool note(int session, std::string_view message, bool from_peer) {
    Writer to(false);
    to.object([&] {
      to.member("seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count());
      to.member("session", session);
      to.member("from", from_peer ? "peer" : "daemon");
      if (from_peer && (!Json::accept(message) || message.find('\n') != message.npos)) {
        to.key("text");
        to.json(Json(message).dump(-1, ' ', false, Json::error_handler_t::replace));
      } else {
        to.key("message");
        to.json(message);
      }
    });
    const bool was_whole = static_cast<bool>(out_);
    if (was_whole) out_ << to.take() << '\n' << std::flush;
    return out_ || !was_whole;
  }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::ofstream out_;
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

class Server {
 public:
  Server(const Service& service, const ServerOptions& options)
      : service_(service),
        options_(options),
        log_(logger_of(service, options.verbose)),
        signals_(context_, SIGINT, SIGTERM),
        farewell_(context_) {
    if (!options.record.empty()) recorder_.emplace(options.record);
  }

  void run() {
    std::signal(SIGPIPE, SIG_IGN);
    signals_.async_wait([this](boost::system::error_code stopped, int) {
      if (!stopped) end();
    });
    if (options_.listen.empty()) {
      admit(own_stream());
    } else {
      listener_ = listen(context_, parse_address(options_.listen), options_.credentials);
      log_->info("listening on {}", listener_->address());
      listener_->accept([this](std::unique_ptr<Stream> stream) { admit(std::move(stream)); },
                        [this](const std::string& why) { log_->warn("a peer was refused: {}", why); });
    }
    context_.run();
  }

 private:
  std::unique_ptr<Stream> own_stream() {
    try {
      return standard_stream(context_, [this] { context_.stop(); });
    } catch (const std::system_error& error) {
      throw InputError(std::string("the session cannot begin: ") + error.what());
    }
  }

  void admit(std::unique_ptr<Stream> stream) {
    const bool room = static_cast<double>(sessions_) < options_.allowance.sessions;
    if (!room && peers_.size() - sessions_ >= most_refusals) return;
    const int number = ++last_;
    Events events;
    if (recorder_) {
      events.passed = [this, number](std::string_view message, bool from_peer) {
        if (recorder_->note(number, message, from_peer)) return;
        log_->error("the record '{}' cannot be written any further: what follows is not in it", recorder_->file());
      };
    }
    events.gone = [this, number, room] {
      log_->debug("session {} has ended", number);
      if (options_.listen.empty()) return;  // its last answers may still be on their way to standard output
      peers_.erase(number);
      sessions_ -= room ? 1 : 0;
      if (!listener_ && peers_.empty()) context_.stop();
    };
    log_->debug("session {} {}", number, room ? "begins" : "is one too many");
    sessions_ += room ? 1 : 0;
    try {
      const auto peer = std::make_shared<Connection>(context_, std::move(stream), room ? &service_ : nullptr,
                                                     options_.allowance, std::move(events));
      peers_.emplace(number, peer);
      peer->start();
    } catch (const std::system_error& error) {  // no more threads
      if (!listener_) throw InputError(std::string("the session cannot begin: ") + error.what());
      log_->warn("session {} cannot begin: {}", number, error.what());
      sessions_ -= room ? 1 : 0;
    }
  }

  // No new peers; those that are there get the answers that are ready.
  void end() {
    log_->debug("ending on a signal");
    listener_.reset();
    for (const auto& [number, peer] : peers_) peer->finish();
    if (peers_.empty()) return context_.stop();
    farewell_.expires_after(farewell);
    farewell_.async_wait([this](boost::system::error_code stopped) {
      if (stopped) return;
      for (const auto& [number, peer] : peers_) peer->cut();
    });
    signals_.async_wait([](boost::system::error_code stopped, int signal) {
      if (!stopped) _exit(128 + signal);
    });
  }

  const Service& service_;
  const ServerOptions& options_;
  std::shared_ptr<spdlog::logger> log_;
  std::optional<Recorder> recorder_;
  asio::io_context context_{1};
  asio::signal_set signals_;
  asio::steady_timer farewell_;
  std::unique_ptr<Listener> listener_;
  std::map<int, std::shared_ptr<Connection>> peers_;
  std::size_t sessions_ = 0;  // of the peers, those that have one
  int last_ = 0;
};

}  // namespace

void serve(const Service& service, const ServerOptions& options) { Server(service, options).run(); }

}  // namespace spacetime::protocol
