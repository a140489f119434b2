// Standard input and output as a stream.
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <thread>

#include "common/diagnostic.h"
#include "protocol/stream.h"

namespace spacetime::protocol {
namespace {

bool send_all(int to, const char* bytes, std::size_t size, bool socket) {
  while (size > 0) {
    const auto sent = socket ? ::send(to, bytes, size, MSG_NOSIGNAL) : ::write(to, bytes, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return true;
}

// Copies until the source ends or the sink does not take more.
void copy_all(int from, int to, bool to_socket) {
  std::array<char, 1 << 16> block;
  for (;;) {
    const auto got = ::read(from, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 || !send_all(to, block.data(), static_cast<std::size_t>(got), to_socket)) return;
  }
}

// Two sockets that are connected with each other.
std::array<int, 2> connected() {
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) throw InputError("no sockets are left");
  return pair;
}

class StandardStream final : public Stream {
 public:
  StandardStream(boost::asio::io_context& context, std::function<void()> ended) {
    const auto [outer, inner] = connected();
    const auto [watching, watched] = connected();
    socket_ = socket_stream(context, outer);
    output_ends_ = socket_stream(context, watching);
    output_ends_->read_some(nothing_, [ended = std::move(ended)](boost::system::error_code, std::size_t) { ended(); });
    // The first ends with standard input, which may be never: nobody waits for it, and it uses nothing of this object.
    std::thread([inner = ::fcntl(inner, F_DUPFD_CLOEXEC, 0)] {
      copy_all(STDIN_FILENO, inner, true);
      ::shutdown(inner, SHUT_WR);
      ::close(inner);
    }).detach();
    // Nor does the second where this is closed: whoever does not read standard output would hold us up for ever.
    std::thread([inner = inner, watched = watched] {
      copy_all(inner, STDOUT_FILENO, false);
      ::shutdown(inner, SHUT_RDWR);  // standard output takes no more: whoever writes is to know
      ::close(inner);
      ::close(watched);
    }).detach();
  }
  ~StandardStream() override { socket_->close(); }
  void read_some(std::span<char> into, Done done) override { socket_->read_some(into, std::move(done)); }
  void write_all(std::string_view bytes, Done done) override { socket_->write_all(bytes, std::move(done)); }
  void close() override {
    socket_->close();
    output_ends_->close();
  }
  void part() override { socket_->close(); }

 private:
  std::unique_ptr<Stream> socket_;
  std::unique_ptr<Stream>
      output_ends_;  // what it reads is its end, as soon as the thread for standard output has ended
  std::array<char, 1> nothing_{};
};

}  // namespace

std::unique_ptr<Stream> standard_stream(boost::asio::io_context& context, std::function<void()> ended) {
  return std::make_unique<StandardStream>(context, std::move(ended));
}

}  // namespace spacetime::protocol
