// What each daemon offers, as an OpenRPC document (protocol/schemas/*.openrpc.json), put into the programs when they
// are built.
#pragma once

#include <string_view>

namespace spacetime::protocol {

std::string_view symbolic_description();
std::string_view optimizer_description();

}  // namespace spacetime::protocol
