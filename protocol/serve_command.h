// The command `serve` of both programs.
#pragma once

#include <CLI/CLI.hpp>

#include "protocol/server.h"

namespace spacetime::protocol {

// Adds the command with its options, which are written to `options`.
CLI::App* add_serve_command(CLI::App& app, ServerOptions& options);

}  // namespace spacetime::protocol
