#include "protocol/stream.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <cerrno>

#include "common/diagnostic.h"

namespace spacetime::protocol {
namespace {

namespace asio = boost::asio;
using Socket = asio::generic::stream_protocol::socket;
using TlsSocket = asio::ssl::stream<Socket>;

// A peer that has connected but does not finish the TLS handshake is dropped after so long.
constexpr std::chrono::seconds handshake_patience{10};
// A socket that is closed while its peer goes on sending would take back what it has written last (TCP resets the
// connection), so it reads on for so long.
constexpr std::chrono::milliseconds parting{500};

// So many may be in their handshakes at one time; others wait in the kernel's queue.
constexpr int most_handshakes = 32;

template <class Lowest, class Done>
void write_to(Lowest& socket, std::string_view bytes, Done done) {
  asio::async_write(socket, asio::buffer(bytes.data(), bytes.size()), std::move(done));
}

void close_now(Socket& socket) {
  boost::system::error_code ignored;
  socket.shutdown(Socket::shutdown_both, ignored);
  socket.close(ignored);
}

// A socket that has said everything and listens, without interest, until its peer has ended or time is up.
class Parting : public std::enable_shared_from_this<Parting> {
 public:
  explicit Parting(Socket socket) : socket_(std::move(socket)), timer_(socket_.get_executor(), parting) {}
  void begin() {
    boost::system::error_code ignored;
    socket_.shutdown(Socket::shutdown_send, ignored);
    timer_.async_wait([self = shared_from_this()](boost::system::error_code) { close_now(self->socket_); });
    listen_on();
  }

 private:
  void listen_on() {
    socket_.async_read_some(asio::buffer(block_),
                            [self = shared_from_this()](boost::system::error_code error, std::size_t) {
                              if (error) {
                                self->timer_.cancel();
                              } else {
                                self->listen_on();
                              }
                            });
  }

  Socket socket_;
  asio::steady_timer timer_;
  std::array<char, 4096> block_{};
};

// `done`, keeping alive meanwhile what the operation works on: a stream that is let go of in the midst of one closes
// its socket, but the operation looks at it once more before it is over.
template <class Working>
auto keeping(std::shared_ptr<Working> working, Stream::Done done) {
  return [working = std::move(working), done = std::move(done)](boost::system::error_code error, std::size_t bytes) {
    done(error, bytes);
  };
}

class SocketStream final : public Stream {
 public:
  explicit SocketStream(Socket socket) : socket_(std::make_shared<Socket>(std::move(socket))) {}
  ~SocketStream() override {
    boost::system::error_code ignored;
    socket_->close(ignored);
  }
  void read_some(std::span<char> into, Done done) override {
    socket_->async_read_some(asio::buffer(into.data(), into.size()), keeping(socket_, std::move(done)));
  }
  void write_all(std::string_view bytes, Done done) override {
    write_to(*socket_, bytes, keeping(socket_, std::move(done)));
  }
  void close() override { close_now(*socket_); }
  void part() override { std::make_shared<Parting>(std::move(*socket_))->begin(); }

 private:
  std::shared_ptr<Socket> socket_;
};

class TlsStream final : public Stream {
 public:
  TlsStream(std::shared_ptr<asio::ssl::context> context, std::unique_ptr<TlsSocket> socket)
      : context_(std::move(context)), socket_(std::move(socket)) {}
  ~TlsStream() override {
    boost::system::error_code ignored;
    socket_->next_layer().close(ignored);
  }
  void read_some(std::span<char> into, Done done) override {
    socket_->async_read_some(asio::buffer(into.data(), into.size()), keeping(socket_, std::move(done)));
  }
  void write_all(std::string_view bytes, Done done) override {
    write_to(*socket_, bytes, keeping(socket_, std::move(done)));
  }
  // Both without TLS's own farewell, which would wait for the peer: every message carries its length or its end.
  void close() override { close_now(socket_->next_layer()); }
  void part() override { std::make_shared<Parting>(std::move(socket_->next_layer()))->begin(); }

