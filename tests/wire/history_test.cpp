// What a client keeps of what it has asked, to bring a new optimizer to where the last one was.
#include "protocol/history.h"

#include <gtest/gtest.h>

namespace spacetime::protocol {
namespace {

void note(History& history, std::string_view method, std::string_view params, const std::string& result) {
  const Json tree = Json::parse(result);
  history.note(method, params, Node(tree, "result"));
}

std::vector<std::string> kept(const History& history) {
  std::vector<std::string> all;
  for (const auto& [method, params] : history.messages()) all.push_back(method + " " + params);
  return all;
}

TEST(History, KeepsWhatWasDoneAndAfterACheckpointTheLastProblemAndTheMotion) {
  using Kept = std::vector<std::string>;
  History history;
  note(history, "problem/load", R"({"problem":1})", R"({"unknowns":3})");
  note(history, "action/do", R"({"action":{"action":"solve"}})", R"({"log":[{"action":"iterate","iterations":3}]})");
  note(history, "motion/get", "{}", R"({"motion":{}})");
  note(history, "sample", "{}", R"({"values":{}})");
  note(history, "problem/update", R"({"problem":2})", R"({"iteration":4,"log":[{"action":"iterate","iterations":1}]})");
  const Kept all{R"(problem/load {"problem":1})", R"(action/do {"action":{"action":"iterate","iterations":3}})",
                 R"(action/do {"action":{"action":"iterate","iterations":1}})", R"(problem/update {"problem":2})"};
  EXPECT_EQ(kept(history), all);

  for (int k = 3; k < 6; ++k) {
    const std::string problem = "{\"problem\":" + std::to_string(k) + "}";
    note(history, "problem/update", problem, R"({"log":[{"action":"reset"}]})");
    note(history, "motion/get", R"({"checkpoint":true})",
         R"({"log":[],"motion":{"z":0.5,"checkpoint":{"b":1,"a":2}}})");
    const Kept last{"problem/load " + problem, R"(motion/set {"motion":{"z":0.5,"checkpoint":{"b":1,"a":2}}})"};
    EXPECT_EQ(kept(history), last);
  }
  note(history, "motion/set", R"({"motion":{}})", R"({"log":[]})");
  EXPECT_EQ(kept(history).size(), 3u);
  EXPECT_EQ(kept(history).back(), R"(motion/set {"motion":{}})");
  note(history, "problem/load", R"({"problem":7})", "{}");
  EXPECT_EQ(kept(history), Kept{R"(problem/load {"problem":7})"});
}

}  // namespace
}  // namespace spacetime::protocol
