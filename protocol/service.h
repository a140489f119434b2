// What a daemon offers: a table from method to function.  It knows nothing of bytes, sockets or other peers.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/allowance.h"
#include "protocol/rpc.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime::protocol {

// A request that is being worked on, as its method sees it.
class Call {
 public:
  virtual ~Call() = default;

  using Clock = std::chrono::steady_clock;

  // To be asked between two steps of long work: serves requests that may be served now (Turn::between), and those that
  // come until then, and says whether to go on.
  virtual bool go_on(Clock::time_point until = {}) = 0;

  // The newest state of affairs, as JSON text that is only written when it can be sent.  An older one that has not been
  // sent by then is never sent.  `value` is called in another thread, but never twice at a time.
  virtual void progress(std::function<std::string()> value) = 0;
};

// When a request may be served while another is worked on.
enum class Turn {
  waits,    // when that one has ended
  between,  // between two of its steps
  ends,     // at once after it, which is ended for that
};

struct Method {
  std::string_view name;
  // Writes the members of the result.  Throws Error, or InputError for parameters that make no sense.
  std::function<void(const Node& params, Writer& result, Call& call)> perform;
  std::function<Turn(const Json& params)> turn;  // Turn::waits where empty
  // Brings the state that later requests speak of: those with an older revision than the newest of such are stale.
  bool renews = false;
};

struct Service {
  std::string_view name, version;
  std::string_view description;  // the OpenRPC document: the answer to rpc.discover
  // The methods of a new session, which hold its state.  Used by one thread at a time.
  std::function<std::vector<Method>(const Allowance&)> open;
};

inline constexpr int protocol_version = 1;

}  // namespace spacetime::protocol