 private:
  std::shared_ptr<asio::ssl::context> context_;
  std::shared_ptr<TlsSocket> socket_;
};

std::shared_ptr<asio::ssl::context> tls_context(const Credentials& credentials, bool server) {
  const auto context =
      std::make_shared<asio::ssl::context>(server ? asio::ssl::context::tls_server : asio::ssl::context::tls_client);
  const auto load = [](const std::string& file, const char* option, auto use) {
    if (file.empty()) throw InputError(std::string("tls:// needs ") + option + ": see protocol/PROTOCOL.md, \"TLS\"");
    boost::system::error_code error;
    use(error);
    if (error) throw InputError("cannot use " + std::string(option) + " '" + file + "': " + error.message());
  };
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  load(credentials.certificate, "--certificate",
       [&](auto& error) { context->use_certificate_chain_file(credentials.certificate, error); });
  load(credentials.key, "--key",
       [&](auto& error) { context->use_private_key_file(credentials.key, asio::ssl::context::pem, error); });
  load(credentials.authority, "--authority",
       [&](auto& error) { context->load_verify_file(credentials.authority, error); });
  context->set_verify_mode(asio::ssl::verify_peer | asio::ssl::verify_fail_if_no_peer_cert);
  return context;
}

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
        accepted_(std::make_unique<SocketStream>(std::move(socket)));
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
                            if (*secured) std::make_shared<Parting>(std::move((*secured)->next_layer()))->begin();
                          } else {
                            accepted_(std::make_unique<TlsStream>(tls_, std::move(*secured)));
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

// One attempt to connect: each step begins the next.
class Attempt : public std::enable_shared_from_this<Attempt> {
  // What comes next where a step has succeeded.  Keeps this alive until then.
  template <class Next>
  auto then(Next next) {
    return [this, self = shared_from_this(), next](boost::system::error_code error, const auto&...) {
      if (error) return fail(error);
      if (done_) next();
    };
  }

 public:
  Attempt(asio::io_context& context, const Address& address, const Credentials& credentials, Connected done)
      : address_(address), done_(std::move(done)), resolver_(context), plain_(context), tcp_(context) {
    if (address.kind == Address::Kind::tls) tls_ = tls_context(credentials, false);
  }

  void begin() {
    if (address_.kind == Address::Kind::unix_socket) {
      plain_.async_connect(asio::local::stream_protocol::endpoint(address_.path),
                           then([this] { succeed(std::make_unique<SocketStream>(std::move(plain_))); }));
    } else {
      resolver_.async_resolve(address_.host, address_.port,
                              [this, self = shared_from_this()](boost::system::error_code error, const auto& found) {
                                if (error) return fail(error);
                                if (done_) asio::async_connect(tcp_, found, then([this] { secure(); }));
                              });
    }
  }

  void give_up() {
    done_ = {};
    resolver_.cancel();
    close_now(plain_);
    boost::system::error_code ignored;
    tcp_.close(ignored);
    if (secured_) secured_->lowest_layer().close(ignored);
  }

 private:
  void secure() {
    boost::system::error_code ignored;
    tcp_.set_option(asio::ip::tcp::no_delay(true), ignored);
    if (!tls_) return succeed(std::make_unique<SocketStream>(Socket(std::move(tcp_))));
    secured_ = std::make_unique<TlsSocket>(Socket(std::move(tcp_)), *tls_);
    secured_->set_verify_callback(asio::ssl::host_name_verification(address_.host));
    secured_->async_handshake(asio::ssl::stream_base::client,
                              then([this] { succeed(std::make_unique<TlsStream>(tls_, std::move(secured_))); }));
  }

  void succeed(std::unique_ptr<Stream> stream) { std::exchange(done_, {})(std::move(stream), {}, {}); }
  void fail(const boost::system::error_code& error) {
    if (const auto done = std::exchange(done_, {})) {
      done(nullptr, error,
           "cannot connect to " + (address_.path.empty() ? address_.host + ":" + address_.port : address_.path) + ": " +
               error.message() + what_is_wrong_with_the_certificate());
    }
  }
  std::string what_is_wrong_with_the_certificate() const {
    const long found = secured_ ? SSL_get_verify_result(secured_->native_handle()) : X509_V_OK;
    return found == X509_V_OK ? "" : std::string(": ") + X509_verify_cert_error_string(found);
  }

  const Address address_;
  Connected done_;
  asio::ip::tcp::resolver resolver_;
  Socket plain_;  // of the UNIX family
  asio::ip::tcp::socket tcp_;
  std::shared_ptr<asio::ssl::context> tls_;
  std::unique_ptr<TlsSocket> secured_;
};

}  // namespace

bool is_of_certificates(const boost::system::error_code& error) {
  if (error.category() != asio::error::get_ssl_category()) return false;
  switch (ERR_GET_REASON(static_cast<unsigned long>(error.value()))) {
    case SSL_R_CERTIFICATE_VERIFY_FAILED:  // found here; the others are what the peer says of ours
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_UNSUPPORTED_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
      return true;
    default:
      return false;
  }
}

std::unique_ptr<Stream> socket_stream(asio::io_context& context, int descriptor) {
  return std::make_unique<SocketStream>(Socket(context, {AF_UNIX, 0}, descriptor));
}

std::unique_ptr<Listener> listen(asio::io_context& context, const Address& address, const Credentials& credentials) {
  return std::make_unique<SocketListener>(context, address, credentials);
}

std::shared_ptr<void> connect(asio::io_context& context, const Address& address, const Credentials& credentials,
                              Connected done) {
  const auto attempt = std::make_shared<Attempt>(context, address, credentials, std::move(done));
  attempt->begin();
  return {attempt.get(), [attempt](void*) { attempt->give_up(); }};
}

}  // namespace spacetime::protocol
