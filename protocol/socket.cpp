#include "protocol/socket.h"

#include <sys/socket.h>

#include <array>
#include <boost/asio/buffer.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>

#include "common/diagnostic.h"

namespace spacetime::protocol {
namespace {

// A socket that is closed while its peer goes on sending would take back what it has written last (TCP resets the
// connection), so it reads on for so long.
constexpr std::chrono::milliseconds parting{500};

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

Socket& lowest(Socket& socket) { return socket; }
Socket& lowest(TlsSocket& socket) { return socket.next_layer(); }

// Of a socket, or of one under TLS.  It is closed and parted with without TLS's own farewell, which would wait for the
// peer: every message carries its length or its end.
template <class Working>
class SocketStream final : public Stream {
 public:
  explicit SocketStream(std::shared_ptr<Working> socket, std::shared_ptr<asio::ssl::context> context = {})
      : context_(std::move(context)), socket_(std::move(socket)) {}
  ~SocketStream() override {
    boost::system::error_code ignored;
    lowest(*socket_).close(ignored);
  }
  void read_some(std::span<char> into, Done done) override {
    socket_->async_read_some(asio::buffer(into.data(), into.size()), keeping(socket_, std::move(done)));
  }
  void write_all(std::string_view bytes, Done done) override {
    asio::async_write(*socket_, asio::buffer(bytes.data(), bytes.size()), keeping(socket_, std::move(done)));
  }
  void close() override { close_now(lowest(*socket_)); }
  void part() override { protocol::part(std::move(lowest(*socket_))); }

 private:
  std::shared_ptr<asio::ssl::context> context_;  // null without TLS
  std::shared_ptr<Working> socket_;
};

}  // namespace

void close_now(Socket& socket) {
  boost::system::error_code ignored;
  socket.shutdown(Socket::shutdown_both, ignored);
  socket.close(ignored);
}

void part(Socket socket) { std::make_shared<Parting>(std::move(socket))->begin(); }

std::unique_ptr<Stream> stream_of(Socket socket) {
  return std::make_unique<SocketStream<Socket>>(std::make_shared<Socket>(std::move(socket)));
}

std::unique_ptr<Stream> stream_of(std::shared_ptr<asio::ssl::context> context, std::unique_ptr<TlsSocket> socket) {
  return std::make_unique<SocketStream<TlsSocket>>(std::move(socket), std::move(context));
}

std::unique_ptr<Stream> socket_stream(asio::io_context& context, int descriptor) {
  return stream_of(Socket(context, {AF_UNIX, 0}, descriptor));
}

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

}  // namespace spacetime::protocol
