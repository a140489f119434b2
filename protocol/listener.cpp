// Where peers are awaited: at a path or a port, with TLS or without.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "common/diagnostic.h"
#include "protocol/socket.h"

// After socket.h, which has what Asio 1.74 forgets.
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>

namespace spacetime::protocol {
namespace {

// A peer that has connected but does not finish the TLS handshake is dropped after so long.
constexpr std::chrono::seconds handshake_patience{10};
// So many may be in their handshakes at one time; others wait in the kernel's queue.
constexpr int most_handshakes = 32;

// While one daemon looks whether a socket is in use, and puts its own there, others wait: of two that find one that a
// killed daemon has left, the second would else take away the first one's.  The lock ends with its process.
class PathLock {
 public:
  explicit PathLock(const std::string& path) : file_(path + ".lock") {
    for (;;) {
      descriptor_ = ::open(file_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0600);
      if (descriptor_ < 0) throw InputError("cannot listen on '" + path + "': '" + file_ + "' cannot be made");
      while (::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR) continue;
      struct stat held {
      }, there{};
      if (::fstat(descriptor_, &held) == 0 && ::lstat(file_.c_str(), &there) == 0 && held.st_ino == there.st_ino)
        return;
      ::close(descriptor_);  // whoever had it has removed it meanwhile
    }
  }
  ~PathLock() {
    ::unlink(file_.c_str());
    ::close(descriptor_);
  }
  PathLock(const PathLock&) = delete;
  PathLock& operator=(const PathLock&) = delete;

 private:
  std::string file_;
  int descriptor_ = -1;
};

class SocketListener final : public Listener {
 public:
  SocketListener(asio::io_context& context, const Address& address, const Credentials& credentials)
      : context_(context), acceptor_(context), again_(context), address_(address) {
    if (address.kind == Address::Kind::tls) tls_ = tls_context(credentials, true);
    if (address.kind == Address::Kind::unix_socket) {
      listen_on_path();
    } else {
      listen_on_port();
    }
  }
  ~SocketListener() override {
    struct stat status {};  // by now another's socket may be there
    if (!owned_path_.empty() && ::lstat(owned_path_.c_str(), &status) == 0 && status.st_ino == owned_inode_) {
      ::unlink(owned_path_.c_str());
    }
  }

  void accept(std::function<void(std::unique_ptr<Stream>)> accepted,
              std::function<void(std::string)> refused) override {
    accepted_ = std::move(accepted);
    refused_ = std::move(refused);
    accept_next();
  }

  std::string address() const override {
    if (address_.kind == Address::Kind::unix_socket) return "unix:" + address_.path;
    const bool six = address_.host.find(':') != std::string::npos;
    return (address_.kind == Address::Kind::tls ? "tls://" : "tcp://") +
           (six ? "[" + address_.host + "]" : address_.host) + ":" + address_.port;
  }

 private:
  void open(const asio::generic::stream_protocol::endpoint& endpoint) {
    boost::system::error_code error;
    acceptor_.open(endpoint.protocol(), error);
    if (!error && endpoint.protocol().family() != AF_UNIX) {
      acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    }
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) throw InputError("cannot listen on " + address() + ": " + error.message());
  }

  void listen_on_path() {
    const std::string& path = address_.path;
    if (path.size() >= sizeof(sockaddr_un::sun_path))
      throw InputError("the path of a UNIX socket is too long: " + path);
    const asio::local::stream_protocol::endpoint endpoint(path);
    const PathLock lock(path);
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0) {
      if (!S_ISSOCK(status.st_mode)) throw InputError("'" + path + "' is there already and is no socket");
      asio::local::stream_protocol::socket probe(context_);
      boost::system::error_code error;
      probe.connect(endpoint, error);
      if (!error) throw InputError("a daemon listens on '" + path + "' already");
      ::unlink(path.c_str());  // left behind by one that was killed
    }
    const mode_t before = ::umask(0177);
    try {
      open(endpoint);
    } catch (...) {
      ::umask(before);
      throw;
    }
    ::umask(before);
    owned_path_ = path;
    if (::lstat(path.c_str(), &status) == 0) owned_inode_ = status.st_ino;
  }

