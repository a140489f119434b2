#include "gui/command_window.h"

#include <filesystem>
#include <memory>
#include <string>

#include "common/diagnostic.h"
#include "gui/disk.h"
#include "gui/hub.h"
#include "gui/window.h"
#include "protocol/address.h"

namespace spacetime::gui {
namespace {

struct Options {
  std::string file, symbolic, optimizer;
  protocol::Credentials credentials;
  float scale = 0;
};

protocol::Target target(const std::string& address, const std::string& name, const Options& options) {
  if (address.empty()) return daemon_beside(name);
  return {{}, protocol::parse_address(address), options.credentials};
}

int run(const Options& options) {
  if (!options.file.empty() && !std::filesystem::exists(options.file))
    throw InputError("there is no file '" + options.file + "'");
  HubOptions hub_options;
  hub_options.symbolic = target(options.symbolic, "symbolic", options);
  hub_options.optimizer = target(options.optimizer, "optimizer", options);
  hub_options.folder = state_folder();
  hub_options.wake = wake_window;
  Hub hub(std::move(hub_options));
  if (!options.file.empty()) hub.post(Open{options.file});
  return run_window(hub, options.scale, options.file.empty());
}

}  // namespace

std::function<int()> add_window(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  const char* where = "Where it is, instead of starting one: unix:/path, tcp://host:port or tls://host:port";
  app.add_option("FILE", options->file, "The scene to open; without one the examples are offered");
  app.add_option("--symbolic", options->symbolic, where);
  app.add_option("--optimizer", options->optimizer, where);
  app.add_option("--certificate", options->credentials.certificate, "PEM file: who this window is, for tls");
  app.add_option("--key", options->credentials.key, "PEM file: the certificate's private key");
  app.add_option("--authority", options->credentials.authority,
                 "PEM file: who must have signed the daemons' certificates");
  app.add_option("--scale", options->scale, "How large everything is drawn; by default as the screen asks for")
      ->check(CLI::Range(0.5, 4.0));
  return [options] { return run(*options); };
}

}  // namespace spacetime::gui
