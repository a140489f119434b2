#include "protocol/client.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "common/diagnostic.h"
#include "protocol/framing.h"
#include "protocol/history.h"
#include "protocol/service.h"
#include "protocol/stream.h"
#include "protocol/strict.h"

// After stream.h, which has what Asio 1.74 forgets.
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>

namespace spacetime::protocol {
namespace {

namespace asio = boost::asio;

// A daemon that has gone is tried again after so long, then twice as long, and so on.
constexpr std::chrono::milliseconds first_pause{20};
constexpr std::chrono::milliseconds longest_pause{2000};
// ... so often in a row without a word of it; then it is lost.
constexpr int most_failures = 12;
// A request at which the daemon has ended so often is not sent again: it may be why.
constexpr int most_tries = 8;

// The exit code of a child in which the program could not be started, as of shells.
constexpr int cannot_start = 127;

constexpr std::size_t longest_answer = std::size_t{1} << 30;
constexpr std::size_t longest_quote = 40;  // bytes of what is no message that are told

// Starts the program with one socket as its standard input and output; the other end, and its process.
std::pair<int, pid_t> spawn(const std::vector<std::string>& program) {
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) throw InputError("no sockets are left");
  std::vector<char*> arguments;
  for (const std::string& argument : program) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    // It must not outlive us, however we end.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(cannot_start);
    dup2(pair[1], STDIN_FILENO);
    dup2(pair[1], STDOUT_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(cannot_start);
  }
  ::close(pair[1]);
  if (child < 0) {
    ::close(pair[0]);
    throw InputError("no process can be started");
  }
  return {pair[0], child};
}

}  // namespace

// Everything but asking happens in its thread.
class Client::Link {
 public:
  Link(Target target, Callbacks callbacks)
      : target_(std::move(target)),
        callbacks_(std::move(callbacks)),
        pause_(context_),
        greeting_(context_),
        thread_([this] { run(); }) {}

  ~Link() {
    asio::post(context_, [this] {
      ending_ = true;
      pause_.cancel();
      greeting_.cancel();
      attempt_.reset();
      if (stream_) stream_->close();
      work_.reset();
    });
    thread_.join();
    bury();
  }

  int ask(std::string_view method, std::string params, Answered answered, Progress progress) {
    const int id = ++last_;
    asio::post(context_, [this, id,
                          asked = Asked{std::string(method), std::move(params), std::move(answered),
                                        std::move(progress), 0}]() mutable {
      Asked& place = asked_[id] = std::move(asked);
      if (state_ == State::lost) return fail(id, "the daemon is lost");
      if (state_ == State::ready) send(id, place);
    });
    return id;
  }

  void cancel(int id) {
    asio::post(context_, [this, id] {
      const auto found = asked_.find(id);
      if (found == asked_.end()) return;
      if (state_ == State::ready) return write(notification("$/cancelRequest", "{\"id\":" + std::to_string(id) + "}"));
      fail(id, "cancelled while the daemon was away");
    });
  }

  int process() const { return process_; }

 private:
  struct Asked {
    std::string method, params;
    Answered answered;
    Progress progress;
    int tries = 0;
  };

  void run() {
    connect();
    context_.run();
  }

  void connect() {
    if (ending_) return;
    enter(State::connecting, "");
    reader_ = FrameReader(longest_answer, Framing::lines);
    outgoing_.clear();
    writing_ = false;
    ++generation_;
    resent_ = -1;
    try {
      if (target_.address) {
        attempt_ = protocol::connect(
            context_, *target_.address, target_.credentials,
            [this](std::unique_ptr<Stream> stream, boost::system::error_code error, const std::string& why) {
              attempt_.reset();
              stream ? begin(std::move(stream)) : retry_after(error, why);
            });
      } else {
        const auto [socket, child] = spawn(target_.program);
        process_ = child;
        begin(socket_stream(context_, socket));
      }
    } catch (const InputError& error) {  // certificates that cannot be read; or too many processes
      return target_.address ? lose(error.what()) : retry(error.what());
    }
    greeting_.expires_after(target_.patience);
    greeting_.async_wait([this, generation = generation_](boost::system::error_code stopped) {
      if (stopped || generation != generation_ || resent_ >= 0 || !(attempt_ || stream_)) return;
      retry("the daemon has not answered within " + std::to_string(target_.patience.count()) + " ms");
    });
  }