  void listen_on_port() {
    asio::ip::tcp::resolver resolver(context_);
    boost::system::error_code error;
    const auto found = resolver.resolve(address_.host, address_.port, asio::ip::resolver_base::passive, error);
    if (error) throw InputError("cannot find the host '" + address_.host + "': " + error.message());
    const auto endpoint = found.begin()->endpoint();
    if (address_.kind == Address::Kind::tcp && !endpoint.address().is_loopback()) {
      throw InputError(
          "tcp:// is for this machine alone (127.0.0.1, ::1), since anybody could connect: use tls:// for '" +
          address_.host + "'");
    }
    open(endpoint);
    const auto bound = acceptor_.local_endpoint();
    asio::ip::tcp::endpoint chosen;
    std::copy_n(static_cast<const char*>(static_cast<const void*>(bound.data())), bound.size(),
                static_cast<char*>(static_cast<void*>(chosen.data())));
    chosen.resize(bound.size());
    address_.port = std::to_string(chosen.port());
  }

  void accept_next() {
    acceptor_.async_accept([this, alive = std::weak_ptr(alive_)](boost::system::error_code error, Socket socket) {
      if (alive.expired() || error == asio::error::operation_aborted) return;
      if (error) {  // too many open files, or a connection that is gone already
        refused_(error.message());
        again_.expires_after(std::chrono::milliseconds(100));
        again_.async_wait([this, alive](boost::system::error_code stopped) {
          if (!stopped && !alive.expired()) accept_next();
        });
        return;
      }
      boost::system::error_code ignored;  // there is nothing to send at once on a UNIX socket
      socket.set_option(asio::ip::tcp::no_delay(true), ignored);
      if (tls_) {
        shake_hands(std::move(socket));
      } else {
        accepted_(stream_of(std::move(socket)));
      }
      if (handshakes_ < most_handshakes) accept_next();
    });
  }

  void shake_hands(Socket socket) {
    auto secured = std::make_shared<std::unique_ptr<TlsSocket>>(std::make_unique<TlsSocket>(std::move(socket), *tls_));
    const auto patience = std::make_shared<asio::steady_timer>(context_, handshake_patience);
    TlsSocket& tls = **secured;
    patience->async_wait([secured](boost::system::error_code stopped) {
      boost::system::error_code ignored;
      if (!stopped && *secured) (*secured)->lowest_layer().close(ignored);
    });
    ++handshakes_;
    tls.async_handshake(asio::ssl::stream_base::server,
                        [=, this, alive = std::weak_ptr(alive_)](boost::system::error_code error) {
                          patience->cancel();
                          if (alive.expired()) return;
                          if (handshakes_-- == most_handshakes) accept_next();
                          if (error) {
                            refused_("TLS: " + error.message());
                            if (*secured) part(std::move((*secured)->next_layer()));
                          } else {
                            accepted_(stream_of(tls_, std::move(*secured)));
                          }
                        });
  }

  asio::io_context& context_;
  asio::basic_socket_acceptor<asio::generic::stream_protocol> acceptor_;
  asio::steady_timer again_;
  Address address_;
  std::shared_ptr<asio::ssl::context> tls_;
  std::string owned_path_;
  ino_t owned_inode_ = 0;
  int handshakes_ = 0;
  std::shared_ptr<int> alive_ = std::make_shared<int>();  // for what is called back after this is destroyed
  std::function<void(std::unique_ptr<Stream>)> accepted_;
  std::function<void(std::string)> refused_;
};

}  // namespace

std::unique_ptr<Listener> listen(asio::io_context& context, const Address& address, const Credentials& credentials) {
  return std::make_unique<SocketListener>(context, address, credentials);
}

}  // namespace spacetime::protocol
