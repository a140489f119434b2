// What one `sample` works out, and what it may cost.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/limits.h"
#include "optimizer/server_sample.h"
#include "protocol/json.h"
#include "symbolic/compile.h"

namespace spacetime::optimizer {
namespace {

Json sampled(const Session& session, const Json& params) {
  Writer to(false);
  const protocol::Allowance allowance;
  to.object([&] { answer_sample(Node(params, "params"), session, allowance, to); });
  return Json::parse(to.take());
}

Session session_of(const std::string& text) { return Session(symbolic::compile(text).problem.value()); }

TEST(Sample, WorksOutWhatIsNamedOnceEach) {
  const Session session =
      session_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\nlet twice = 2*x\nlet other = x^2\n");
  const Json all = sampled(session, {{"times", {0, 1}}});
  EXPECT_TRUE(all["values"].contains("twice"));
  EXPECT_TRUE(all["values"].contains("other"));
  const Json some = sampled(session, {{"times", {0, 1}}, {"expressions", {"twice", "twice", "x'", "x'"}}});
  EXPECT_EQ(some["values"].size(), 2U);
  EXPECT_EQ(some["values"]["twice"], all["values"]["twice"]);
  EXPECT_EQ(sampled(session, {{"times", {0}}, {"expressions", Json::array()}})["values"].size(), 0U);
}

TEST(Sample, RefusesWhatWouldTakeMinutes) {
  std::string sum = "0";
  for (int k = 1; k <= 16000; ++k) sum += fmt::format(" + sin({}*x)", k);
  const Session session =
      session_of("time [0, 1]\ntrajectory bspline spans 4\ndof x\nlet cheap = x\nlet dear = " + sum + "\n");
  const std::size_t operations = session.problem().programs.at(session.problem().plots.at(1).program).op.size();
  const auto count = static_cast<std::size_t>(limits::evaluated_operations / static_cast<double>(operations)) + 2;
  ASSERT_LT(count, 3'999'999U) << operations;  // else too many numbers would be the reason
  Json params{{"times", std::vector<int>(count, 0)}, {"expressions", {"dear"}}};
  try {
    sampled(session, params);
    ADD_FAILURE() << "not refused";
  } catch (const DocumentError& error) {
    EXPECT_EQ(error.path(), "/times");
    EXPECT_NE(std::string(error.what()).find("ask for fewer"), std::string::npos) << error.what();
  }
  params["times"] = {0, 0.5};
  EXPECT_EQ(sampled(session, params)["values"]["dear"].size(), 2U);
}

}  // namespace
}  // namespace spacetime::optimizer
