// Where a daemon listens, or a client finds one: unix:/path, tcp://host:port, tls://host:port.
#pragma once

#include <string>
#include <string_view>

namespace spacetime::protocol {

struct Address {
  enum class Kind { unix_socket, tcp, tls } kind = Kind::unix_socket;
  std::string path;        // unix_socket
  std::string host, port;  // the others; host without brackets
};

// Throws InputError for anything else.
Address parse_address(std::string_view text);

// PEM files: who one is, and who must have signed the other side's certificate.
struct Credentials {
  std::string certificate, key, authority;
};

}  // namespace spacetime::protocol
