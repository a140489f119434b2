// Streams of bytes between two peers, whatever carries them: a socket, a socket under TLS, or standard input and
// output.  All of Asio that others see.
#pragma once

#include <utility>  // before Asio 1.74, which uses std::exchange without it

#include <boost/asio/io_context.hpp>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "protocol/address.h"

namespace spacetime::protocol {

// Calls back in the io_context's thread, with an error or the number of bytes.  One read and one write at a time.
class Stream {
 public:
  using Done = std::function<void(boost::system::error_code, std::size_t)>;
  virtual ~Stream() = default;
  virtual void read_some(std::span<char> into, Done done) = 0;
  virtual void write_all(std::string_view bytes, Done done) = 0;  // bytes stay where they are until then
  virtual void close() = 0;                                       // at once; what is under way calls back with an error
  virtual void part() = 0;  // closes so that what was written still arrives, whatever the peer goes on sending
};

// Standard input and output, through two threads: they may be terminals, pipes or files, which block, and are shared
// with other processes, so that they cannot be made not to.  `ended` is called when standard output has taken what was
// written before part(), however long nobody reads it; when it takes no more; or after close().
std::unique_ptr<Stream> standard_stream(boost::asio::io_context& context, std::function<void()> ended);

// A connected socket of the UNIX family, which it takes over.
std::unique_ptr<Stream> socket_stream(boost::asio::io_context& context, int descriptor);

// Accepts connections one after another until it is destroyed.
class Listener {
 public:
  virtual ~Listener() = default;
  // `accepted` is called with each stream that is ready for messages: connected, and with TLS once each side has
  // verified the other.  `refused` says why one is not.
  virtual void accept(std::function<void(std::unique_ptr<Stream>)> accepted,
                      std::function<void(std::string)> refused) = 0;
  virtual std::string address() const = 0;  // as parse_address takes it, with the port that was chosen for 0
};

// Throws InputError: a path that is in use, a host off loopback without TLS, certificates that cannot be read.
std::unique_ptr<Listener> listen(boost::asio::io_context& context, const Address& address,
                                 const Credentials& credentials);

// Whether one side does not accept the other's certificate, as it will not the next time either.
bool is_of_certificates(const boost::system::error_code& error);

// A stream that is ready for messages; or null, with the error and a sentence on it.
using Connected =
    std::function<void(std::unique_ptr<Stream> stream, boost::system::error_code error, const std::string& why)>;

// Begins to connect, and with TLS to verify each other; `done` is called in the io_context's thread, however long that
// takes.  Whoever lets go of what this returns ends the attempt, and is not called.  Throws InputError: certificates
// that cannot be read.
std::shared_ptr<void> connect(boost::asio::io_context& context, const Address& address, const Credentials& credentials,
                              Connected done);

}  // namespace spacetime::protocol
