// Connecting to a daemon, at a path or a host and port, with TLS or without.
#include "protocol/socket.h"

// After socket.h, which has what Asio 1.74 forgets.
#include <boost/asio/connect.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>

namespace spacetime::protocol {
namespace {

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
                           then([this] { succeed(stream_of(std::move(plain_))); }));
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
    if (!tls_) return succeed(stream_of(Socket(std::move(tcp_))));
    secured_ = std::make_unique<TlsSocket>(Socket(std::move(tcp_)), *tls_);
    secured_->set_verify_callback(asio::ssl::host_name_verification(address_.host));
    secured_->async_handshake(asio::ssl::stream_base::client,
                              then([this] { succeed(stream_of(tls_, std::move(secured_))); }));
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

std::shared_ptr<void> connect(asio::io_context& context, const Address& address, const Credentials& credentials,
                              Connected done) {
  const auto attempt = std::make_shared<Attempt>(context, address, credentials, std::move(done));
  attempt->begin();
  return {attempt.get(), [attempt](void*) { attempt->give_up(); }};
}

}  // namespace spacetime::protocol
