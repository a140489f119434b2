// A value that is dragged: the newest alone is sent, and one act is left of it.
#include "gui/words.h"
#include "tests/gui/table.h"

namespace spacetime::gui {
namespace {

TEST(Update, ADragSendsTheNewestValueAlone) {
  Table table;
  table.open();
  for (int i = 0; i < 500; ++i) {
    const Words words = set_words("k", i);
    table.feed(Steer{{words.line, {words.action}}});
  }
  EXPECT_LE(table.requests.size(), 4U);  // the first value's round, and samples
  const Request edit = table.take("action/do"), run = table.take("action/do");
  table.done(edit, {});
  table.done(run, {}, true);
  table.reach(1);
  EXPECT_EQ(table.take("action/do").params, "\"action\":" + set_words("k", 499).action);
  const Request second = table.take("action/do");
  EXPECT_EQ(table.count("action/do"), 0);

  // Let go: from the checkpoint before it, once.
  table.feed(Steered{true});
  EXPECT_EQ(table.count("problem/load"), 1);
  EXPECT_EQ(table.take("motion/set").params, "\"motion\":{\"at\":0}");
  table.done(second, {}, true);  // too late
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_FALSE(table.state.steering);
}

// A table where a drag of k to 1 was let go.
Table let_go() {
  Table table;
  table.open();
  const Words words = set_words("k", 1);
  table.feed(Steer{{words.line, {words.action}}});
  table.feed(Steered{true});
  table.requests.erase(table.requests.begin(), table.requests.begin() + 3);  // the drag's, which nobody waits for
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.compile();
  table.done(table.take("action/do"), {{words.action, ""}});
  return table;
}

// The `set` and the `solve` of a drag are one to the person: undone at once, and done again at once.
TEST(Update, UndoDuringTheSolveAfterADragTakesBothBack) {
  Table table = let_go();
  table.reach(0);
  table.compile();
  const Request run = table.take("action/do");
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
  table.done(run, {{R"({"action":"iterate","iterations":3})", "iterate 3"}}, true);
  table.reach(3);
  ASSERT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(table.state.present, 0);
  EXPECT_EQ(text_of(table.state), "time\n");
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
  ASSERT_TRUE(can_redo(table.state));
  table.feed(Redo{});
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.state.log[1].text, "set k = 1\niterate 3");
}

TEST(Update, UndoBeforeTheSolveAfterADragTakesTheDragBack) {
  for (const bool compiling : {false, true}) {
    Table table = let_go();
    if (compiling) table.reach(0);
    ASSERT_EQ(table.state.present, 1);
    ASSERT_EQ(table.count("scene/compile"), 1);
    table.feed(Undo{});
    EXPECT_EQ(table.state.present, 0);
    EXPECT_EQ(table.state.waiting, 0);
    EXPECT_FALSE(table.state.running);
  }
}

// Solving would take a control point back to where it was: it is moved, shown, and moved again.
TEST(Update, ADraggedControlPointIsFollowedByTheMotionWithItAlone) {
  Table table;
  table.open();
  const auto moving = [](double to) {
    const Words words = control_words("x", 2, to);
    return Steer{{.line = words.line, .actions = {words.action}, .solves = false}};
  };
  const auto before = table.state.curves;
  table.feed(moving(1));
  table.feed(moving(2));
  EXPECT_EQ(table.count("action/do"), 1);
  table.done(table.take("action/do"), {});
  table.reach(7);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 7);  // the figure follows
  EXPECT_EQ(table.state.ghost, before);
  EXPECT_EQ(table.take("action/do").params, "\"action\":" + control_words("x", 2, 2).action);
  table.feed(Steered{true});
  EXPECT_EQ(table.state.work.tasks.size(), 1U);  // and no solve
  EXPECT_EQ(table.state.work.tasks.front().line, "control x 2 = 2");
}

// Let go by Esc, nothing is left of it.
TEST(Update, ADraggedControlPointCanBeLetBack) {
  Table table;
  table.open();
  const Words words = control_words("x", 2, 1);
  table.feed(Steer{{.line = words.line, .actions = {words.action}, .solves = false}});
  table.done(table.take("action/do"), {});
  table.reach(7);
  table.feed(Steered{false});
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
  EXPECT_FALSE(table.state.ghost);
  EXPECT_TRUE(table.state.work.tasks.empty());
  EXPECT_EQ(table.count("motion/set"), 1);
}

TEST(Update, DragsDoNotPileUpWhereNobodyAnswers) {
  Table table;
  table.open();
  for (int i = 0; i < 200; ++i) {
    const Words words = set_words("k", i);
    table.feed(Steer{{words.line, {words.action}}});
    table.feed(Steered{true});
  }
  EXPECT_LE(table.state.work.tasks.size(), 64U);
}

}  // namespace
}  // namespace spacetime::gui
