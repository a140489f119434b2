// Sockets as streams, for what makes them: listener and connect.  Others know stream.h alone.
#pragma once

#include "protocol/stream.h"

// After stream.h, which has what Asio 1.74 forgets.
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/ssl.hpp>
#include <memory>

namespace spacetime::protocol {

namespace asio = boost::asio;
using Socket = asio::generic::stream_protocol::socket;
using TlsSocket = asio::ssl::stream<Socket>;

void close_now(Socket& socket);

// Closes a socket that has said everything so that it arrives: it listens, without interest, until its peer has ended
// or some time is up.
void part(Socket socket);

std::unique_ptr<Stream> stream_of(Socket socket);
// ... of a socket whose handshake is done, with what it was made from.
std::unique_ptr<Stream> stream_of(std::shared_ptr<asio::ssl::context> context, std::unique_ptr<TlsSocket> socket);

// What both sides verify each other with.  Throws InputError: certificates that cannot be read.
std::shared_ptr<asio::ssl::context> tls_context(const Credentials& credentials, bool server);

}  // namespace spacetime::protocol
