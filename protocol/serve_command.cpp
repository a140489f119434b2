#include "protocol/serve_command.h"

namespace spacetime::protocol {

CLI::App* add_serve_command(CLI::App& app, ServerOptions& options) {
  CLI::App* command = app.add_subcommand(
      "serve",
      "Runs as a daemon that talks JSON-RPC 2.0 over standard input and output, or with whoever connects.\n"
      "protocol/PROTOCOL.md describes the messages.");
  command->add_option(
      "--listen", options.listen,
      "unix:/path (a socket for this user alone), tcp://127.0.0.1:port (this machine alone), or\n"
      "tls://host:port (anywhere; each side verifies the other's certificate). Port 0 takes a free one");
  command->add_option("--certificate", options.credentials.certificate, "PEM file: this daemon's certificate, for tls");
  command->add_option("--key", options.credentials.key, "PEM file: the certificate's private key");
  command->add_option("--authority", options.credentials.authority,
                      "PEM file: who must have signed the other side's certificate");
  command->add_option("--record", options.record, "Write all messages to this file, one a line");
  command->add_flag("--verbose", options.verbose, "Tell on standard error who comes and goes");
  for (const Bound& bound : bounds) {
    command
        ->add_option("--limit-" + std::string(bound.name), options.allowance.*bound.value,
                     "At most so many " + std::string(bound.help))
        ->check(CLI::Range(bound.least, bound.most))
        ->capture_default_str()
        ->group("Limits");
  }
  return command;
}

}  // namespace spacetime::protocol
