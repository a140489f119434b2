// JSON-RPC 2.0: requests, notifications and answers as text, one message each.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "protocol/json.h"

namespace spacetime::protocol {

// What can go wrong, by number.  Those above -32100 but for ours are JSON-RPC's own, the last two the Language Server
// Protocol's.  PROTOCOL.md has a line on each.
enum class Code : int {
  not_json = -32700,
  not_a_request = -32600,
  unknown_method = -32601,
  bad_parameters = -32602,
  internal = -32603,
  not_initialised = -32002,
  no_problem = -32003,
  ending = -32004,   // after `shutdown`
  refused = -32005,  // the request is well formed, but cannot be done now or with these values
  unknown_version = -32006,
  too_long = -32010,  // limits, one code each; data names limit and option
  too_deep = -32011,
  too_many_operations = -32012,
  too_many_samples = -32013,
  too_many_unknowns = -32014,
  too_many_sessions = -32015,
  idle = -32016,
  out_of_memory = -32017,
  too_many_waiting = -32018,
  cancelled = -32800,
  stale = -32801,
};

// An answer that is an error: a code, one sentence that says what to do, and `data`, an object as JSON text.
class Error : public std::runtime_error {
 public:
  Error(Code code, const std::string& sentence, std::string data = {})
      : std::runtime_error(sentence), code_(code), data_(std::move(data)) {}
  Code code() const { return code_; }
  const std::string& data() const { return data_; }

 private:
  Code code_;
  std::string data_;
};

// What a peer sent: a request, or a notification where it has no id.
struct Request {
  std::optional<std::string> id;  // as JSON text: a string or an integer; null is none
  std::string method;
  Json params = Json::object();
};

// Reads one message of at most `depth` objects and lists inside one another, which is checked before anything is
// parsed.  Throws Error; `id` is set as soon as it is known, for the answer.  A list of requests at once is refused; an
// answer of the peer's, who was asked nothing, becomes a notification without a method: two peers that answered each
// other's answers would never end.
Request read_request(std::string_view text, std::size_t depth, std::optional<std::string>& id);

// The deepest nesting in a text that may be JSON; stops counting above `most`.
std::size_t depth_of(std::string_view text, std::size_t most);

// Messages in one line.  `result` and `params` are JSON text; an absent id is answered as null.
std::string answer(const std::optional<std::string>& id, std::string_view result);
std::string answer(const std::optional<std::string>& id, const Error& error);
std::string notification(std::string_view method, std::string_view params);
std::string request(std::string_view id, std::string_view method, std::string_view params);

// A limit, or what is beyond it: digits without an exponent.
std::string amount(double number);

// {"path": path}: the data of an error about one place of the parameters.
std::string path_data(std::string_view path);

// {"limit": name, "most": most, "option": "--limit-name"}: the data of an error about a limit.
std::string limit_data(std::string_view name, double most);

}  // namespace spacetime::protocol
