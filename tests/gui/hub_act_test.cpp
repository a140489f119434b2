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
