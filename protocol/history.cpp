#include "protocol/history.h"

#include <algorithm>
#include <ranges>

namespace spacetime::protocol {

void History::note(std::string_view method, std::string_view params, const Node& result) {
  const auto add = [&](std::string_view which, std::string text) {
    messages_.push_back({std::string(which), std::move(text)});
  };
  if (method == "problem/load") messages_.clear();
  if (const auto log = result.find("log")) {
    for (std::size_t i = 0; i < log->list(); ++i) {
      add("action/do", "{\"action\":" + (*log)[i].json().dump() + "}");
    }
  }
  if (method == "problem/load" || method == "problem/update" || method == "motion/set") {
    add(method, std::string(params));
  } else if (method == "motion/get" && result["motion"].find("checkpoint")) {
    // All that has been done is in it but the problem itself: the one that was brought last.
    const auto brings = [](const Message& message) { return message.method.starts_with("problem/"); };
    const auto last = std::ranges::find_if(messages_ | std::views::reverse, brings);
    std::string problem = last == messages_.rend() ? std::string() : std::move(last->params);
    messages_.clear();
    if (!problem.empty()) add("problem/load", std::move(problem));
    add("motion/set", "{\"motion\":" + result["motion"].json().dump() + "}");
  }
}

}  // namespace spacetime::protocol