  void begin(std::unique_ptr<Stream> stream) {
    stream_ = std::move(stream);
    read();
    resend();
  }

  // Brings the daemon to where it was: greets it, then sends the history, one message after another's answer, and last
  // what is not answered yet.
  void resend() {
    if (resent_ < 0) {
      write(request("0", "initialize", "{\"protocol\":" + std::to_string(protocol_version) + "}"));
    } else if (resent_ < static_cast<int>(history_.messages().size())) {
      const auto& message = history_.messages()[static_cast<std::size_t>(resent_)];
      write(request("0", message.method, message.params));
    } else {
      pause_length_ = first_pause;
      enter(State::ready, "");
      for (auto& [id, asked] : asked_) send(id, asked);
    }
  }

  void send(int id, Asked& asked) {
    ++asked.tries;
    write(request(std::to_string(id), asked.method, asked.params));
  }

  void retry_after(boost::system::error_code error, const std::string& why) {
    is_of_certificates(error) ? lose(why) : retry(why);
  }

  void retry(std::string why) {
    hang_up();
    if (const int status = bury(); WIFEXITED(status) && WEXITSTATUS(status) == cannot_start) {
      why = "'" + target_.program.front() + "' cannot be started";
      failures_ = most_failures;  // and never will
    }
    if (ending_) return;
    std::vector<int> hopeless;
    for (const auto& [id, asked] : asked_) {
      if (asked.tries >= most_tries) hopeless.push_back(id);
    }
    for (const int id : hopeless) fail(id, "the daemon has ended each time it was asked this");
    if (++failures_ > most_failures) return lose(why);
    enter(State::connecting, why);
    pause_.expires_after(pause_length_);
    pause_length_ = std::min(longest_pause, 2 * pause_length_);
    pause_.async_wait([this](boost::system::error_code stopped) {
      if (!stopped) connect();
    });
  }

  void hang_up() {
    greeting_.cancel();
    attempt_.reset();
    stream_.reset();
  }

  // For good.
  void lose(const std::string& why) {
    hang_up();
    bury();
    enter(State::lost, why);
    while (!asked_.empty()) fail(asked_.begin()->first, "the daemon is lost: " + why);
  }

  // Ends and reaps the daemon's process, if there is one; how it ended.
  int bury() {
    const pid_t child = process_.exchange(0);
    if (child == 0) return 0;
    ::kill(child, SIGKILL);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return status;
  }

  void fail(int id, const std::string& why) {
    const auto found = asked_.find(id);
    const Answered answered = std::move(found->second.answered);
    asked_.erase(found);
    Reply reply;
    reply.error = Json{{"code", static_cast<int>(Code::internal)}, {"message", why}};
    if (answered) answered(reply);
  }

  void enter(State state, const std::string& why) {
    if (state == state_ && why.empty()) return;
    state_ = state;
    if (callbacks_.state) callbacks_.state(state, why);
  }

  void read() {
    stream_->read_some(block_, [this, generation = generation_](boost::system::error_code error, std::size_t bytes) {
      if (generation != generation_ || !stream_) return;
      if (error) return retry_after(error, "the daemon has ended the connection: " + error.message());
      reader_.add({block_.data(), bytes});
      while (auto frame = reader_.next()) {
        take(*frame);
        if (!stream_) return;
      }
      read();
    });
  }

  void write(std::string message) {
    outgoing_.push_back(framed(std::move(message), Framing::lines));
    if (!writing_) write_next();
  }

  void write_next() {
    if (outgoing_.empty()) return;
    writing_ = true;
    stream_->write_all(outgoing_.front(),
                       [this, generation = generation_](boost::system::error_code error, std::size_t) {
                         if (generation != generation_ || error) return;  // the reader sees the end, too
                         writing_ = false;
                         outgoing_.pop_front();
                         write_next();
                       });
  }

  void take(const Frame& frame) {
    const Json none;
    Json message = frame.kind == Frame::Kind::message ? Json::parse(frame.text, nullptr, false) : none;
    if (!message.is_object()) {  // from something else that writes where it does, perhaps; the next may do without
      const bool told = frame.kind != Frame::Kind::message;
      return retry("the daemon says what is no message: " + (told ? frame.text : frame.text.substr(0, longest_quote)));
    }
    std::function<void()> follows;
    try {
      follows = what_follows(message);
    } catch (const DocumentError& error) {
      return lose(std::string("what the daemon says is not as the protocol says: ") + error.what());
    }
    if (follows) follows();  // others' mistakes are not the daemon's
  }

