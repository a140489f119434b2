// Runs that are paused and go on: the text, and what it leads to, as if they never had been.
#include <gtest/gtest.h>

#include "tests/gui/driven.h"
#include "tests/gui/table.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using namespace gui;

TEST(HubPause, APausedRunGoesOnToTheSameBits) {
  const std::string text = text_of("examples/throw.scene");
  const std::string head = text.substr(0, text.rfind("solve"));
  for (const std::string line : {"solve method bfgs iterations 400 tolerance 1e-12", "solve tolerance 1e-12"}) {
    Hub hub(daemons());
    post_and_wait(hub, OpenText{head});
    hub.post(SetPace{20});  // so that there is time to pause it; the bits are the same
    hub.post(Act{line});
    const State& state = hub.state();
    int pauses = 0;
    while (pauses < 3) {
      // A record begins with where its run began.
      const auto records = std::max<std::size_t>(state.record.iterations.size(), 1), entries = state.log.size();
      until(
          hub,
          [&](const State& s) { return s.record.iterations.size() > records || (s.log.size() > entries && quiet(s)); },
          "an iteration");
      hub.post(Pause{});
      until_quiet(hub);
      if (!can_continue(state)) break;
      if (++pauses == 3) hub.post(SetPace{0});
      hub.post(Continue{});
    }
    until_quiet(hub);
    EXPECT_EQ(pauses, 3) << line;
    EXPECT_FALSE(can_continue(state));
    EXPECT_TRUE(curves_text(*state.motion) == batch_curves(head + line + "\n")) << text_to_save(state);
    EXPECT_TRUE(curves_text(*state.motion) == batch_curves(text_to_save(state)));
  }
}

TEST(Update, APausedRunCanGoOnFromWhereItEndedAlone) {
  Table table;
  table.open();
  const Request run = table.solve();
  EXPECT_TRUE(can_pause(table.state));
  table.feed(Pause{});
  table.feed(
      Done{run.number, {{R"({"action":"iterate","iterations":3})", "iterate 3"}}, true, Status::stopped, "stopped"});
  table.reach(3);
  ASSERT_TRUE(can_continue(table.state));
  EXPECT_EQ(table.state.paused->line, "solve");
  table.feed(Undo{});
  EXPECT_FALSE(can_continue(table.state));
  table.feed(Redo{});
  EXPECT_TRUE(can_continue(table.state));
  while (table.count("motion/set") > 0) {
    table.acknowledge(table.take("problem/load"));
    table.acknowledge(table.take("motion/set"));
  }
  table.set();
  EXPECT_FALSE(can_continue(table.state));  // it is another problem
  table.feed(Undo{});
  EXPECT_TRUE(can_continue(table.state));
  table.feed(Stop{});
  EXPECT_FALSE(can_continue(table.state));
}

}  // namespace
}  // namespace spacetime::test
