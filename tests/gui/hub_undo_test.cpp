// Going to and fro in the log, and how the optimizer is led after it.
#include "tests/gui/table.h"

namespace spacetime::gui {
namespace {

TEST(Update, UndoShowsAtOnceAndLeadsTheOptimizerThere) {
  Table table;
  table.open();
  table.set();
  table.reach(3);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 3);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
  EXPECT_EQ(text_of(table.state), "time\n");
  const Request load = table.take("problem/load"), set = table.take("motion/set");
  EXPECT_EQ(set.params, "\"motion\":{\"at\":0}");
  // Undone and done again before the optimizer is there: it is led to the last place alone, and stale answers count
  // for nothing.
  table.feed(Redo{});
  table.feed(Undo{});
  table.feed(Redo{});
  table.acknowledge(load);
  table.acknowledge(set);
  EXPECT_NE(table.state.work.at, table.state.log[1].number);
  EXPECT_EQ(table.state.present, 1);
  while (table.count("motion/set") > 0) {
    table.acknowledge(table.take("problem/load"));
    while (table.count("action/do") > 0) table.done(table.take("action/do"), {});
    table.acknowledge(table.take("motion/set"));
  }
  EXPECT_EQ(table.state.work.at, table.state.log[1].number);
}

TEST(Update, AnActAfterUndoCutsWhatCouldBeRedone) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.set();
  table.reach(0);
  table.feed(Undo{});
  table.feed(Undo{});
  EXPECT_TRUE(can_redo(table.state));
  table.feed(Act{"set k"});
  EXPECT_TRUE(can_redo(table.state));  // not before it is known to be right
  while (table.count("motion/set") > 0) {
    table.acknowledge(table.take("problem/load"));
    table.acknowledge(table.take("motion/set"));
  }
  table.compile();
  EXPECT_TRUE(can_redo(table.state));  // nor before it was performed
  table.feed(Refused{table.take("action/do").number, "not so"});
  EXPECT_TRUE(can_redo(table.state));
  EXPECT_EQ(table.state.log.size(), 3U);
  table.set();
  EXPECT_FALSE(can_redo(table.state));
  EXPECT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(text_of(table.state), "time\nset k\n");
}

TEST(Update, ARunAfterUndoCutsWhatCouldBeRedone) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.feed(Undo{});
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.solve();
  EXPECT_FALSE(can_redo(table.state));
}

TEST(Update, UndoDuringARunKeepsItsOutcomeToBeRedone) {
  Table table;
  table.open();
  const Request run = table.solve();
  table.feed(Undo{});
  EXPECT_TRUE(std::holds_alternative<Cancel>(table.others.end()[-2]) ||
              std::holds_alternative<Cancel>(table.others.back()));
  IterationRecord record;
  record.iteration = 9;
  table.feed(Iterated{run.number, {record}, {}, {}});
  EXPECT_TRUE(table.state.record.iterations.empty());  // it is not looked at any more
  table.done(run, {{R"({"action":"iterate","iterations":9})", "iterate 9"}}, true);
  EXPECT_EQ(table.state.present, 0);
  EXPECT_EQ(text_of(table.state), "time\n");
  table.reach(9);
  EXPECT_TRUE(can_redo(table.state));
  EXPECT_EQ(table.state.log[1].text, "iterate 9");
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
}

TEST(Update, UndoDropsWhatWaitsAndOnlyThat) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.feed(Act{"set k"});
  table.feed(Act{"set k"});
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.state.waiting, 0);
  table.requests.clear();  // to compile it
  // One that may have been performed: the optimizer is led back.
  table.feed(Act{"set k"});
  table.compile();
  table.take("action/do");
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.count("motion/set"), 1);
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  EXPECT_EQ(table.state.work.at, table.state.log[1].number);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
}

TEST(Update, ALostOptimizerLeavesTheLogToLookAtAndToSave) {
  Table table;
  table.open();
  table.set();
  table.reach(5);
  table.feed(DaemonIs{false, Daemon::Condition::lost, "gone"});
  ASSERT_EQ(table.state.notices.size(), 1U);
  EXPECT_EQ(table.state.notices[0].severity, Severity::error);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
  table.feed(Refused{table.take("problem/load").number, "the daemon is lost"});
  for (int i = 0; i < 10; ++i) table.feed(Tick{1});
  EXPECT_EQ(table.count("problem/load"), 0);  // it is not tried for ever
  table.feed(Redo{});
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 5);
  table.feed(Save{"a.scene"});
  ASSERT_TRUE(std::holds_alternative<WriteFile>(table.others.back()));
  EXPECT_EQ(std::get<WriteFile>(table.others.back()).text, "time\nset k\n");
}

}  // namespace
}  // namespace spacetime::gui
