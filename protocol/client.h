// A client of one daemon, which it starts itself or connects to.  It outlives the daemon: one that crashes is started
// again, or connected to again, and brought back to where it was by sending anew what led there.  A daemon is lost, and
// its owner told why, after many attempts in vain, and at once where the next attempt would end as the last: a program
// that is not there, certificates that one side does not accept, a greeting that is refused, a new daemon that refuses
// what had led the last one to where it was, an answer that is not as the protocol has it.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/address.h"
#include "protocol/rpc.h"

namespace spacetime::protocol {

// A daemon that has not answered the greeting after so long is given up, and tried again: it may be a host that takes
// connections and serves nobody.  Daemons answer within milliseconds; a loaded machine far away may take seconds.
inline constexpr std::chrono::milliseconds greeting_patience{10'000};

// Where the daemon is: a program with its arguments, started over its standard input and output, or an address.
struct Target {
  std::vector<std::string> program;
  std::optional<Address> address;
  Credentials credentials;
  std::chrono::milliseconds patience = greeting_patience;
};

// The answer to a request: one of the two is null.
struct Reply {
  Json result;
  Json error;  // code, message, data
};

class Client {
 public:
  enum class State { connecting, ready, lost };
  struct Callbacks {  // all are called in the client's own thread, one at a time
    std::function<void(State state, const std::string& why)> state;
  };
  using Answered = std::function<void(const Reply&)>;
  using Progress = std::function<void(const Json& value)>;

  Client(Target target, Callbacks callbacks);
  ~Client();  // hangs up at once; a daemon that was started here is killed
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  // Sends a request, now or as soon as the daemon is there, and returns its id at once.  `params` is an object as JSON
  // text.  Every request is answered: where the daemon is lost for good, or ends each time it works on this one, by an
  // error.
  int ask(std::string_view method, std::string params, Answered answered = {}, Progress progress = {});
  void cancel(int id);

  // The daemon's process where it was started here; 0 while there is none.
  int process() const;

 private:
  class Link;
  std::unique_ptr<Link> link_;
};

}  // namespace spacetime::protocol
