// Documents changed in one place, and what readers say of it.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "protocol/json.h"
#include "tests/protocol/examples.h"

namespace spacetime {

struct Refusal {
  std::string path, message;
};

template <class Read>
std::optional<Refusal> refusal(Read read) {
  try {
    read();
    return std::nullopt;
  } catch (const DocumentError& error) {
    return Refusal{error.path(), error.what()};
  }
}

// Stands for a program of the example by what it computes, since its name is a hash.
inline std::string expand(std::string text) {
  static const auto problem = examples::rich_problem(), busy = examples::busy_problem();
  const std::pair<std::string, std::string> names[] = {{"SINE", problem.constraints[0].program},
                                                       {"PRODUCT", problem.constraints[4].program},
                                                       {"SQUARE", problem.plots[0].program},
                                                       {"AIMED", problem.constraints[6].program},
                                                       {"SLOW", problem.constraints[6].condition->program},
                                                       {"GOAL", busy.constraints[0].program},
                                                       {"POSE", problem.bodies[0].program},
                                                       {"TWICE", problem.constants[1].value.program}};
  for (const auto& [name, hash] : names) {
    for (auto at = text.find(name); at != text.npos; at = text.find(name)) text.replace(at, name.size(), hash);
  }
  return text;
}

// Puts a value (JSON text; none: removes it) at a path of the document, and gives the text again.
inline std::string change(const std::string& document, const std::string& path,
                          const std::optional<std::string>& value) {
  auto tree = nlohmann::ordered_json::parse(document);
  const nlohmann::ordered_json::json_pointer pointer(expand(path));
  if (value) {
    tree[pointer] = nlohmann::ordered_json::parse(expand(*value));
  } else {
    tree[pointer.parent_pointer()].erase(pointer.back());
  }
  return tree.dump();
}

struct Case {
  const char* path;                  // where the document is changed ...
  std::optional<std::string> value;  // ... to this; none: it is removed
  const char* fault;                 // the path named, "" for the document, nullptr for the place of the change
  const char* words;                 // part of the sentence
};

inline void expect_refusals(const std::string& document, const std::vector<Case>& cases, auto read) {
  ASSERT_FALSE(refusal([&] { read(document); }));
  for (const auto& each : cases) {
    SCOPED_TRACE(std::string(each.path) + " = " + each.value.value_or("(removed)"));
    const auto found = refusal([&] { read(change(document, each.path, each.value)); });
    ASSERT_TRUE(found) << "was accepted";
    EXPECT_EQ(found->path, expand(each.fault ? each.fault : each.path));
    EXPECT_NE(found->message.find(expand(each.words)), std::string::npos) << found->message;
  }
}

inline constexpr auto none = std::nullopt;

}  // namespace spacetime
