#include "protocol/history.h"

namespace spacetime::protocol {

void History::note(std::string_view method, std::string_view params, const Json& result) {
  const auto add = [&](std::string_view which, std::string text) {
    messages_.push_back({std::string(which), std::move(text)});
  };
  if (method == "problem/load") messages_.clear();
  if (const auto log = result.find("log"); log != result.end()) {
    for (const Json& action : *log) add("action/do", Json{{"action", action}}.dump());
  }
  if (method == "problem/load" || method == "problem/update" || method == "motion/set") {
    add(method, std::string(params));
  } else if (method == "motion/get" && result.at("motion").contains("checkpoint")) {
    // All that has been done is in it but the problem itself.
    std::erase_if(messages_, [](const Message& message) { return !message.method.starts_with("problem/"); });
    add("motion/set", Json{{"motion", result.at("motion")}}.dump());
  }
}

}  // namespace spacetime::protocol
