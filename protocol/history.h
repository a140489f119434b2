// What must be sent to a new optimizer so that it stands where another one stood: kept by a client from what was asked
// and answered.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/strict.h"

namespace spacetime::protocol {

class History {
 public:
  struct Message {
    std::string method, params;  // params as JSON text
  };

  // Takes note of a request that was answered with this result.  Throws DocumentError where no optimizer answers so.
  void note(std::string_view method, std::string_view params, const Node& result);

  // To be sent one after another, each when the one before has been answered.
  const std::vector<Message>& messages() const { return messages_; }

 private:
  std::vector<Message> messages_;
};

}  // namespace spacetime::protocol
