// The schemas say what the readers do.  Documents are changed value by value; wherever the form is wrong, schema and
// reader both say so:
//   what the reader refuses for its form, the schema refuses too;
//   what the schema refuses, the reader (form and meaning) refuses too.
#include <gtest/gtest.h>

#include <set>

#include "common/program.h"
#include "protocol/limits.h"
#include "protocol/motion_json.h"
#include "protocol/problem_json.h"
#include "tests/protocol/examples.h"
#include "tests/protocol/schema.h"

namespace spacetime {
namespace {

using nlohmann::json;

template <class Read>
bool accepts(Read read) {
  try {
    read();
    return true;
  } catch (const DocumentError&) {
    return false;
  }
}

bool reads_problem(const std::string& text) {
  return accepts([&] { read_problem(text); });
}
bool reads_motion(const std::string& text) {
  return accepts([&] { read_motion(text); });
}
bool has_form_of_problem(const std::string& text) {
  return accepts([&] { problem_from({parse(text, problem_document), problem_document}); });
}
bool has_form_of_motion(const std::string& text) {
  return accepts([&] { motion_from({parse(text, motion_document), motion_document}); });
}

// Paths of all values, one for each kind of place: elements of a list of numbers are alike, elements of a list of
// statements are not; programs differ in their inputs.
std::vector<json::json_pointer> places(const json& document) {
  std::vector<json::json_pointer> found;
  std::vector<json::json_pointer> open{json::json_pointer()};
  while (!open.empty()) {
    const auto place = open.back();
    open.pop_back();
    found.push_back(place);
    const auto& value = document[place];
    if (value.is_object()) {
      const bool programs = !place.empty() && place.back() == "programs";
      for (const auto& [name, member] : value.items()) {
        const bool first = !programs || name == value.begin().key();
        open.push_back(first ? place / name : place / name / "inputs");
      }
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (i == 0 || value[i].is_object()) open.push_back(place / i);
      }
    }
  }
  return found;
}

struct Counts {
  int both = 0, neither = 0, meaning = 0;
};

Counts compare(const Schema& schema, const json& original, auto reads, auto has_form) {
  EXPECT_TRUE(schema.accepts(original));
  Counts counts;
  const auto judge = [&](const json& document, const std::string& change) {
    const auto text = document.dump();
    const bool form = has_form(text), valid = schema.accepts(document), whole = form && reads(text);
    EXPECT_FALSE(!form && valid) << change << ": refused by the reader, not by the schema";
    EXPECT_FALSE(whole && !valid) << change << ": refused by the schema, not by the reader";
    ++(!form && !valid ? counts.both : valid && whole ? counts.neither : counts.meaning);
  };
  const json others[] = {nullptr,
                         true,
                         "text",
                         -1,
                         0,
                         3,
                         1.5,
                         1e300,
                         2147483648.0,
                         4294967296,
                         json::array(),
                         json::object(),
                         json::array({json::array({0, 1})})};
  for (const auto& place : places(original)) {
    const auto at = place.to_string();
    for (const auto& other : others) {
      auto changed = original;
      changed[place] = other;
      judge(changed, at + " = " + other.dump());
    }
    auto changed = original;
    auto& value = changed[place];
    if (value.is_object()) {
      value["surplus"] = 1;
      judge(changed, at + " with a surplus member");
    } else if (value.is_array()) {
      value.push_back(nullptr);
      judge(changed, at + " with null added");
      value.erase(value.size() - 1);
      if (!value.empty()) value.erase(value.size() - 1);
      judge(changed, at + " without its last");
    }
    if (place.empty()) continue;
    changed = original;
    auto& parent = changed[place.parent_pointer()];
    if (!parent.is_object()) continue;
    parent.erase(place.back());
    judge(changed, at + " removed");
  }
  return counts;
}

TEST(Schemas, AcceptWhatIsWritten) {
  const Schema problems("problem.schema.json"), motions("motion.schema.json");
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_TRUE(problems.accepts(json::parse(write(examples::random_problem(seed)))));
    EXPECT_TRUE(motions.accepts(json::parse(write(examples::random_motion(seed)))));
  }
}

