#include "protocol/address.h"

#include <algorithm>

#include "common/diagnostic.h"

namespace spacetime::protocol {

Address parse_address(std::string_view text) {
  const auto wrong = [&] {
    throw InputError("expected unix:/path, tcp://host:port or tls://host:port, found '" + std::string(text) + "'");
  };
  Address address;
  if (text.starts_with("unix:")) {
    address.path = text.substr(5);
    if (address.path.empty()) wrong();
    return address;
  }
  if (!text.starts_with("tcp://") && !text.starts_with("tls://")) wrong();
  address.kind = text.starts_with("tcp") ? Address::Kind::tcp : Address::Kind::tls;
  const auto place = text.substr(6);
  const auto colon = place.rfind(':');
  if (colon == place.npos || colon == 0) wrong();
  address.host = place.substr(0, colon);
  address.port = place.substr(colon + 1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (address.port.empty() || address.port.size() > 5 || !std::ranges::all_of(address.port, is_digit)) wrong();
  if (address.host.front() == '[' && address.host.back() == ']')
    address.host = address.host.substr(1, address.host.size() - 2);
  return address;
}

}  // namespace spacetime::protocol