  // What is to be done about a message; nothing where nobody waits for it.  It may refer to the message.  Throws
  // DocumentError where a daemon must not say so.
  std::function<void()> what_follows(Json& message) {
    const Node unnamed(message, "message");
    if (unnamed.find("method")) return progress_in(unnamed);
    const auto number = unnamed.find("id");
    if (!number || !number->json().is_number_integer()) return {};
    const int id = number->integer();
    if (id == 0) return state_ == State::ready ? std::function<void()>() : resent_answer(unnamed);
    const auto found = asked_.find(id);
    if (found == asked_.end()) return {};
    const std::string name = "answer to " + found->second.method;
    const Node answer(message, name);
    Reply reply;
    if (const auto error = error_in(answer)) {
      reply.error = error->json();
    } else {
      history_.note(found->second.method, found->second.params, answer["result"]);
      reply.result = std::move(message["result"]);
    }
    const Asked asked = std::move(found->second);
    asked_.erase(found);
    if (!asked.answered) return {};
    return [answered = asked.answered, reply = std::move(reply)] { answered(reply); };
  }

  // An answer is an object either way.
  static std::optional<Node> error_in(const Node& answer) {
    const auto error = answer.find("error");
    if (!error) {
      if (!answer["result"].is_object()) answer["result"].expected("an object");
      return std::nullopt;
    }
    if (!(*error)["code"].json().is_number_integer()) (*error)["code"].expected("an integer");
    (*error)["message"].string();
    return error;
  }

  // To the greeting, or to what led the last daemon to where it was.
  std::function<void()> resent_answer(const Node& answer) {
    if (const auto error = error_in(answer)) {
      return [this, code = (*error)["code"].json().get<int>(), why = (*error)["message"].string()] {
        take_refusal(code, why);
      };
    }
    return [this] {
      greeting_.cancel();
      failures_ = 0;
      ++resent_;
      resend();
    };
  }

  // A daemon that serves others may have room later; one that speaks another language never will, nor will one that
  // refuses what another has done before it stand where that one stood.
  void take_refusal(int code, const std::string& why) {
    if (resent_ >= 0) {
      return lose("a new daemon cannot be brought to where the last one was: " +
                  history_.messages()[static_cast<std::size_t>(resent_)].method + ": " + why);
    }
    code == static_cast<int>(Code::too_many_sessions) ? retry(why) : lose(why);
  }

  std::function<void()> progress_in(const Node& message) {
    if (message["method"].string() != "$/progress") return {};
    const Json &token = message["params"]["token"].json(), &value = message["params"]["value"].json();
    if (!token.is_number_integer()) return {};
    const auto found = asked_.find(token.get<int>());
    if (found == asked_.end() || !found->second.progress) return {};
    return [tell = found->second.progress, &value] { tell(value); };
  }

  const Target target_;
  const Callbacks callbacks_;
  std::atomic<int> last_ = 0;
  std::atomic<int> process_ = 0;
  asio::io_context context_{1};
  asio::executor_work_guard<asio::io_context::executor_type> work_ = asio::make_work_guard(context_);
  asio::steady_timer pause_;     // before the next attempt
  asio::steady_timer greeting_;  // ... which ends when this has passed without an answer
  std::shared_ptr<void> attempt_;
  std::unique_ptr<Stream> stream_;
  std::array<char, 1 << 16> block_{};
  FrameReader reader_{longest_answer, Framing::lines};
  std::deque<std::string> outgoing_;
  bool writing_ = false, ending_ = false;
  int generation_ = 0;  // of streams: what an older one calls back with is stale
  int resent_ = 0, failures_ = 0;
  std::chrono::milliseconds pause_length_ = first_pause;
  State state_ = State::lost;
  std::map<int, Asked> asked_;
  History history_;
  std::thread thread_;
};

Client::Client(Target target, Callbacks callbacks)
    : link_(std::make_unique<Link>(std::move(target), std::move(callbacks))) {}

Client::~Client() = default;

int Client::ask(std::string_view method, std::string params, Answered answered, Progress progress) {
  return link_->ask(method, std::move(params), std::move(answered), std::move(progress));
}

void Client::cancel(int id) { link_->cancel(id); }

int Client::process() const { return link_->process(); }

}  // namespace spacetime::protocol
