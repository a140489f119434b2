#include "protocol/history.h"

namespace spacetime::protocol {

void History::note(std::string_view method, std::string_view params, const Json& result) {
  const auto add = [&](bool run) { messages_.push_back({std::string(method), std::string(params), run}); };
  if (method == "problem/load") {
    messages_.clear();
    add(false);
  } else if (method == "action/do") {
    note_log(result);
  } else if (method == "problem/update") {
    note_log(result);
    add(false);
  } else if (method == "motion/set") {
    note_log(result);
    add(true);
  } else if (method == "motion/get" && Json::parse(params).value("checkpoint", false)) {
    std::erase_if(messages_, [](const Message& message) { return message.run; });
    messages_.push_back({"motion/set", Json{{"motion", result.at("motion")}}.dump(), true});
  }
}

void History::note_log(const Json& result) {
  for (const Json& action : result.at("log")) {
    const Json& word = action.at("action");
    messages_.push_back({"action/do", Json{{"action", action}}.dump(), word == "solve" || word == "iterate"});
  }
}

}  // namespace spacetime::protocol
