// Acts, from a line to an entry of the log: what they become, what refuses them, what nobody waits for.
#include "tests/gui/table.h"

namespace spacetime::gui {
namespace {

TEST(Update, TheSameStateAndEventGiveTheSame) {
  Table a, b;
  for (Table* table : {&a, &b}) {
    table->open();
    table->set();
    table->reach(0);
    table->feed(Act{"solve"});
  }
  EXPECT_EQ(a.requests.back().params, b.requests.back().params);
  EXPECT_EQ(a.requests.back().number, b.requests.back().number);
}

TEST(Update, AnActIsCompiledBehindTheTextAndJoinsItWhenItIsAnswered) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  ASSERT_EQ(table.requests.size(), 1U);
  EXPECT_EQ(table.requests[0].text, "time\nset k\n");
  table.compile();
  EXPECT_EQ(text_of(table.state), "time\n");
  const Request request = table.take("action/do");
  table.done(request, {{request.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\nset k\n");
  EXPECT_EQ(table.state.log.size(), 2U);
  EXPECT_FALSE(table.state.log[1].checkpoint);
  table.reach(0);
  EXPECT_TRUE(table.state.log[1].checkpoint);
  EXPECT_TRUE(can_undo(table.state));
}

TEST(Update, AMistakeIsToldWhereItBelongs) {
  Table table;
  table.open();
  table.feed(Act{"set k\nwrong", Notice::Place::equations, "goal"});
  table.compile();
  ASSERT_EQ(table.state.notices.size(), 1U);
  EXPECT_EQ(table.state.notices[0].text, "line 2: this is wrong");
  EXPECT_EQ(table.state.notices[0].place, Notice::Place::equations);
  EXPECT_EQ(table.state.notices[0].about, "goal");
  EXPECT_EQ(text_of(table.state), "time\n");
  EXPECT_TRUE(table.requests.empty());
  table.feed(Act{"set k"});  // it goes with the next act
  EXPECT_TRUE(table.state.notices.empty());
}

TEST(Update, ARefusedActLeavesNothing) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  table.compile();
  table.feed(Refused{table.take("action/do").number, "not so"});
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_EQ(table.state.notices.back().text, "not so");
  EXPECT_TRUE(table.requests.empty());
}

TEST(Update, TwoSetsInOneLineOfWhichOneIsRefusedAreBothUndone) {
  Table table;
  table.open();
  table.feed(Act{"set k\nset k"});
  table.compile();
  const Request first = table.take("action/do"), second = table.take("action/do");
  table.done(first, {{first.params.substr(9), ""}});
  table.feed(Refused{second.number, "not so"});
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_EQ(table.count("problem/load"), 1);  // back to where the session is
  EXPECT_EQ(table.count("motion/set"), 1);
}

// A run's progress, with a curve that differs.
Iterated iterate_of(const Request& run, int iteration) {
  IterationRecord record;
  record.iteration = iteration;
  Trajectory x;
  x.name = "x";
  x.coefficients = std::vector<double>(4, 100.0 + iteration);
  return {run.number, {record}, {x}, {}};
}

// What is shown is what is saved and filmed: a run that is lost leaves none of its iterates, and the optimizer, of
// which nobody knows how far it came, is led back.
TEST(Update, ARunThatEndsInAnErrorIsTakenBack) {
  Table table;
  table.open();
  table.set();
  table.reach(1);
  const auto ghost = table.state.ghost;
  const Request run = table.solve();
  table.feed(iterate_of(run, 5));
  table.feed(SetPose{Pose{{{"x", 2}}}});
  ASSERT_EQ(table.state.curves->dofs[0].coefficients[0], 105);
  table.feed(Refused{run.number, "memory"});
  EXPECT_FALSE(table.state.running);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 1);
  EXPECT_TRUE(table.state.record.iterations.empty());
  EXPECT_EQ(table.state.notices.back().text, "memory");
  EXPECT_EQ(table.state.ghost, ghost);
  EXPECT_TRUE(table.state.pose);
  EXPECT_EQ(table.count("problem/load"), 1);
  EXPECT_EQ(table.take("motion/set").params, "\"motion\":{\"at\":1}");
}

TEST(Update, ARunIsGivenUpWithAnActThatWasDoneInPart) {
  for (const bool refused : {false, true}) {
    Table table;
    table.open();
    const Request run = table.solve();
    table.feed(iterate_of(run, 5));
    table.feed(Act{"set k\nset k"});
    table.compile();
    const Request first = table.take("action/do"), second = table.take("action/do");
    table.done(first, {{R"({"action":"iterate","iterations":4})", "iterate 4"}, {first.params.substr(9), ""}});
    table.feed(Refused{second.number, "not so"});
    EXPECT_TRUE(std::holds_alternative<Cancel>(table.others.back()));
    const auto told = [&](const char* words) {
      return std::ranges::any_of(table.state.notices, [&](const Notice& n) { return n.text.starts_with(words); });
    };
    EXPECT_TRUE(told("not so"));
    EXPECT_TRUE(told("The run was given up"));
    if (refused)
      table.feed(Refused{run.number, "cancelled"});
    else
      table.done(run, {{R"({"action":"iterate","iterations":5})", "iterate 5"}}, true);
    EXPECT_FALSE(table.state.running);
    EXPECT_EQ(text_of(table.state), "time\n");
    EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
    EXPECT_TRUE(table.state.record.iterations.empty());
    EXPECT_FALSE(table.state.ghost);
    EXPECT_EQ(table.take("motion/set").params, "\"motion\":{\"at\":0}");
  }
}

TEST(Update, ADraftGoesWithTheActThatWasWrittenInItAlone) {
  Table table;
  table.open();
  const auto perform = [&](const Act& act) {
    table.feed(act);
    table.compile();
    const Request request = table.take("action/do");
    table.done(request, {{request.params.substr(9), ""}});
    table.reach(0);
  };
  table.feed(Draft{"goal", "x = 1"});
  perform(Act{"set k", Notice::Place::equations, "goal"});  // switched off, say
  EXPECT_EQ(table.state.drafts.at("goal"), "x = 1");
  table.feed(Act{"set k", Notice::Place::equations, "goal", "x = 1"});
  table.feed(Draft{"goal", "x = 1 at 2"});  // before the answer
  table.compile();
  table.done(table.take("action/do"), {});
  table.reach(0);
  EXPECT_EQ(table.state.drafts.at("goal"), "x = 1 at 2");
  perform(Act{"set k", Notice::Place::equations, "goal", "x = 1 at 2"});
  EXPECT_TRUE(table.state.drafts.empty());
}

TEST(Update, AnswersToWhatNobodyWaitsForAreDropped) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  const Request compile = table.requests[0];
  table.feed(OpenText{"time\ntime\n"});  // another session
  auto scene = std::make_shared<Scene>();
  scene->text = "stale";
  table.feed(Compiled{compile.number, scene});
  table.feed(Done{compile.number, {}, false, Status::stopped, ""});
  table.feed(Refused{compile.number, "stale"});
  EXPECT_EQ(table.state.present, -1);
  EXPECT_TRUE(table.state.notices.empty());
  table.take("scene/compile");
  table.compile();
  EXPECT_EQ(text_of(table.state), "time\ntime\n");
}

TEST(Update, AnEditDuringARunComesBehindItsIterations) {
  Table table;
  table.open();
  const Request run = table.solve();
  EXPECT_TRUE(table.state.running);
  table.feed(Act{"set k"});
  table.compile();
  const Request edit = table.take("action/do");
  table.done(edit, {{R"({"action":"iterate","iterations":4})", "iterate 4"}, {edit.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\niterate 4\nset k\n");
  ASSERT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(table.state.log[1].text, "iterate 4\nset k");
  EXPECT_EQ(table.state.scene->outline.size(), 3U);
  EXPECT_EQ(table.state.scene->outline[2].line, 3);
  table.done(run, {{R"({"action":"solve","iterations":996})", "solve iterations 996"}}, true);
  EXPECT_EQ(text_of(table.state), "time\niterate 4\nset k\nsolve iterations 996\n");
  EXPECT_FALSE(table.state.running);
}

TEST(Update, NothingOfAnActThatWasLeftIsInTheNext) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.feed(Act{"set k\nset k"});
  table.compile();
  const Request first = table.take("action/do");
  table.done(first, {{R"({"action":"iterate","iterations":4})", "iterate 4"}, {first.params.substr(9), ""}});
  table.take("action/do");
  table.feed(GoTo{0});
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.set();
  ASSERT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(text_of(table.state), "time\nset k\n");
  EXPECT_EQ(table.state.log[1].actions.size(), 1U);
}

TEST(Update, AnActIsComparedWithTheTextItWasCompiledBehind) {
  Table table;
  table.open();
  table.solve();
  table.set();
  table.feed(Act{"set k"});
  // Meanwhile it is known how far the run had come.
  table.feed(Reached{table.take("motion/get").number,
                     std::make_shared<Motion>(),
                     std::make_shared<std::string>("{}"),
                     {{R"({"action":"iterate","iterations":2})", "iterate 2"}}});
  EXPECT_EQ(text_of(table.state), "time\nset k\niterate 2\n");
  table.compile();
  const Request second = table.take("action/do");
  table.done(second, {{second.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\nset k\niterate 2\nset k\n");
  ASSERT_EQ(table.state.log.size(), 3U);
  EXPECT_EQ(table.state.log[2].actions.size(), 1U);
  EXPECT_EQ(table.state.scene->outline.size(), 4U);
}

TEST(Update, NothingGrowsWhereNobodyAnswers) {
  Table table;
  table.open();
  for (int i = 0; i < 2000; ++i) {
    table.feed(Act{"set k"});
    table.feed(Ask{"1 + 1"});
    table.feed(Tick{0.01});
  }
  EXPECT_LE(table.requests.size(), 20U);
  EXPECT_LE(table.state.work.tasks.size(), 64U);
  EXPECT_LE(table.state.console.size(), 200U);
  EXPECT_LE(table.state.notices.size(), 20U);
  EXPECT_LE(table.state.work.wanted.size(), 20U);
}

}  // namespace
}  // namespace spacetime::gui
