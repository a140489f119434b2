// Runs a service as a daemon: over standard input and output, or for whoever connects.
#pragma once

#include <string>

#include "protocol/address.h"
#include "protocol/service.h"

namespace spacetime::protocol {

struct ServerOptions {
  std::string listen;  // an address; empty: standard input and output
  Credentials credentials;
  Allowance allowance;
  std::string record;  // a file for all messages, one a line; empty: none
  bool verbose = false;
};

// Returns when the peer on standard input has gone, or after SIGINT or SIGTERM.  Throws InputError where it cannot
// begin.
void serve(const Service& service, const ServerOptions& options);

}  // namespace spacetime::protocol