TEST(Schemas, AgreeWithTheReaderOfProblems) {
  auto problem = examples::rich_problem();
  problem.bodies.resize(1);
  const auto counts =
      compare(Schema("problem.schema.json"), json::parse(write(problem)), reads_problem, has_form_of_problem);
  EXPECT_GT(counts.both, 2000);
  EXPECT_GT(counts.neither, 50);
  EXPECT_GT(counts.meaning, 100);
}

TEST(Schemas, AgreeWithTheReaderOfActions) {
  auto problem = examples::busy_problem();
  const auto counts =
      compare(Schema("problem.schema.json"), json::parse(write(problem)), reads_problem, has_form_of_problem);
  EXPECT_GT(counts.both, 2000);
  EXPECT_GT(counts.neither, 150);
  EXPECT_GT(counts.meaning, 150);
}

TEST(Schemas, AgreeWithTheReaderOfMotions) {
  auto motion = examples::rich_motion();
  for (const auto status : {Status::converged, Status::failed}) {
    motion.status = status;
    if (status == Status::failed) {  // the other method
      motion.checkpoint->sqp92.reset();
      motion.checkpoint->bfgs = {{1, 0.5, 2}};
    }
    const auto counts =
        compare(Schema("motion.schema.json"), json::parse(write(motion)), reads_motion, has_form_of_motion);
    EXPECT_GT(counts.both, 500);
    EXPECT_GT(counts.neither, 100);
    EXPECT_GT(counts.meaning, 20);
  }
}

TEST(Schemas, KnowTheOperationsAndTheLimits) {
  const auto schema = load_schema("problem.schema.json");
  const auto& program = schema["definitions"]["program"]["properties"];
  std::set<std::string> names;
  for (int i = 0; i < op_count; ++i) names.emplace(info(static_cast<Op>(i)).name);
  EXPECT_EQ(program["op"]["items"]["enum"].get<std::set<std::string>>(), names);
  EXPECT_EQ(program["op"]["maxItems"], limits::operations);
  EXPECT_EQ(schema["definitions"]["basis"]["properties"]["knots"]["maxItems"], limits::spans + 7);
  EXPECT_EQ(schema["definitions"]["scope"]["oneOf"][3]["properties"]["count"]["maximum"], limits::instances);
  EXPECT_EQ(schema["definitions"]["name"]["maxLength"], limits::name_bytes);
  const auto& actions = schema["definitions"]["action"]["oneOf"];
  ASSERT_EQ(actions.size(), action_names().size());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    EXPECT_EQ(actions[i]["properties"]["action"]["const"], action_names()[i]);
  }
  EXPECT_EQ(actions[0]["properties"]["starts"]["maximum"], limits::starts);
  EXPECT_EQ(actions[3]["properties"]["times"]["maximum"], limits::halvings);
}

// Whether every member has a description, its own or that of what it refers to.
TEST(Schemas, DescribeEveryMember) {
  for (const auto* name : {"problem.schema.json", "motion.schema.json"}) {
    const auto schema = load_schema(name);
    int members = 0;
    std::vector<const json*> open{&schema};
    while (!open.empty()) {
      const auto& value = *open.back();
      open.pop_back();
      for (const auto& [key, below] : value.items()) {
        if (below.is_structured()) open.push_back(&below);
        if (key != "properties") continue;
        for (const auto& [member, description] : below.items()) {
          ++members;
          auto described = description;
          if (!described.contains("description") && described.contains("$ref")) {
            const auto reference = described["$ref"].get<std::string>();
            const auto hash = reference.find('#');
            const auto& home = hash == 0 ? schema : load_schema(reference.substr(0, hash));
            described = home[json::json_pointer(reference.substr(hash + 1))];
          }
          EXPECT_TRUE(described.contains("description")) << name << ": " << member;
        }
      }
    }
    EXPECT_GT(members, 20);
  }
}

}  // namespace
}  // namespace spacetime
